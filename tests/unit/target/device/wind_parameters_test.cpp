// Setting the parameters of the wind estimator over the bus.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "target/device/adapters.hpp"
#include "tests/unit/target/device/glider.hpp"

namespace canhil::target {
namespace {

using namespace messages;
using wind::FinFrame;
using wind::Navigation;

TEST(Wind, DefaultsAreThoseOfTheFilter) {
  const auto adapter = make_wind_adapter();
  ASSERT_TRUE(adapter->reset(Algorithm::ekf));
  const wind::Settings s;
  using P = Parameter;
  const std::pair<P, double> defaults[] = {{P::process_noise, 3},
                                           {P::coefficient_sigma_percent, 100 * s.coefficient_sigma},
                                           {P::air_velocity_noise_mpsprts, s.density.air_velocity},
                                           {P::body_rate_noise_degpsprts, s.density.rate / Glider::deg},
                                           {P::attitude_noise_degprts, s.density.attitude / Glider::deg},
                                           {P::wind_noise_mpsprts, s.density.wind},
                                           {P::glider_velocity_sigma_mps, s.velocity_sigma},
                                           {P::glider_rate_sigma_degps, s.rate_sigma / Glider::deg},
                                           {P::glider_attitude_sigma_deg, s.attitude_sigma / Glider::deg},
                                           {P::theta_per_s, s.theta_per_s},
                                           {P::theta_cap_per_s, s.theta_cap_per_s},
                                           {P::theta_rate_weight, s.rate_weight},
                                           {P::adaptation_time_s, s.adaptation_time},
                                           {P::adaptation_limit, s.adaptation_limit},
                                           {P::initial_air_velocity_sigma_mps, s.air_velocity_sigma_0},
                                           {P::initial_rate_sigma_degps, s.rate_sigma_0 / Glider::deg},
                                           {P::initial_wind_sigma_mps, s.wind_sigma_0},
                                           {P::fins_late_ms, 1e3 * s.fins_late},
                                           {P::fins_missing_ms, 1e3 * s.fins_missing},
                                           {P::glider_nav_coast_s, s.coast_limit},
                                           {P::glider_nav_stale_ms, 1e3 * s.stale_limit},
                                           {P::glider_nav_gate_mps, s.velocity_gate}};
  for (const auto& [parameter, value] : defaults) {
    ASSERT_TRUE(adapter->get(parameter)) << name_of(parameter);
    EXPECT_NEAR(*adapter->get(parameter), value, 1e-9 * (1 + value)) << name_of(parameter);
  }
}

TEST(Wind, RefusesParametersOutOfRangeOrTooLate) {
  Glider bench;
  const auto status = [&bench](Parameter parameter, float value) {
    bench.send(ParamSet{.parameter = parameter, .value = value});
    return bench.last<ParamAck>()->status;
  };
  EXPECT_EQ(status(Parameter::body_rate_noise_degpsprts, 0.05F), ParameterStatus::accepted);
  EXPECT_EQ(bench.last<ParamAck>()->value, 0.05F);
  EXPECT_EQ(status(Parameter::glider_velocity_sigma_mps, 0), ParameterStatus::out_of_range);
  EXPECT_EQ(bench.last<ParamAck>()->value, 0.25F);
  EXPECT_EQ(status(Parameter::wind_noise_mpsprts, std::nanf("")), ParameterStatus::out_of_range);
  EXPECT_EQ(status(Parameter::initial_wind_sigma_mps, 5), ParameterStatus::wrong_state);
  EXPECT_EQ(status(Parameter::h2_case, 1), ParameterStatus::unknown);
}

// Each parameter reaches the filter: two values of the parameter give different answers.
TEST(Wind, EveryParameterOfTheFilterActs) {
  const auto flight = [](const ParamSet& parameter) {
    Glider::Release release{.parameters = {}};
    using P = Parameter;
    const P p = parameter.parameter;
    if (p == P::theta_per_s || p == P::theta_cap_per_s || p == P::theta_rate_weight)
      release.algorithm = Algorithm::h_infinity;
    if (p == P::adaptation_time_s || p == P::adaptation_limit) {
      release.algorithm = Algorithm::adaptive_q;
      release.parameters.push_back({.parameter = P::body_rate_noise_degpsprts, .value = 0.05F});
    }
    release.air_velocity_known = p != P::initial_wind_sigma_mps;
    release.parameters.push_back(parameter);
    Glider bench(release);
    // Input for every rule: missing fins, and navigation that freezes, is missing, and jumps.
    bench.fly(0, 120, [](std::size_t k, Navigation& n, FinFrame& fins) {
      fins.arrives = k < 10 || k > 13;
      if (k >= 20 && k < 28) n = {n.t_us, {250, 50, 5}, {0, 0, 0}, {0, 0, 0}, n.altitude, true};
      if (k >= 40 && k < 60) n.t_us = -1;
      if (k == 80) n.v_eb_n.x() += 30;
    });
    std::vector<std::vector<std::uint8_t>> answers;
    for (const Frame& frame : bench.answers()) {
      if (frame.id >= WindVector::info.id && frame.id <= WindUpdate::info.id)
        answers.emplace_back(frame.payload().begin(), frame.payload().end());
    }
    return answers;
  };
  const auto with = [&flight](Parameter parameter, float value) {
    return flight({.parameter = parameter, .value = value});
  };
  using P = Parameter;
  for (const auto& [parameter, initial, other] :
       std::initializer_list<std::tuple<P, float, float>>{{P::process_noise, 0, 1},
                                                          {P::process_noise, 1, 2},
                                                          {P::process_noise, 2, 3},
                                                          {P::coefficient_sigma_percent, 5, 20},
                                                          {P::air_velocity_noise_mpsprts, 0.02F, 1},
                                                          {P::body_rate_noise_degpsprts, 0.2F, 1},
                                                          {P::attitude_noise_degprts, 0.01F, 1},
                                                          {P::wind_noise_mpsprts, 0.3F, 1},
                                                          {P::glider_velocity_sigma_mps, 0.25F, 1},
                                                          {P::glider_rate_sigma_degps, 0.125F, 1},
                                                          {P::glider_attitude_sigma_deg, 0.25F, 1},
                                                          {P::theta_per_s, 1.5F, 1},
                                                          {P::theta_cap_per_s, 2, 0.5F},
                                                          {P::theta_rate_weight, 1, 1e6F},
                                                          {P::adaptation_time_s, 0.3F, 3},
                                                          {P::adaptation_limit, 1e4F, 1},
                                                          {P::initial_air_velocity_sigma_mps, 1, 3},
                                                          {P::initial_rate_sigma_degps, 0.01F, 1},
                                                          {P::initial_wind_sigma_mps, 20, 5},
                                                          {P::fins_late_ms, 30, 300},
                                                          {P::fins_missing_ms, 100, 50},
                                                          {P::glider_nav_coast_s, 2, 0.2F},
                                                          {P::glider_nav_stale_ms, 100, 1e6F},
                                                          {P::glider_nav_gate_mps, 50, 20}})
    EXPECT_NE(with(parameter, initial), with(parameter, other)) << name_of(parameter);
}

}  // namespace
}  // namespace canhil::target
