#include "bench/checks/judge.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "bench/checks/bus_load.hpp"
#include "bench/checks/finding.hpp"
#include "bench/checks/fixes.hpp"
#include "bench/checks/los.hpp"
#include "bench/checks/other_senders.hpp"
#include "bench/checks/probability.hpp"
#include "bench/checks/silence.hpp"
#include "bench/checks/timing.hpp"
#include "bench/checks/wind.hpp"
#include "bench/checks/wire_bounds.hpp"

namespace canhil::checks {
namespace {

using messages::AlignUpdate;

// Degrees of freedom of a white statistic.
double dimension(scenario::Statistic statistic) {
  switch (statistic) {
    case scenario::Statistic::los_nis:
      return 2;
    case scenario::Statistic::wind_nis:
      return 9;
    default:
      return 3;
  }
}

// The bench must keep its own deadlines to judge those of the target: a host that keeps the bench waiting for
// more than this share of a bar, as often as the bar is judged for, may keep the target waiting just as long.
constexpr double lateness_share = 0.5;

double world::Euler::*member(scenario::AttitudeAxis axis) {
  switch (axis) {
    case scenario::AttitudeAxis::roll:
      return &world::Euler::roll;
    case scenario::AttitudeAxis::pitch:
      return &world::Euler::pitch;
    case scenario::AttitudeAxis::heading:
      break;
  }
  return &world::Euler::heading;
}

double component(const world::Vector3& v, scenario::VelocityAxis axis) {
  switch (axis) {
    case scenario::VelocityAxis::north:
      return v.x();
    case scenario::VelocityAxis::east:
      return v.y();
    case scenario::VelocityAxis::down:
      return v.z();
    case scenario::VelocityAxis::norm:
      break;
  }
  return v.norm();
}

std::string_view closing_of(scenario::Aligner aligner) {
  return aligner == scenario::Aligner::inflight_alignment ? messages::FixVelocityD::info.name
                                                          : messages::AlignVelocityD::info.name;
}

// Judges each kind of rule; an absent answer is a failure of the target, never a pass.
class Judge {
 public:
  explicit Judge(const Evidence& evidence)
      : evidence_(evidence),
        transfer_errors_(navigation_errors(evidence.seen.navigation, evidence.truth)),
        inflight_errors_(navigation_errors(evidence.seen.fix_navigation, evidence.truth)) {}

  Finding operator()(const scenario::AttitudeError& rule) const {
    const auto part = inside(errors_of(rule.of), rule.window);
    const std::string expected = fmt::format("|error| < {:g} {} {}", rule.below / rule.unit.factor,
                                             rule.unit.name, seconds(rule.window));
    if (auto gap = unanswered(part, rule.window, closing_of(rule.of)); !gap.empty())
      return {Outcome::fail, std::move(gap), expected};
    double worst = 0;
    for (const auto& error : part) worst = std::max(worst, std::abs(error.angles.*member(rule.axis)));
    return {pass_if(worst < rule.below),
            fmt::format("max {:.3f} {} of {}", worst / rule.unit.factor, rule.unit.name, part.size()),
            expected};
  }

  Finding operator()(const scenario::Convergence& rule) const {
    const auto t_us = convergence_us(errors_of(rule.of), member(rule.axis), rule.within);
    const std::string expected =
        fmt::format("within {:g} {} for good before {:g} s", rule.within / rule.unit.factor, rule.unit.name,
                    static_cast<double>(rule.before_us) * 1e-6);
    const scenario::Window to_the_end{rule.before_us, evidence_.duration_us};
    if (auto gap = unanswered(inside(errors_of(rule.of), to_the_end), to_the_end, closing_of(rule.of));
        !gap.empty()) {
      return {Outcome::fail, std::move(gap), expected};
    }
    if (!t_us) return {Outcome::fail, "not within at the end", expected};
    return {pass_if(*t_us < rule.before_us), fmt::format("{:.2f} s", static_cast<double>(*t_us) * 1e-6),
            expected};
  }

  Finding operator()(const scenario::VelocityError& rule) const {
    const auto part = inside(errors_of(rule.of), rule.window);
    const std::string expected = fmt::format("|error| < {:g} m/s {}", rule.below, seconds(rule.window));
    if (auto gap = unanswered(part, rule.window, closing_of(rule.of)); !gap.empty())
      return {Outcome::fail, std::move(gap), expected};
    double worst = 0;
    for (const auto& error : part) worst = std::max(worst, std::abs(component(error.v_eb_n, rule.axis)));
    return {pass_if(worst < rule.below), fmt::format("max {:.4f} m/s of {}", worst, part.size()), expected};
  }

  Finding operator()(const scenario::Consistency& rule) const {
    const auto part = inside(series_of(rule), rule.window);
    const auto [low, high] = interval(rule, part.size());
    const std::string expected =
        fmt::format("mean between {:.3g} and {:.3g} {}", low, high, seconds(rule.window));
    if (auto gap = unanswered_updates(part, rule); !gap.empty())
      return {Outcome::fail, std::move(gap), expected};
    const double sum = std::accumulate(part.begin(), part.end(), 0.0,
                                       [](double s, const Normalised& n) { return s + n.value; });
    const double mean = sum / static_cast<double>(part.size());
    return {pass_if(mean >= low && mean <= high), fmt::format("mean {:.3f} of {}", mean, part.size()),
            expected};
  }

  Finding operator()(const scenario::OutputPeriod& rule) const {
    const double nominal = nominal_period_s(evidence_.seen, rule.message);
    const std::string expected =
        fmt::format("{} every {:g} ms +- {:g} % ({}) {}", rule.message, nominal * 1e3, rule.within * 100,
                    quantile_name(rule.quantile), seconds(rule.window));
    if (nominal <= 0) return {Outcome::not_measured, "the message has no period", expected};
    if (auto why = unfit(rule.quantile, nominal * rule.within); !why.empty()) {
      return {Outcome::not_measured, std::move(why), expected};
    }
    const TimedWindow* timed = find_window(evidence_.seen.timing, rule.message, rule.window);
    if (timed == nullptr) return {Outcome::not_measured, "no times were taken", expected};
    // A bench that would fail the check itself cannot fail the target by it.
    if (const double off_s = timed->stimulus_deviation.quantile_ns(rule.quantile) * 1e-9;
        off_s > lateness_share * nominal * rule.within) {
      return {Outcome::not_measured, fmt::format("the bench's own stimuli came {:.3f} ms off", off_s * 1e3),
              expected};
    }
    if (timed->period.count() == 0) return {Outcome::fail, "fewer than two arrivals", expected};
    const PeriodDeviation off =
        period_deviation(timed->period, nominal, ended_before_s(evidence_.seen, *timed), rule.quantile);
    return {pass_if(off.off_s <= nominal * rule.within),
            fmt::format("{:.3f} ms off, of {}", off.off_s * 1e3, off.count), expected};
  }

  Finding operator()(const scenario::Latency& rule) const {
    const double bar_s = static_cast<double>(rule.below_us) * 1e-6;
    const std::string expected = fmt::format("{} {} < {:g} ms {}", rule.message, quantile_name(rule.quantile),
                                             bar_s * 1e3, seconds(rule.window));
    if (auto why = unfit(rule.quantile, bar_s); !why.empty()) {
      return {Outcome::not_measured, std::move(why), expected};
    }
    const TimedWindow* timed = find_window(evidence_.seen.timing, rule.message, rule.window);
    if (timed == nullptr) return {Outcome::not_measured, "no times were taken", expected};
    if (timed->latency.count() == 0) return {Outcome::fail, "no answers", expected};
    const double value = timed->latency.quantile_ns(rule.quantile) * 1e-9;
    return {pass_if(value < bar_s), fmt::format("{:.3f} ms of {}", value * 1e3, timed->latency.count()),
            expected};
  }

  Finding operator()(const scenario::Counters& rule) const {
    if (!evidence_.seen.counters) return {Outcome::fail, "no TargetCounters", "counters reported"};
    const messages::TargetCounters& counters = *evidence_.seen.counters;
    return within_limits(
        std::array<Limit, 4>{{{"frames lost", rule.frames_lost_at_most, counters.frames_lost},
                              {"bad CRC", rule.bad_crc_at_most, counters.bad_crc},
                              {"bad groups", rule.bad_group_at_most, counters.bad_group},
                              {"late", rule.late_at_most, counters.late}}});
  }

  Finding operator()(const scenario::BusErrorLimits& rule) const {
    const BusRecord& bus = evidence_.seen.bus;
    const BusErrors& errors = bus.errors;
    Finding finding = within_limits(
        std::array<Limit, 6>{{{"bus off", rule.bus_off_at_most, errors.bus_off},
                              {"interface down", rule.down_at_most, bus.downs},
                              {"error passive", rule.passive_at_most, errors.passive},
                              {"error warning", rule.warning_at_most, errors.warning},
                              {"error frames", rule.error_frames_at_most, errors.frames},
                              {"late in transmit queue", rule.late_in_queue_at_most, bus.late_in_queue}}});
    if (finding.outcome != Outcome::pass || bus.reports_errors || errors.frames > 0) return finding;
    return {Outcome::not_measured, "this bus reports no errors: it has no controller and no wire",
            std::move(finding.expected)};
  }

  Finding operator()(const scenario::WireResponse& rule) const {
    constexpr double bar_s = 1e-3;
    Finding finding = checks::judge(rule, evidence_.seen);
    if (finding.outcome != Outcome::fail) return finding;
    // A host that stops a program between two frames makes them late through no fault of the bus.
    if (auto why = unfit(1, bar_s); !why.empty())
      return {Outcome::not_measured, std::move(why), std::move(finding.expected)};
    return finding;
  }
  Finding operator()(const scenario::BusLoad& rule) const { return checks::judge(rule, evidence_.seen); }
  Finding operator()(const scenario::PositionError& rule) const {
    return checks::judge(rule, evidence_.seen, evidence_.truth);
  }
  Finding operator()(const scenario::Fixes& rule) const { return checks::judge(rule, evidence_.seen); }
  Finding operator()(const scenario::Coasting& rule) const { return checks::judge(rule, evidence_.seen); }
  Finding operator()(const scenario::WindError& rule) const {
    return checks::judge(rule, evidence_.seen, evidence_.glide);
  }
  Finding operator()(const scenario::WindAnswers& rule) const { return checks::judge(rule, evidence_.seen); }
  Finding operator()(const scenario::LosRateError& rule) const {
    return checks::judge(rule, evidence_.seen, evidence_.engagement);
  }
  Finding operator()(const scenario::MissDistance& rule) const {
    return checks::judge(rule, evidence_.engagement);
  }

  Finding operator()(const scenario::Heartbeat& rule) const {
    const std::string expected =
        fmt::format("never silent for more than {:g} s", static_cast<double>(rule.silent_at_most_us) * 1e-6);
    if (auto why = unfit(1, static_cast<double>(rule.silent_at_most_us) * 1e-6); !why.empty()) {
      return {Outcome::not_measured, std::move(why), expected};
    }
    const double gap_s = longest_silence_s(evidence_.seen, messages::TargetHeartbeat::info.name);
    return {pass_if(gap_s * 1e6 <= static_cast<double>(rule.silent_at_most_us)),
            fmt::format("longest gap {:.3f} s", gap_s), expected};
  }

 private:
  struct Limit {
    std::string_view what;
    std::optional<std::int64_t> at_most;  // none: not judged
    std::uint64_t value;
  };
  static Finding within_limits(std::span<const Limit> limits) {
    Finding finding{.outcome = Outcome::pass, .measured = "", .expected = ""};
    for (const Limit& limit : limits) {
      if (!limit.at_most) continue;
      const std::string_view separator = finding.expected.empty() ? "" : ", ";
      finding.expected += fmt::format("{}{} <= {}", separator, limit.what, *limit.at_most);
      finding.measured += fmt::format("{}{} {}", separator, limit.what, limit.value);
      if (std::cmp_greater(limit.value, *limit.at_most)) finding.outcome = Outcome::fail;
    }
    return finding;
  }

  static std::string quantile_name(double q) {
    return q >= 1 ? "max" : fmt::format("{:g} % quantile", q * 100);
  }

  [[nodiscard]] const std::vector<NavigationError>& errors_of(scenario::Aligner aligner) const {
    return aligner == scenario::Aligner::inflight_alignment ? inflight_errors_ : transfer_errors_;
  }

  // Where in the window answers are missing; empty: nowhere.
  template <class Series>
  [[nodiscard]] std::string unanswered(const Series& part, const scenario::Window& window,
                                       std::string_view message) const {
    if (part.empty()) return "no answers";
    std::vector<std::int64_t> times;
    for (const auto& item : part) times.push_back(item.t_us);
    const auto silent = silent_stretch(times, window, evidence_.duration_us,
                                       longest_wait_us(1e6 * nominal_period_s(evidence_.seen, message)));
    return silent ? "no answers " + seconds(*silent) : std::string();
  }

  // Why timing with this bar cannot be judged; empty: it can.
  [[nodiscard]] std::string unfit(double q, double bar_s) const {
    if (!evidence_.timing_unfit.empty()) return evidence_.timing_unfit;
    const Histogram& lateness = evidence_.seen.timing.lateness;
    if (lateness.count() == 0) return "the bench sent nothing";
    const double late_s = lateness.quantile_ns(q) * 1e-9;
    if (late_s <= lateness_share * bar_s) return "";
    return fmt::format("this host kept the bench itself {:.2f} ms late ({}), more than {:g} % of the bar",
                       late_s * 1e3, quantile_name(q), lateness_share * 100);
  }

  // Fixes may be lost on purpose: what the bench did not send needs no answer.
  [[nodiscard]] std::string unanswered_updates(const std::vector<Normalised>& part,
                                               const scenario::Consistency& rule) const {
    if (part.empty()) return "no answers";
    if (rule.statistic == scenario::Statistic::wind_nis || rule.statistic == scenario::Statistic::wind_nees)
      return unanswered(part, rule.window, messages::WindUpdate::info.name);
    if (rule.statistic == scenario::Statistic::los_nis)
      return unanswered(part, until_passage(rule.window), messages::LosRateTarget::info.name);
    return rule.of == scenario::Aligner::transfer_alignment
               ? unanswered(part, rule.window, AlignUpdate::info.name)
               : unanswered_fixes(evidence_.seen, rule.window);
  }

  // A seeker is silent once its missile has passed the target.
  [[nodiscard]] scenario::Window until_passage(scenario::Window window) const {
    if (evidence_.engagement != nullptr && evidence_.engagement->miss_n)
      window.to_us = std::min(window.to_us, evidence_.engagement->passage_us);
    return window;
  }

  [[nodiscard]] std::vector<Normalised> series_of(const scenario::Consistency& rule) const {
    switch (rule.statistic) {
      case scenario::Statistic::nis:
        return nis(evidence_.seen, rule.of);
      case scenario::Statistic::wind_nis:
        return wind_nis(evidence_.seen);
      case scenario::Statistic::wind_nees:
        return evidence_.glide == nullptr ? std::vector<Normalised>()
                                          : wind_nees(evidence_.seen, *evidence_.glide);
      case scenario::Statistic::los_nis:
        return los_nis(evidence_.seen);
      case scenario::Statistic::heading_nees:
        return heading_nees(evidence_.seen, rule.of, errors_of(rule.of));
      case scenario::Statistic::attitude_nees:
        break;
    }
    return attitude_nees(evidence_.seen, errors_of(rule.of));
  }

  // The mean of n independent chi-squares of k degrees of freedom is chi-square of n k, divided by n.
  static std::pair<double, double> interval(const scenario::Consistency& rule, std::size_t count) {
    if (const auto* between = std::get_if<scenario::MeanBetween>(&rule.bound))
      return {between->low, between->high};
    const double probability = std::get<scenario::Probability>(rule.bound).value;
    const auto n = static_cast<double>(std::max<std::size_t>(count, 1));
    const double degrees_of_freedom = n * dimension(rule.statistic);
    return {chi_squared_quantile(degrees_of_freedom, (1 - probability) / 2) / n,
            chi_squared_quantile(degrees_of_freedom, (1 + probability) / 2) / n};
  }

  const Evidence& evidence_;
  std::vector<NavigationError> transfer_errors_;
  std::vector<NavigationError> inflight_errors_;
};

// A bus that failed fails a run that says nothing of it.
std::optional<scenario::Check> bus_check(const scenario::Scenario& scenario, const Judge& judge) {
  const bool said = std::ranges::any_of(scenario.checks, [](const scenario::Check& check) {
    return std::holds_alternative<scenario::BusErrorLimits>(check.rule);
  });
  const scenario::BusErrorLimits rule;
  if (said || judge(rule).outcome != Outcome::fail) return std::nullopt;
  return scenario::Check{.name = std::string(rule.kind), .requirement = "", .rule = rule};
}

}  // namespace

std::string seconds(const scenario::Window& window) {
  return fmt::format("from {:g} to {:g} s", static_cast<double>(window.from_us) * 1e-6,
                     static_cast<double>(window.to_us) * 1e-6);
}

Verdict judge(const scenario::Scenario& scenario, const Evidence& evidence) {
  Verdict verdict;
  const Judge judge(evidence);
  std::vector<scenario::Check> all = scenario.checks;
  if (auto implied = bus_check(scenario, judge)) all.push_back(std::move(*implied));
  for (const scenario::Check& check : all) {
    Finding finding = std::visit(judge, check.rule);
    if (!evidence.ended_early.empty()) {  // what was seen until then proves nothing either way
      finding.outcome = Outcome::not_measured;
      finding.measured = "the run ended early";
    }
    verdict.checks.push_back({.name = check.name,
                              .kind = std::string(scenario::kind(check)),
                              .requirement = check.requirement,
                              .outcome = finding.outcome,
                              .measured = std::move(finding.measured),
                              .expected = std::move(finding.expected)});
  }
  // With others on the bus in their names, neither bench nor target can be shown to have met a check.
  if (std::string others = other_senders(evidence.seen); !others.empty()) {
    verdict.checks.push_back({.name = std::string(senders_kind),
                              .kind = std::string(senders_kind),
                              .requirement = "",
                              .outcome = Outcome::not_measured,
                              .measured = std::move(others),
                              .expected = "each message from its own sender alone"});
  }
  conclude(verdict, evidence.ended_early);
  return verdict;
}

}  // namespace canhil::checks
