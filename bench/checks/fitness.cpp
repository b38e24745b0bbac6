// Whether the timing of a run can be judged at all.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bench/checks/finding.hpp"
#include "bench/checks/judge.hpp"
#include "bench/world/plant_record.hpp"

namespace canhil::checks {
namespace {

// The bench sends a few hundred frames a second. If the bench waits for a CPU for more than this fraction of
// the run, the machine is too busy for the bench, and also for a target on this machine.
constexpr double most_waited = 0.05;
// The largest permitted fraction of the machine's CPU time that the hypervisor gives to other guests. The
// programs on the machine cannot see at which moments the hypervisor does so.
constexpr double most_stolen = 0.05;

// How many values the delays above `most_s` can have spoiled. A delay spoils the values that fall into it and
// one more: a late message spoils the period that it ends and the one that it begins. `longest_s`: the part
// of a longer delay that counts, because its other parts count as delays of their own.
std::uint64_t spoiled_by(const Histogram& delays, double most_s, double nominal_s,
                         double longest_s = HUGE_VAL) {
  double values = 0;
  for (const Histogram::Bucket& bucket : delays.buckets()) {
    const double delay_s = bucket_middle_us(bucket.from_us) * 1e-6;
    if (delay_s <= most_s) continue;
    const double in_delay = nominal_s > 0 ? std::ceil(std::min(delay_s, longest_s) / nominal_s) : 1;
    values += static_cast<double>(bucket.count) * (in_delay + 1);
  }
  return static_cast<std::uint64_t>(values);
}

// Names the option that would help against a busy host, where it was not given.
std::string remedy(const HostRecord& host) { return host.may_be_realtime ? "; --realtime would help" : ""; }

}  // namespace

std::string unfit_for_timing(const Observations& seen) {
  if (seen.receive_overflows > 0)
    return fmt::format("the bench's port lost {} frames", seen.receive_overflows);
  if (seen.lost_from_target() > 0)
    return fmt::format("{} frames of the target were lost", seen.lost_from_target());
  const HostRecord& host = seen.host;
  if (host.clock_step_ns != 0)
    return fmt::format("the clock of the stamps was set by {:.3f} ms in mid-run",
                       static_cast<double>(host.clock_step_ns) * 1e-6);
  if (host.stolen_share > most_stolen)
    return fmt::format("the hypervisor gave {:.1f} % of this machine's CPU time to others",
                       host.stolen_share * 100);
  if (host.cpu_wait_s > most_waited * host.wall_s)
    return fmt::format("no CPU was free for the bench for {:.1f} % of the run{}",
                       host.cpu_wait_s / host.wall_s * 100, remedy(host));
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
  return fmt::format("this host kept the bench itself {:.2f} ms late ({}), more than {:g} % of the limit{}",
                     late_s * 1e3, quantile_name(quantile), lateness_share * 100, remedy(evidence.seen.host));
}

std::string late_loop(const Evidence& evidence) {
  constexpr double usual = 0.99;  // quantile; a single late frame changes little
  const world::PlantRecord* plant = world::steered(evidence.truth.plants);
  if (plant == nullptr) return "";
  if (evidence.timing_unfit == virtual_time) {
    const auto open =
        std::ranges::find_if(plant->commands, [](const auto& one) { return !one.unawaited.empty(); });
    if (open == plant->commands.end()) return "";
    return fmt::format(
        "in lockstep the bench does not wait for {}, which answers no play and carries the "
        "command '{}': no two such flights are equal",
        open->unawaited, open->input);
  }
  const double step_s = 1e-6 * static_cast<double>(plant->commands.front().step_us);
  const double late_s = evidence.seen.timing.lateness.quantile_ns(usual) * 1e-9;
  if (late_s <= step_s) return "";
  return fmt::format("the bench itself was {:.2f} ms late ({}), more than a step of the plant", late_s * 1e3,
                     quantile_name(usual));
}

// A slow target computes or sleeps; it does not wait for a CPU. If it waited, the measured times contain the
// wait, so a check that passes needs no excuse.
Finding unless_target_delayed(const Evidence& evidence, double quantile, double bar_s, Finding finding) {
  if (finding.outcome != Outcome::fail) return finding;
  const double waited_s = evidence.delays.waits.quantile_ns(quantile) * 1e-9;
  const double stalled_s = evidence.delays.stalls.quantile_ns(quantile) * 1e-9;
  if (std::max(waited_s, stalled_s) <= lateness_share * bar_s) return finding;
  finding.outcome = Outcome::not_measured;
  finding.measured += fmt::format("; on this host {} for {:.2f} ms ({}), more than {:g} % of the limit{}",
                                  waited_s >= stalled_s ? "other programs kept the target waiting for a CPU"
                                                        : "no program could run on a CPU of the target",
                                  std::max(waited_s, stalled_s) * 1e3, quantile_name(quantile),
                                  lateness_share * 100, remedy(evidence.seen.host));
  return finding;
}

Finding unless_host_disturbed(const Evidence& evidence, double quantile, double bar_s, const Times& times,
                              Finding finding) {
  if (finding.outcome != Outcome::fail) return finding;
  const double most_s = lateness_share * bar_s;
  const auto& [waits, stalls] = evidence.delays;
  const std::uint64_t late = times.bench_off.count_above(most_s * 1e9);
  const std::uint64_t delayed =
      spoiled_by(waits, most_s, times.nominal_s, 1e-3 * TargetDelays::part.count()) +
      spoiled_by(stalls, most_s, times.nominal_s);
  const auto permitted = times.count - nearest_rank(quantile, times.count) - times.missing;
  if (late + delayed == 0 || times.outside > permitted + late + delayed) return finding;
  finding = unless_target_delayed(evidence, quantile, bar_s, std::move(finding));
  if (finding.outcome != Outcome::fail) return finding;
  finding.outcome = Outcome::not_measured;
  finding.measured += fmt::format(
      "; {} of {} are beyond the limit, and this host can have caused {}: {} of the bench's stimuli were "
      "off, and the target had no CPU {} times, each by more than {:g} % of the limit{}",
      times.outside, times.count, std::min(times.outside, late + delayed), late,
      waits.count_above(most_s * 1e9) + stalls.count_above(most_s * 1e9), lateness_share * 100,
      remedy(evidence.seen.host));
  return finding;
}

}  // namespace canhil::checks
