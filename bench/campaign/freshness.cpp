#include "bench/campaign/freshness.hpp"

#include <algorithm>
#include <cmath>

#include "bench/campaign/series.hpp"
#include "bench/checks/silence.hpp"
#include "messages/canhil.hpp"

namespace canhil::campaign {
namespace {

/// So many periods without a fix are no silence where each is lost with a probability: more in a row are not
/// to be expected in a campaign.
double periods_of_fixes(double loss_probability) {
  constexpr double improbable = 1e-6;
  constexpr double most_periods = 1e6;
  constexpr double without_loss = checks::tolerated_fixes + 1;
  if (loss_probability <= 0) return without_loss;
  if (loss_probability >= 1) return most_periods;
  return std::max(without_loss, std::ceil(std::log(improbable) / std::log(loss_probability)));
}

/// `cycle_us`: of the DBC, where the scenario says nothing.
double period_us(const scenario::Schedule& schedule, std::int64_t cycle_us) {
  return static_cast<double>(schedule.period_us.value_or(cycle_us));
}

double of_fixes(const scenario::Schedule& schedule, std::int64_t cycle_us,
                const scenario::FixFaults& faults) {
  const double lost = 1 - (1 - faults.loss_probability) * (1 - faults.invalid_probability);
  return checks::longest_wait_us(period_us(schedule, cycle_us), periods_of_fixes(lost)) +
         static_cast<double>(schedule.latency_us);
}

/// Where there are several sources, that which is heard least: the filter may use it alone.
double of_alignment(const scenario::Scenario& scenario) {
  double most_us = checks::longest_wait_us(0);
  const auto add = [&](double limit_us) { most_us = std::max(most_us, limit_us); };
  if (!scenario.runs("inflight_alignment")) {
    if (scenario.master_ins) {
      const scenario::Schedule& schedule = scenario.master_ins->schedule;
      add(checks::longest_wait_us(period_us(schedule, messages::MasterInsVelocityD::info.cycle_time_us)) +
          static_cast<double>(schedule.latency_us));
    }
    return most_us;
  }
  if (scenario.ssbl)
    add(of_fixes(scenario.ssbl->schedule, messages::SsblRelativeD::info.cycle_time_us,
                 scenario.ssbl->faults));
  if (scenario.gps)
    add(of_fixes(scenario.gps->schedule, messages::GpsTime::info.cycle_time_us, scenario.gps->faults));
  return most_us;
}

/// The filter may answer less often than it is told of the navigation.
double of_wind(const scenario::TargetSetup& target, const scenario::GliderNav& nav) {
  double answers_us = period_us(nav.schedule, messages::GliderNavVelocityD::info.cycle_time_us);
  for (const scenario::Parameter& parameter : target.parameters) {
    if (parameter.name == name_of(messages::Parameter::output_interval_ms))
      answers_us = std::max(answers_us, 1e3 * parameter.value);
  }
  return checks::longest_wait_us(answers_us);
}

Freshness of_los_rate(const world::EngagementPlan& plan, const scenario::Seeker& seeker) {
  const std::int64_t cycle_us = messages::SeekerRange::info.cycle_time_us;
  const double to_go_s = plan.range / (plan.missile_speed + plan.target_speed);  // at the start
  return {.age_limit_us = std::llround(checks::longest_wait_us(period_us(seeker.schedule, cycle_us))),
          .end_us = 0,
          .begin_us = -std::llround(to_go_s * 1e6),
          .sample_us = std::max(los_sample_us, seeker.schedule.period_us.value_or(cycle_us))};
}

}  // namespace

Freshness freshness_of(const scenario::Scenario& scenario) {
  switch (family_of(scenario)) {
    case Family::los_rate:
      return scenario.engagement && scenario.seeker ? of_los_rate(*scenario.engagement, *scenario.seeker)
                                                    : Freshness{};
    case Family::wind:
      return scenario.glider_nav
                 ? Freshness{.age_limit_us =
                                 std::llround(of_wind(scenario.targets.front(), *scenario.glider_nav)),
                             .end_us = scenario.duration_us}
                 : Freshness{};
    case Family::alignment:
      break;
  }
  return {.age_limit_us = std::llround(of_alignment(scenario)), .end_us = scenario.duration_us};
}

}  // namespace canhil::campaign
