#include "bench/doctor/jitter.hpp"

#include <fmt/format.h>

#include <ctime>
#include <numeric>

#include "dbc/ports/port.hpp"
#include "dbc/realtime/wake_ups.hpp"

namespace canhil::doctor {
namespace {

constexpr double good_p99_s = 100e-6, good_max_s = 1e-3;  // p99: a tenth of a period; maximum: one period
constexpr double weak_p99_s = 1e-3;

}  // namespace

std::vector<double> measure_jitter(std::int64_t duration_ns, const std::function<bool()>& stop) {
  std::vector<double> late_s;
  late_s.reserve(static_cast<std::size_t>(duration_ns / jitter_period_ns) + 1);
  const std::int64_t end_ns = clock_ns(CLOCK_MONOTONIC) + jitter_period_ns + duration_ns;
  realtime::wake_each(
      jitter_period_ns, [&](std::int64_t due_ns) { return due_ns < end_ns && !stop(); },
      [&](std::int64_t late_ns) { late_s.push_back(static_cast<double>(late_ns) * 1e-9); });
  return late_s;
}

Line jitter_line(const std::vector<double>& late_s, const std::string& conditions) {
  const checks::Distribution d = checks::distribution(late_s);
  if (d.count == 0) return {Grade::weak, "timer jitter", "not measured", "let it run to its end"};
  const std::string found =
      fmt::format("min {:.0f} avg {:.0f} p99 {:.0f} max {:.0f} us of {} wake-ups ({})", d.min * 1e6,
                  mean(late_s) * 1e6, d.p99 * 1e6, d.max * 1e6, d.count, conditions);
  if (d.p99 <= good_p99_s && d.max <= good_max_s) return {Grade::good, "timer jitter", found};
  if (d.p99 <= weak_p99_s)
    return {Grade::weak, "timer jitter", found,
            "a kernel with PREEMPT_RT, --realtime, a CPU of its own (--cpu), nothing else at work"};
  return {
      Grade::bad, "timer jitter", found,
      "real hardware instead of a shared or emulated machine; here outputs can be judged, and timing not"};
}

double mean(const std::vector<double>& sample) {
  if (sample.empty()) return 0;
  return std::accumulate(sample.begin(), sample.end(), 0.0) / static_cast<double>(sample.size());
}

}  // namespace canhil::doctor
