// Whether the samples of the seeker fit into their signals, and the answers that guide its missile.
#include <fmt/format.h>

#include <type_traits>

#include "bench/nodes/bound_sensor.hpp"
#include "bench/nodes/fits.hpp"
#include "bench/nodes/is_whole.hpp"
#include "bench/nodes/wire_limits.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::nodes {

using namespace messages;

Result<void> seeker_fits(const NodeSettings& node, const scenario::Scenario& scenario,
                         const world::FlightRecord& /*flight*/) {
  const scenario::PlantFacts& missile = *scenario.plant_with(node.table().samples);
  const std::int64_t interval_us = node.period_us();
  if (auto checked = check_interval("key 'seeker.period_ms': seeker interval", interval_us,
                                    SeekerAngles::info, SeekerAngles::signals());
      !checked)
    return checked;
  const double roll = missile.largest_roll_rate * 1e-6 * static_cast<double>(interval_us);
  const SignalInfo& signal = SeekerAntenna::signals()[0];
  if (roll > signal.maximum) return failure(misfit("roll increment", roll, SeekerAntenna::info, signal));
  // In lockstep the bench receives an answer one Sync cycle after it sent the sample.
  const std::int64_t least_us = Sync::info.cycle_time_us;
  if (missile.guidance && missile.guidance->delay_us < least_us) {
    return failure(
        fmt::format("key '{}.guidance_delay_ms': {:g} is less than the bus takes in "
                    "lockstep, expected at least {:g}, the cycle of Sync",
                    missile.table->key, 1e-3 * static_cast<double>(missile.guidance->delay_us),
                    1e-3 * static_cast<double>(least_us)));
  }
  return {};
}

namespace {

constexpr bool is_estimate(LosRateOutcome outcome) {
  return outcome == LosRateOutcome::started || outcome == LosRateOutcome::start_up ||
         outcome == LosRateOutcome::updated || outcome == LosRateOutcome::coasting;
}

}  // namespace

// The guidance holds its command if the target has no estimate.
std::optional<sensors::Guidance> AnswerOfLosRate::take(const Frame& frame, std::int64_t near_us) {
  bool complete = false;
  const auto put = [&]<class Message>(std::type_identity<Message>) {
    complete = complete || (is_whole<Message>(frame) &&
                            group_.put(from_frame<Message>(frame), e2e::counter(frame.payload())) ==
                                decltype(group_)::Outcome::complete);
  };
  put(std::type_identity<LosRateEstimate>{});
  put(std::type_identity<LosRateSigma>{});
  put(std::type_identity<LosRateTarget>{});
  const auto& estimate = group_.get<LosRateEstimate>();
  const auto& target = group_.get<LosRateTarget>();
  if (!complete || !is_estimate(estimate.outcome) || estimate.blind != 0) return std::nullopt;
  return sensors::Guidance{
      .cause_us = unwrap_us(target.cause_time_us, near_us),
      .los_rate = {.pitch = estimate.los_rate_pitch_radps, .yaw = estimate.los_rate_yaw_radps},
      .acceleration = {.pitch = target.target_acceleration_z_mps2, .yaw = target.target_acceleration_y_mps2}};
}

}  // namespace canhil::nodes
