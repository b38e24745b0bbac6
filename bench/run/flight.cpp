#include "bench/run/flight.hpp"

#include "bench/nodes/gps.hpp"
#include "bench/nodes/master_ins.hpp"
#include "bench/nodes/seeker.hpp"
#include "bench/nodes/slave_imu.hpp"
#include "bench/nodes/ssbl.hpp"
#include "bench/nodes/time_keeper.hpp"
#include "bench/run/wire_limits.hpp"

namespace canhil::run {

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
  return truth;
}

OwnTruth make_own_truth(const scenario::Scenario& scenario) {
  OwnTruth own;
  if (scenario.engagement) own.engagement.emplace();
  return own;
}

Result<InitialState> make_initial_state(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                                        std::uint64_t run_index) {
  world::Stream stream(scenario.seed, run_index, "initial_error");
  InitialState state = initial_state(initial_solution(truth.epochs().front(), scenario.initial_error, stream),
                                     scenario.target.initial_sigma);
  if (auto fits = check_fits(state); !fits) return tl::unexpected(fits.error());
  return state;
}

Schedule make_schedule(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                       OwnTruth& own_truth, std::uint64_t run_index, bool lockstep) {
  std::vector<std::unique_ptr<nodes::Node>> sensors;
  const auto stream = [&](std::string_view name) { return world::Stream(scenario.seed, run_index, name); };
  if (scenario.slave_imu) {
    sensors.push_back(std::make_unique<nodes::SlaveImu>(truth, *scenario.slave_imu, stream("slave_imu"),
                                                        stream("slave_imu.loss")));
  }
  if (scenario.master_ins) {
    sensors.push_back(std::make_unique<nodes::MasterIns>(truth, *scenario.master_ins, stream("master_ins")));
  }
  if (scenario.ssbl) sensors.push_back(std::make_unique<nodes::Ssbl>(truth, *scenario.ssbl, stream("ssbl")));
  if (scenario.gps) sensors.push_back(std::make_unique<nodes::Gps>(truth, *scenario.gps, stream("gps")));
  if (own_truth.engagement && scenario.seeker) {
    const nodes::SeekerStreams streams{
        .engagement = stream("engagement"), .errors = stream("seeker"), .faults = stream("seeker.faults")};
    sensors.push_back(std::make_unique<nodes::Seeker>(*scenario.engagement, *scenario.seeker, streams,
                                                      truth.end_us(), *own_truth.engagement));
  }
  return {std::move(sensors), std::make_unique<nodes::TimeKeeper>(truth.end_us(), lockstep)};
}

}  // namespace canhil::run
