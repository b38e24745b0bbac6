#include "bench/checks/kinds/own_times.hpp"

#include <fmt/format.h>

#include "bench/checks/evidence.hpp"
#include "bench/checks/timing.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::checks {

OwnTimes OwnTimes::read(scenario::Section& /*section*/, const scenario::CheckContext& /*context*/) {
  return {};
}

Finding OwnTimes::judge(const Evidence& evidence) const {
  Expected expected{
      .text = "TargetTiming reports times above 0 and no longer than the latencies",
      .criterion = {.quantity = "TargetTiming", .statistic = "mean", .lower = exclusive(0), .unit = "us"}};
  if (!evidence.timing_unfit.empty()) return {Outcome::not_measured, evidence.timing_unfit, expected};
  if (!evidence.seen.target_timing_seen) return {Outcome::fail, "no TargetTiming", expected};
  const LatencyBreakdown& breakdown = evidence.seen.timing.breakdown;
  if (breakdown.stimuli == 0) return {Outcome::fail, "no answers", expected};
  if (breakdown.accounted == 0) return {Outcome::fail, "TargetTiming accounts for no stimulus", expected};
  const auto mean_us = [](std::int64_t sum_ns, std::uint64_t count) {
    return 1e-3 * static_cast<double>(sum_ns) / static_cast<double>(count);
  };
  const double queue_us = mean_us(breakdown.target_queue_ns, breakdown.accounted);
  const double compute_us = mean_us(breakdown.target_compute_ns, breakdown.accounted);
  const double latency_us = mean_us(breakdown.latency_ns, breakdown.stimuli);
  const double reported_us = queue_us + compute_us;
  expected.criterion.upper = Limit{.value = latency_us};
  return {pass_if(reported_us > 0 && reported_us <= latency_us),
          fmt::format("mean queueing {:.1f} us, computing {:.1f} us, latency {:.1f} us", queue_us, compute_us,
                      latency_us),
          std::move(expected),
          {.value = reported_us, .count = breakdown.accounted}};
}

}  // namespace canhil::checks
