#include "bench/report/split.hpp"

#include <algorithm>

namespace canhil::report {
namespace {

std::optional<double> mean_s(std::int64_t sum_ns, std::uint64_t count) {
  if (count == 0) return std::nullopt;
  return static_cast<double>(sum_ns) / static_cast<double>(count) * 1e-9;
}

// The parts of both kinds of a split.
struct OnTheBus {
  SplitPart wait, stimulus, reply;
};
OnTheBus on_the_bus(const checks::TimingRecord& timing, const checks::LatencySplit& split) {
  const bool wire_known = timing.wire.rates.nominal > 0;
  const auto on_wire = [&](std::int64_t sum_ns, std::uint64_t count) {
    return wire_known ? mean_s(sum_ns, count) : std::nullopt;
  };
  const auto stimulus = on_wire(split.stimulus_wire_ns, split.echoed);
  auto wait = mean_s(split.to_echo_ns, split.echoed);
  if (wait) *wait -= stimulus.value_or(0);
  return {{"stimulus_wait", "stimulus: driver of the bench, wait for the bus", wait},
          {"stimulus_wire", "stimulus: its last frame on the wire", stimulus},
          {"reply_wire", "answer: its frames on the wire", on_wire(split.reply_wire_ns, split.stimuli)}};
}

}  // namespace

std::vector<SplitPart> parts(const checks::TimingRecord& timing) {
  const checks::LatencySplit& split = timing.split;
  const OnTheBus bus = on_the_bus(timing, split);
  const auto queue = mean_s(split.target_queue_ns, split.told);
  const auto compute = mean_s(split.target_compute_ns, split.told);
  std::optional<double> rest = mean_s(split.latency_ns, split.stimuli);
  if (rest) *rest -= queue.value_or(0) + compute.value_or(0) + bus.reply.mean_s.value_or(0);
  const auto told = [](bool clipped) { return clipped ? Bound::at_least : Bound::exact; };
  const bool clipped = split.queue_clipped || split.compute_clipped;
  return {bus.wait,
          bus.stimulus,
          {"target_queue", "target: from its stamp to its turn", queue, told(split.queue_clipped)},
          {"target_compute", "target: computing", compute, told(split.compute_clipped)},
          bus.reply,
          {"not_explained", "not explained: drivers, sending, wait for the bus", rest,
           clipped ? Bound::at_most : Bound::exact}};
}

std::vector<SplitPart> group_parts(const checks::TimingRecord& timing, const checks::LatencySplit& split) {
  const OnTheBus bus = on_the_bus(timing, split);
  std::optional<double> rest = mean_s(split.latency_ns, split.stimuli);
  if (rest) *rest -= bus.reply.mean_s.value_or(0);
  return {bus.wait,
          bus.stimulus,
          bus.reply,
          {"target_and_waits", "target, drivers, sending, wait for the bus", rest}};
}

std::string_view what_of(std::string_view key) {
  for (const auto& known : {parts({}), group_parts({}, {})}) {
    const auto part = std::ranges::find(known, key, &SplitPart::key);
    if (part != known.end()) return part->what;
  }
  return key;
}

double total_s(const checks::LatencySplit& split) {
  return mean_s(split.to_echo_ns, split.echoed).value_or(0) +
         mean_s(split.latency_ns, split.stimuli).value_or(0);
}

}  // namespace canhil::report
