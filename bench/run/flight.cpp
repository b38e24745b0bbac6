#include "bench/run/flight.hpp"

#include <fmt/format.h>

#include "bench/nodes/fins.hpp"
#include "bench/nodes/glider_nav.hpp"
#include "bench/nodes/gps.hpp"
#include "bench/nodes/master_ins.hpp"
#include "bench/nodes/seeker.hpp"
#include "bench/nodes/slave_imu.hpp"
#include "bench/nodes/ssbl.hpp"
#include "bench/nodes/time_keeper.hpp"
#include "bench/run/wire_limits.hpp"

namespace canhil::run {
namespace {

/// What a carrier tells a glider that it lets go: the truth with the errors that this run draws.
InitialState state_at_release(const world::GlideRecord& glide, const scenario::Glide& config,
                              const scenario::InitialSigma& sigma, world::Stream& stream) {
  const world::GlideTruth& truth = glide.epochs().front();
  const scenario::ReleaseError& error = config.release;
  const world::Vector3 turn = error.attitude * stream.normal3();
  world::Euler angles = world::euler_from(truth.C_bn);
  angles = {angles.roll + turn.x(), angles.pitch + turn.y(), angles.heading + turn.z()};
  InitialState state = initial_state({.t_us = truth.t_us,
                                      .position = {.height = truth.height},
                                      .v_eb_n = truth.v_eb_n + error.velocity * stream.normal3(),
                                      .C_bn = C_bn_from(angles)},
                                     sigma);
  const world::Vector3 rates = truth.omega_nb_b + error.rate * stream.normal3();
  state.air = initial_air(rates, truth.v_a + error.air_velocity * stream.normal3());
  return state;
}

Result<OwnTruth> make_own_truth(const scenario::Scenario& scenario, std::uint64_t run_index) {
  OwnTruth own;
  if (scenario.glide) {
    const auto stream = [&](std::string_view name) { return world::Stream(scenario.seed, run_index, name); };
    own.glide.emplace(scenario.glide->plan, scenario.duration_us, stream("glide.coefficients"),
                      stream("glide.gusts"));
    const double missing_s = 1e-6 * static_cast<double>(scenario.duration_us - own.glide->end_us());
    if (missing_s >= 1e-6 * static_cast<double>(world::GlideRecord::step_us)) {
      return failure(
          fmt::format("key 'duration_s': the glide of run {} ends {:g} s before it, at a height of {:.0f} m, "
                      "expected to be in the air to the end",
                      run_index, missing_s, own.glide->epochs().back().height));
    }
  }
  if (scenario.engagement) own.engagement.emplace();
  return own;
}

}  // namespace

estimators::Truth truth_of(const world::FlightRecord& flight, const OwnTruth& own, std::int64_t duration_us) {
  return {.flight = flight,
          .duration_us = duration_us,
          .engagement = own.engagement ? &*own.engagement : nullptr,
          .glide = own.glide ? &*own.glide : nullptr};
}

Result<world::FlightRecord> make_truth(const scenario::Scenario& scenario) {
  const std::int64_t cycle_us = messages::SlaveImuStatus::info.cycle_time_us;
  const std::int64_t period_us =
      scenario.slave_imu ? scenario.slave_imu->schedule.period_us.value_or(cycle_us) : cycle_us;
  if (auto fits = check_fits_imu_interval(period_us); !fits) return tl::unexpected(fits.error());
  world::FlightRecord truth(scenario.truth, scenario.duration_us, period_us);
  if (scenario.slave_imu) {
    if (auto fits = check_fits(scenario.slave_imu->errors, truth); !fits) return tl::unexpected(fits.error());
  }
  if (scenario.engagement && scenario.seeker) {
    if (auto fits = check_fits(*scenario.engagement, *scenario.seeker); !fits)
      return tl::unexpected(fits.error());
  }
  // What every run tells its target; its draws are checked run by run.
  for (const scenario::TargetSetup& target : scenario.targets) {
    world::Stream none(0, 0, "none");
    const auto start = initial_solution(truth.epochs().front(), world::InitialErrorModel{}, none);
    if (auto fits = check_fits(initial_state(start, target.initial_sigma)); !fits)
      return tl::unexpected(fits.error());
  }
  return truth;
}

Result<Flight> make_flight(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                           std::uint64_t run_index) {
  auto own_truth = make_own_truth(scenario, run_index);
  if (!own_truth) return tl::unexpected(own_truth.error());
  Flight flight{.own_truth = std::move(*own_truth), .initial = {}};
  const auto& glide = flight.own_truth.glide;
  for (const scenario::TargetSetup& target : scenario.targets) {
    world::Stream stream(scenario.seed, run_index, "initial_error");
    const world::InitialErrorModel error = target.initial_error.value_or(scenario.initial_error);
    flight.initial.push_back(
        glide && target.estimator == "wind"
            ? state_at_release(*glide, *scenario.glide, target.initial_sigma, stream)
            : initial_state(initial_solution(truth.epochs().front(), error, stream), target.initial_sigma));
    if (auto fits = check_fits(flight.initial.back()); !fits) return tl::unexpected(fits.error());
  }
  return flight;
}

Schedule make_schedule(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                       OwnTruth& own_truth, std::uint64_t run_index, bool lockstep, Rounding rounding) {
  std::vector<std::unique_ptr<nodes::Node>> sensors;
  const auto stream = [&](std::string_view name) { return world::Stream(scenario.seed, run_index, name); };
  if (scenario.slave_imu) {
    sensors.push_back(std::make_unique<nodes::SlaveImu>(truth, *scenario.slave_imu, stream("slave_imu"),
                                                        stream("slave_imu.loss")));
  }
  if (scenario.master_ins) {
    sensors.push_back(std::make_unique<nodes::MasterIns>(truth, *scenario.master_ins, stream("master_ins"),
                                                         stream("master_ins.loss")));
  }
  if (scenario.ssbl) sensors.push_back(std::make_unique<nodes::Ssbl>(truth, *scenario.ssbl, stream("ssbl")));
  if (scenario.gps) sensors.push_back(std::make_unique<nodes::Gps>(truth, *scenario.gps, stream("gps")));
  // Fins first: the deflection of an instant is there when its navigation is whole.
  if (own_truth.glide && scenario.fins) {
    sensors.push_back(
        std::make_unique<nodes::Fins>(*own_truth.glide, *scenario.fins, stream("fins.loss"), truth.end_us()));
  }
  if (own_truth.glide && scenario.glider_nav) {
    sensors.push_back(std::make_unique<nodes::GliderNav>(*own_truth.glide, *scenario.glider_nav,
                                                         stream("glider_nav"), stream("glider_nav.loss"),
                                                         truth.end_us()));
  }
  if (own_truth.engagement && scenario.seeker) {
    const nodes::SeekerStreams streams{
        .engagement = stream("engagement"), .errors = stream("seeker"), .faults = stream("seeker.faults")};
    sensors.push_back(std::make_unique<nodes::Seeker>(*scenario.engagement, *scenario.seeker, streams,
                                                      truth.end_us(), *own_truth.engagement));
  }
  return {std::move(sensors), std::make_unique<nodes::TimeKeeper>(truth.end_us(), lockstep), rounding};
}

}  // namespace canhil::run
