// Any sequence of frames: the Device survives, answers with frames of its own DBC only, and each of them is
// well protected. Input: for each frame one byte that picks the message, one of flags, then its data. Most
// frames get a right counter and CRC, else nothing would come past the protection.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "messages/canhil.hpp"
#include "target/device/device.hpp"

namespace {

using canhil::Frame;

constexpr std::uint8_t unprotected = 0x01, foreign_id = 0x02, shortened = 0x04;

void expect_valid(std::span<const Frame> answers) {
  for (const Frame& answer : answers) {
    const auto message =
        std::ranges::find(canhil::messages::all_messages, answer.id, &canhil::MessageInfo::id);
    if (message == canhil::messages::all_messages.end() || message->sender != "Target") std::abort();
    if (answer.size != message->size) std::abort();
    if (answer.data[0] != canhil::e2e::crc(answer.payload(), message->e2e_data_id)) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  canhil::target::Device device;
  std::array<std::uint8_t, canhil::messages::all_messages.size()> counters{};
  std::span<const std::uint8_t> rest(data, size);
  while (rest.size() >= 2) {
    const std::size_t index = rest[0] % canhil::messages::all_messages.size();
    const std::uint8_t flags = rest[1];
    rest = rest.subspan(2);
    const canhil::MessageInfo& message = canhil::messages::all_messages[index];
    Frame frame{.id = (flags & foreign_id) != 0 ? message.id ^ 1U : message.id, .size = message.size};
    if ((flags & shortened) != 0) frame.size = static_cast<std::uint8_t>(flags >> 4U) % (message.size + 1);
    const std::size_t taken = std::min<std::size_t>(frame.size, rest.size());
    std::ranges::copy(rest.first(taken), frame.data.begin());
    rest = rest.subspan(taken);
    if ((flags & unprotected) == 0 && frame.size >= 2 && message.e2e_data_id != 0) {
      counters[index] = canhil::e2e::next(counters[index]);
      canhil::e2e::protect(std::span(frame.data).first(frame.size), message.e2e_data_id, counters[index]);
    }
    expect_valid(device.receive(frame));
  }
  return 0;
}
