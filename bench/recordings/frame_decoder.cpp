#include "bench/recordings/frame_decoder.hpp"

#include <algorithm>
#include <array>

#include "dbc/parser/codec.hpp"
#include "dbc/transport/fast_packet.hpp"
#include "dbc/wire/bits.hpp"

namespace canhil::recordings {
namespace {

constexpr std::size_t most_bytes = transport::most_fast_packet_bytes;

unsigned bytes_of(const dbc::Signal& signal) {
  unsigned bytes = 0;
  for (unsigned i = 0; i < signal.length; ++i)
    bytes = std::max(
        bytes,
        1 + wire::bit_position(signal.start_bit, i, signal.byte_order == dbc::ByteOrder::big_endian) / 8);
  return bytes;
}

unsigned multiplexor_bytes_of(const dbc::Message& message, const dbc::Signal& signal) {
  unsigned bytes = 0;
  for (const dbc::Signal* one = &signal; !one->multiplexed_by.empty();) {
    one = dbc::find_signal(message, one->multiplexed_by);
    bytes = std::max(bytes, bytes_of(*one));
  }
  return bytes;
}

}  // namespace

FrameDecoder::Layout::Layout(const dbc::Message& message) : plan(message) {
  for (const dbc::Signal& signal : message.signals) {
    steps.push_back({.bits = dbc::BitPlacement(signal, most_bytes),
                     .conversion = dbc::DecimalConversion(signal),
                     .bytes = bytes_of(signal),
                     .multiplexor_bytes = multiplexor_bytes_of(message, signal)});
  }
}

std::vector<SignalValue> FrameDecoder::decode(const dbc::Message& message,
                                              std::span<const std::uint8_t> bytes) {
  const Layout& layout = layouts_.try_emplace(&message, message).first->second;
  std::array<std::uint8_t, most_bytes> data{};
  std::ranges::copy(bytes.first(std::min(bytes.size(), most_bytes)), data.begin());
  std::vector<SignalValue> values;
  for (std::size_t i = 0; i < layout.steps.size(); ++i) {
    const Step& step = layout.steps[i];
    if (step.multiplexor_bytes > bytes.size() || !layout.plan.is_present(i, data)) continue;
    SignalValue& value = values.emplace_back(SignalValue{.index = i});
    if (step.bytes > bytes.size()) continue;
    const std::uint64_t raw = step.bits.raw(data.data());
    value.text = step.conversion.text(raw);
    if (!message.signals[i].values.empty()) value.name = dbc::value_name(message.signals[i], raw);
  }
  return values;
}

}  // namespace canhil::recordings
