#include "bench/faults/kinds/frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "dbc/wire/e2e.hpp"

namespace canhil::faults {
namespace {

constexpr std::uint8_t most_classic = 8;
constexpr std::array<std::uint8_t, 7> fd_sizes{12, 16, 20, 24, 32, 48, 64};

std::uint8_t next_size(std::uint8_t size) {
  if (size < most_classic) return static_cast<std::uint8_t>(size + 1);
  const auto longer = std::ranges::upper_bound(fd_sizes, size);
  return longer == fd_sizes.end() ? size : *longer;
}

class DamagedFrames final : public OfFrames {
 public:
  DamagedFrames(const Damaged& kind, const InRun& run)
      : OfFrames(kind.of, kind.when, run), bits_(kind.bits), stream_(run.stream("bits")) {}

 private:
  void put(Own& own, const Frame& frame, std::int64_t /*t_us*/, std::vector<Frame>& left) override {
    Frame& damaged = left.emplace_back(frame);
    damaged.unrounded = false;  // else the receiver would use the unrounded values, not the bytes
    if (!bits_) {
      damaged.data[std::min<std::size_t>(3, frame.size - 1)] ^= 0x10U;
      return;
    }
    for (std::int64_t flipped = 0; flipped < std::min<std::int64_t>(*bits_, 8L * frame.size);) {
      const auto at = static_cast<std::size_t>(stream_.uniform() * 8 * frame.size);
      const auto bit = static_cast<std::uint8_t>(1U << (at % 8));
      if (((damaged.data[at / 8] ^ frame.data[at / 8]) & bit) != 0) continue;  // flip each bit only once
      damaged.data[at / 8] ^= bit;
      ++flipped;
    }
    const std::uint16_t id = own.message->e2e_data_id;
    if (id != 0 && damaged.data[0] == e2e::crc(damaged.payload(), id)) ++tally().changed;
  }
  std::optional<std::int64_t> bits_;
  world::Stream stream_;
};

}  // namespace

void Lost::change(const MessageInfo& /*message*/, const Frame& /*frame*/, std::vector<Frame>& /*left*/) {}

void Repetition::change(const MessageInfo& /*message*/, const Frame& frame, std::vector<Frame>& left) {
  left.insert(left.end(), 2, frame);
}

void TooShort::change(const MessageInfo& /*message*/, const Frame& frame, std::vector<Frame>& left) {
  --left.emplace_back(frame).size;
}

void TooLong::change(const MessageInfo& /*message*/, const Frame& frame, std::vector<Frame>& left) {
  Frame& longer = left.emplace_back(frame);
  longer.size = next_size(frame.size);
  std::fill(longer.data.begin() + frame.size, longer.data.end(), std::uint8_t{0});
  longer.unrounded = false;
}

std::string TooLong::cannot(const Place& place) const {
  const auto full = std::ranges::find_if(of.all, [&](const MessageInfo* message) {
    return next_size(message->size) == message->size || (message->size >= most_classic && !place.fd);
  });
  if (full == of.all.end()) return {};
  return fmt::format("has no longer frame for the {} bytes of {}, expected a bus of CAN FD", (*full)->size,
                     (*full)->name);
}

void ForeignFormat::change(const MessageInfo& /*message*/, const Frame& frame, std::vector<Frame>& left) {
  left.emplace_back(frame).extended = true;
}

Damaged Damaged::read(scenario::Section& section, const scenario::FaultContext& context) {
  Damaged kind;
  kind.of = read_messages(section, context);
  kind.when = read_when(section, context, Repeats::each);
  kind.bits = section.optional_integer(
      {"bits", "Number of random bits that are flipped. Default: one bit, at a fixed place."}, 1);
  return kind;
}

std::unique_ptr<Injector> Damaged::injector(const InRun& run) const {
  return std::make_unique<DamagedFrames>(*this, run);
}

}  // namespace canhil::faults
