// Whether the timing of a run can be judged at all.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bench/checks/finding.hpp"
#include "bench/checks/judge.hpp"

namespace canhil::checks {
namespace {

// The bench sends a few hundred frames a second. If the bench waits for a CPU for more than this fraction of
// the run, the machine is too busy for the bench, and also for a target on this machine.
constexpr double most_waited = 0.05;
// The largest permitted fraction of the machine's CPU time that the hypervisor gives to other guests. The
// programs on the machine cannot see at which moments the hypervisor does so.
constexpr double most_stolen = 0.05;

}  // namespace

std::string unfit_for_timing(const Observations& seen) {
  if (seen.receive_overflows > 0)
    return fmt::format("the bench's port lost {} frames", seen.receive_overflows);
  if (seen.target_frames_lost > 0)
    return fmt::format("{} frames of the target were lost", seen.target_frames_lost);
  const HostRecord& host = seen.host;
  if (host.clock_step_ns != 0)
    return fmt::format("the clock of the stamps was set by {:.3f} ms in mid-run",
                       static_cast<double>(host.clock_step_ns) * 1e-6);
  if (host.stolen_share > most_stolen)
    return fmt::format("the hypervisor gave {:.1f} % of this machine's CPU time to others",
                       host.stolen_share * 100);
  if (host.cpu_wait_s > most_waited * host.wall_s)
    return fmt::format("no CPU was free for the bench for {:.1f} % of the run",
                       host.cpu_wait_s / host.wall_s * 100);
  return "";
}

std::string seconds(const scenario::Window& window) {
  return fmt::format("from {:g} to {:g} s", static_cast<double>(window.from_us) * 1e-6,
                     static_cast<double>(window.to_us) * 1e-6);
}

std::string quantile_name(double quantile) {
  return quantile >= 1 ? "max" : fmt::format("{:g} % quantile", quantile * 100);
}

std::string unfit(const Evidence& evidence, double quantile, double bar_s) {
  if (!evidence.timing_unfit.empty()) return evidence.timing_unfit;
  const Histogram& lateness = evidence.seen.timing.lateness;
  if (lateness.count() == 0) return "the bench sent nothing";
  const double late_s = lateness.quantile_ns(quantile) * 1e-9;
  if (late_s <= lateness_share * bar_s) return "";
  return fmt::format("this host kept the bench itself {:.2f} ms late ({}), more than {:g} % of the limit",
                     late_s * 1e3, quantile_name(quantile), lateness_share * 100);
}

// A slow target computes or sleeps; it does not wait for a CPU. If it waited, the measured times contain the
// wait, so a check that passes needs no excuse.
Finding unless_target_waited(const Evidence& evidence, double quantile, double bar_s, Finding finding) {
  const double waited_s = evidence.target_wait.quantile_ns(quantile) * 1e-9;
  if (finding.outcome != Outcome::fail || waited_s <= lateness_share * bar_s) return finding;
  finding.outcome = Outcome::not_measured;
  finding.measured = fmt::format(
      "{}; on this host other programs kept the target waiting for a CPU for {:.2f} ms ({}), more than {:g} "
      "% "
      "of the limit",
      finding.measured, waited_s * 1e3, quantile_name(quantile), lateness_share * 100);
  return finding;
}

Finding unless_host_disturbed(const Evidence& evidence, double quantile, double bar_s, const Times& times,
                              Finding finding) {
  finding = unless_target_waited(evidence, quantile, bar_s, std::move(finding));
  if (finding.outcome != Outcome::fail) return finding;
  const double most_ns = lateness_share * bar_s * 1e9;
  const std::uint64_t late = times.bench_off.count_above(most_ns);
  const std::uint64_t waits = evidence.target_wait.count_above(most_ns);
  const auto permitted = times.count - nearest_rank(quantile, times.count) - times.missing;
  const std::uint64_t spoiled = late + times.per_wait * waits;
  if (spoiled == 0 || times.outside > permitted + spoiled) return finding;
  finding.outcome = Outcome::not_measured;
  finding.measured += fmt::format(
      "; {} of {} are beyond the limit, and this host can have caused {}: {} of the bench's stimuli were "
      "off, "
      "and other programs kept the target waiting for a CPU {} times, each by more than {:g} % of the limit",
      times.outside, times.count, std::min(times.outside, spoiled), late, waits, lateness_share * 100);
  return finding;
}

}  // namespace canhil::checks
