#include "bench/faults/kinds/protection.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/scenario/binding.hpp"
#include "dbc/protection/profiles.hpp"
#include "dbc/protection/protection.hpp"

namespace canhil::faults {
namespace {

using protection::Protection;

// Requires messages with a protection, because otherwise the places of counter and checksum are unknown.
template <class Kind>
Kind read_protected(scenario::Section& section, const scenario::FaultContext& context, bool counter) {
  Kind kind;
  kind.of = read_messages(section, context);
  for (const MessageInfo* message : kind.of.all) {
    auto own = context.contract.binding->protection_of(*message);
    if (own == nullptr)
      section.reject("messages", fmt::format("{} has no protection that the bench can spoil", message->name),
                     "kind = \"damaged\"");
    else if (counter ? !own->has_counter() : !own->settings().checksum.has_value())
      section.reject("messages", fmt::format("{} has no {}", message->name, counter ? "counter" : "checksum"),
                     "messages that have one");
    kind.protection[message] = std::move(own);
  }
  kind.when = read_when(section, context, Repeats::each);
  return kind;
}

// The frames have another counter or another checksum.
class Spoilt : public OfFrames {
 public:
  Spoilt(const ProtectedFrames& kind, const InRun& run)
      : OfFrames(kind.of, kind.when, run), protection_(kind.protection) {}

 protected:
  virtual void spoil(Own& own, const Protection& protection, std::span<std::uint8_t> data) = 0;

 private:
  void put(Own& own, const Frame& frame, std::int64_t /*t_us*/, std::vector<Frame>& left) override {
    Frame& spoilt = left.emplace_back(frame);
    spoil(own, *protection_.at(own.message), {spoilt.data.data(), spoilt.size});
  }
  std::map<const MessageInfo*, std::shared_ptr<const Protection>> protection_;
};

class WrongCrcs final : public Spoilt {
 public:
  using Spoilt::Spoilt;

 private:
  void spoil(Own& /*own*/, const Protection& protection, std::span<std::uint8_t> data) override {
    protection.spoil_checksum(data);
  }
};

class StuckCounters final : public Spoilt {
 public:
  using Spoilt::Spoilt;

 private:
  void spoil(Own& own, const Protection& protection, std::span<std::uint8_t> data) override {
    if (!own.counter) own.counter = protection.counter(data);
    protection.protect(data, *own.counter);
  }
};

class AheadCounters final : public Spoilt {
 public:
  AheadCounters(const CounterJump& kind, const InRun& run) : Spoilt(kind, run), by_(kind.by) {}

 private:
  void spoil(Own& /*own*/, const Protection& protection, std::span<std::uint8_t> data) override {
    std::uint64_t counter = protection.counter(data);
    for (std::int64_t i = 0; i < by_; ++i) counter = protection.next(counter);
    protection.protect(data, counter);
  }
  std::int64_t by_;
};

}  // namespace

WrongCrc WrongCrc::read(scenario::Section& section, const scenario::FaultContext& context) {
  return read_protected<WrongCrc>(section, context, false);
}

std::unique_ptr<Injector> WrongCrc::injector(const InRun& run) const {
  return std::make_unique<WrongCrcs>(*this, run);
}

CounterStuck CounterStuck::read(scenario::Section& section, const scenario::FaultContext& context) {
  return read_protected<CounterStuck>(section, context, true);
}

std::unique_ptr<Injector> CounterStuck::injector(const InRun& run) const {
  return std::make_unique<StuckCounters>(*this, run);
}

CounterJump CounterJump::read(scenario::Section& section, const scenario::FaultContext& context) {
  auto kind = read_protected<CounterJump>(section, context, true);
  kind.by =
      section.integer({"by",
                       "Number of steps that the counter is ahead. It is less than the number of values "
                       "of the counter (15 in canhil's own messages)."},
                      1);
  for (const auto& [message, protection] : kind.protection) {
    if (protection == nullptr || !protection->has_counter()) continue;
    const auto period = static_cast<std::int64_t>(protection->period());
    if (kind.by >= period)
      section.reject("by", fmt::format("{} is a whole turn of the counter or more", kind.by),
                     fmt::format("1 to {}", period - 1));
  }
  return kind;
}

std::unique_ptr<Injector> CounterJump::injector(const InRun& run) const {
  return std::make_unique<AheadCounters>(*this, run);
}

}  // namespace canhil::faults
