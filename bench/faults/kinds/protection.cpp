#include "bench/faults/kinds/protection.hpp"

#include <fmt/format.h>

#include "bench/faults/frame_edit.hpp"
#include "dbc/wire/e2e.hpp"

namespace canhil::faults {
namespace {

// Requires messages with canhil's own protection: in other messages, the positions of counter and CRC are
// unknown.
template <class Kind>
Kind read_protected(scenario::Section& section, const scenario::FaultContext& context) {
  Kind kind;
  kind.of = read_messages(section, context);
  for (const MessageInfo* message : kind.of.all) {
    if (message->e2e_data_id == 0)
      section.reject("messages", fmt::format("{} has no protection that the bench can spoil", message->name),
                     "kind = \"damaged\"");
  }
  kind.when = read_when(section, context, Repeats::each);
  return kind;
}

class StuckCounters final : public OfFrames {
 public:
  using OfFrames::OfFrames;

 private:
  void put(Own& own, const Frame& frame, std::int64_t /*t_us*/, std::vector<Frame>& left) override {
    if (!own.counter) own.counter = e2e::counter(frame.payload());
    set_counter(left.emplace_back(frame), *own.message, *own.counter);
  }
};

class AheadCounters final : public OfFrames {
 public:
  AheadCounters(const CounterJump& kind, const InRun& run)
      : OfFrames(kind.of, kind.when, run), by_(kind.by) {}

 private:
  void put(Own& own, const Frame& frame, std::int64_t /*t_us*/, std::vector<Frame>& left) override {
    const std::int64_t counter = (e2e::counter(frame.payload()) + by_) % e2e::counter_period;
    set_counter(left.emplace_back(frame), *own.message, static_cast<std::uint8_t>(counter));
  }
  std::int64_t by_;
};

}  // namespace

WrongCrc WrongCrc::read(scenario::Section& section, const scenario::FaultContext& context) {
  return read_protected<WrongCrc>(section, context);
}

std::unique_ptr<Injector> WrongCrc::injector(const InRun& run) const {
  return change_frames(of, when, run,
                       [](const MessageInfo& /*message*/, const Frame& frame, std::vector<Frame>& left) {
                         left.emplace_back(frame).data[0] ^= 0xFFU;
                       });
}

CounterStuck CounterStuck::read(scenario::Section& section, const scenario::FaultContext& context) {
  return read_protected<CounterStuck>(section, context);
}

std::unique_ptr<Injector> CounterStuck::injector(const InRun& run) const {
  return std::make_unique<StuckCounters>(of, when, run);
}

CounterJump CounterJump::read(scenario::Section& section, const scenario::FaultContext& context) {
  auto kind = read_protected<CounterJump>(section, context);
  kind.by = section.integer(
      {"by", "Number that is added to the counter. At most 14, because the counter repeats after 15 frames."},
      1);
  if (kind.by >= e2e::counter_period)
    section.reject("by", fmt::format("{} is a whole turn of the counter or more", kind.by),
                   fmt::format("1 to {}", e2e::counter_period - 1));
  return kind;
}

std::unique_ptr<Injector> CounterJump::injector(const InRun& run) const {
  return std::make_unique<AheadCounters>(*this, run);
}

}  // namespace canhil::faults
