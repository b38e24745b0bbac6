#include "bench/faults/kinds/others.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/faults/read.hpp"
#include "dbc/wire/bit_length.hpp"
#include "dbc/wire/frame_rules.hpp"

namespace canhil::faults {
namespace {

using scenario::Limits;

constexpr std::uint8_t most_bytes = 8;

bool is_known(const scenario::FaultContext& context, std::uint32_t id) {
  return std::ranges::any_of(messages_of(context), [&](const MessageInfo& message) {
    return message.id == id && !message.extended;
  });
}

class Strangers final : public Repeated {
 public:
  Strangers(const Stranger& kind, const InRun& run)
      : Repeated(kind.when, kind.period_us, run), id_(kind.id), stream_(run.stream()) {}

 private:
  void strike(std::vector<Frame>& out) override {
    Frame& frame = out.emplace_back(Frame{.id = id_, .size = most_bytes});
    for (std::size_t i = 0; i < most_bytes; ++i)
      frame.data[i] = static_cast<std::uint8_t>(stream_.uniform() * 256);
  }
  std::uint32_t id_;
  world::Stream stream_;
};

// Id 0 wins every arbitration.
constexpr Frame urgent{.id = 0, .size = most_bytes};

class FloodFrames final : public Repeated {
 public:
  using Repeated::Repeated;

 private:
  void strike(std::vector<Frame>& out) override { out.push_back(urgent); }
};

}  // namespace

Stranger Stranger::read(scenario::Section& section, const scenario::FaultContext& context) {
  Stranger kind;
  kind.when = read_when(section, context, Repeats::stretch);
  kind.period_us = section.time_us({"period_ms", "Time from one frame to the next."}, Limits::above(0));
  kind.id = max_standard_id;
  while (kind.id > 0 && is_known(context, kind.id)) --kind.id;
  if (const auto id =
          section.optional_integer({"id", "Id of the frames; by default the highest unused id."}, 0)) {
    kind.id = static_cast<std::uint32_t>(std::min<std::int64_t>(*id, max_standard_id));
    if (*id > max_standard_id || is_known(context, kind.id))
      section.reject("id", fmt::format("{} is used by the DBC, or has more than 11 bits", *id),
                     "an id that is not used on this bus");
  }
  return kind;
}

std::unique_ptr<Injector> Stranger::injector(const InRun& run) const {
  return std::make_unique<Strangers>(*this, run);
}

Flood Flood::read(scenario::Section& section, const scenario::FaultContext& context) {
  Flood kind;
  kind.when = read_when(section, context, Repeats::stretch);
  kind.period_us =
      section.optional_time_us({"period_us", "Time from one frame to the next."}, Limits::above(0));
  if (kind.period_us)
    section.refuse("load_percent", "is given beside period_us", "one of the two");
  else
    kind.load = section.number({"load_percent", "Share of the bus's bit rate that the extra frames occupy."},
                               Limits::above(0, 100));
  if (is_known(context, urgent.id))
    section.reject("kind", "'flood' uses the id of a message", "a DBC without id 0");
  return kind;
}

std::string Flood::cannot(const Place& place) const {
  if (period_us || place.wire.rates.nominal > 0) return {};
  return "does not know the bit rate of '" + place.bus +
         "', expected period_us in place of load_percent, or a bus whose bit rate is known";
}

std::unique_ptr<Injector> Flood::injector(const InRun& run) const {
  std::int64_t each_us = period_us.value_or(1);
  if (!period_us && run.place.wire.rates.nominal > 0) {
    const auto bits = static_cast<double>(wire::bit_length(urgent).bits());
    const double rate = static_cast<double>(run.place.wire.rates.nominal);
    each_us = std::max<std::int64_t>(1, std::llround(1e6 * bits / (rate * load)));
  }
  return std::make_unique<FloodFrames>(when, each_us, run);
}

}  // namespace canhil::faults
