#include "bench/report/latency_breakdown.hpp"

#include <algorithm>

namespace canhil::report {
namespace {

std::optional<double> mean_s(std::int64_t sum_ns, std::uint64_t count) {
  if (count == 0) return std::nullopt;
  return static_cast<double>(sum_ns) / static_cast<double>(count) * 1e-9;
}

// The parts that are in both kinds of breakdown: the breakdown over all stimuli, and that of one group.
struct OnTheBus {
  BreakdownPart wait, stimulus, reply;
};
OnTheBus on_the_bus(const checks::TimingRecord& timing, const checks::LatencyBreakdown& breakdown) {
  const bool wire_known = timing.wire.rates.nominal > 0;
  const auto on_wire = [&](std::int64_t sum_ns, std::uint64_t count) {
    return wire_known ? mean_s(sum_ns, count) : std::nullopt;
  };
  const auto stimulus = on_wire(breakdown.stimulus_wire_ns, breakdown.echoed);
  auto wait = mean_s(breakdown.to_echo_ns, breakdown.echoed);
  if (wait) *wait -= stimulus.value_or(0);
  return {
      {"stimulus_wait", "stimulus: driver of the bench, wait for the bus", wait},
      {"stimulus_wire", "stimulus: its last frame on the wire", stimulus},
      {"reply_wire", "answer: its frames on the wire", on_wire(breakdown.reply_wire_ns, breakdown.stimuli)}};
}

}  // namespace

std::vector<BreakdownPart> parts(const checks::TimingRecord& timing) {
  const checks::LatencyBreakdown& breakdown = timing.breakdown;
  const OnTheBus bus = on_the_bus(timing, breakdown);
  const auto queue = mean_s(breakdown.target_queue_ns, breakdown.accounted);
  const auto compute = mean_s(breakdown.target_compute_ns, breakdown.accounted);
  std::optional<double> rest = mean_s(breakdown.latency_ns, breakdown.stimuli);
  if (rest) *rest -= queue.value_or(0) + compute.value_or(0) + bus.reply.mean_s.value_or(0);
  const auto bound_of = [](bool clipped) { return clipped ? Bound::at_least : Bound::exact; };
  const bool clipped = breakdown.queue_clipped || breakdown.compute_clipped;
  return {bus.wait,
          bus.stimulus,
          {"target_queue", "target: from its stamp to its turn", queue, bound_of(breakdown.queue_clipped)},
          {"target_compute", "target: computing", compute, bound_of(breakdown.compute_clipped)},
          bus.reply,
          {"not_explained", "not explained: drivers, sending, wait for the bus", rest,
           clipped ? Bound::at_most : Bound::exact}};
}

std::vector<BreakdownPart> group_parts(const checks::TimingRecord& timing,
                                       const checks::LatencyBreakdown& breakdown) {
  const OnTheBus bus = on_the_bus(timing, breakdown);
  std::optional<double> rest = mean_s(breakdown.latency_ns, breakdown.stimuli);
  if (rest) *rest -= bus.reply.mean_s.value_or(0);
  return {bus.wait,
          bus.stimulus,
          bus.reply,
          {"target_and_waits", "target, drivers, sending, wait for the bus", rest}};
}

std::string_view what_of(std::string_view key) {
  for (const auto& known : {parts({}), group_parts({}, {})}) {
    const auto part = std::ranges::find(known, key, &BreakdownPart::key);
    if (part != known.end()) return part->what;
  }
  return key;
}

double total_s(const checks::LatencyBreakdown& breakdown) {
  return mean_s(breakdown.to_echo_ns, breakdown.echoed).value_or(0) +
         mean_s(breakdown.latency_ns, breakdown.stimuli).value_or(0);
}

}  // namespace canhil::report
