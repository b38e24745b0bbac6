// The published test vector through the Device: the test sends the rows of the vector as frames and compares
// the answers with the states of the vector. The test is built twice: with the DBC, where the states agree
// within the rounding of the signals, and with a version of the DBC without rounding.
#include <gtest/gtest.h>

#include "tests/unit/target/device/glider.hpp"

namespace canhil::target {
namespace {

using namespace messages;

// In the published run, the fins keep the deflection of a row until the next row, but the target interpolates
// linearly between samples. Therefore the fins of a row are sent again 10 us before the next row: only 10 us
// are interpolated.
constexpr std::int64_t before_next_us = 10;

struct Misses {
  double air_velocity = 0, attitude_deg = 0, wind = 0, wind_sigma = 0;
};

Misses replayed(Algorithm algorithm, const std::string& name) {
  const wind::Settings& s = recorded().settings;
  const auto set = [](Parameter parameter, double value) {
    return ParamSet{.parameter = parameter, .value = static_cast<float>(value)};
  };
  Glider::Release release;
  release.algorithm = algorithm;
  release.parameters = {set(Parameter::process_noise, 0),
                        set(Parameter::air_velocity_noise_mpsprts, s.density.air_velocity),
                        set(Parameter::body_rate_noise_degpsprts, s.density.rate / Glider::deg),
                        set(Parameter::attitude_noise_degprts, s.density.attitude / Glider::deg),
                        set(Parameter::wind_noise_mpsprts, s.density.wind),
                        set(Parameter::theta_per_s, s.theta_per_s),
                        set(Parameter::theta_cap_per_s, s.theta_cap_per_s)};
  Glider bench(release);
  const std::size_t rows = recorded().y.size();
  for (std::size_t k = 0; k < rows; ++k) {
    bench.fly(k, k + 1);
    bench.fins(wind::RecordedRun::t_us(k + 1) - before_next_us, recorded().inputs[k].fins);
  }
  const auto winds = bench.winds();
  const auto air = bench.all<WindAirVelocity>();
  const auto attitudes = bench.all<WindAttitude>();
  const auto sigmas = bench.all<WindSigma>();
  const auto updates = bench.all<WindUpdate>();
  EXPECT_EQ(winds.size(), rows);
  if (winds.size() != rows) return {1, 1, 1, 1};
  Misses worst;
  const auto note = [](double& most, const Eigen::Vector3d& miss) {
    most = std::max(most, miss.cwiseAbs().maxCoeff());
  };
  for (std::size_t k = 0; k < rows; ++k) {
    EXPECT_EQ(updates[k].cause_time_us, wrap_us(wind::RecordedRun::t_us(k)));
    const wind::StateVector x = recorded().published(k, name + "_u");
    const wind::StateVector variance = recorded().published(k, name + "_Pu");
    note(worst.wind, winds[k] - x.tail<3>());
    note(worst.air_velocity,
         Eigen::Vector3d(air[k].air_velocity_x_mps, air[k].air_velocity_y_mps, air[k].air_velocity_z_mps) -
             x.head<3>());
    note(worst.attitude_deg,
         Eigen::Vector3d(attitudes[k].roll_deg, attitudes[k].pitch_deg, attitudes[k].heading_deg) -
             x.segment<3>(wind::attitude_at) / Glider::deg);
    note(worst.wind_sigma, Eigen::Vector3d(sigmas[k].wind_sigma_north_mps, sigmas[k].wind_sigma_east_mps,
                                           sigmas[k].wind_sigma_down_mps) -
                               variance.tail<3>().cwiseSqrt());
  }
  return worst;
}

// A constant elevator error of half a step, 0.01 deg, changes the lift by 0.3 % and thus the air speed of 250
// m/s by 0.16 %. The filter of this run trusts its model, so this error remains.
constexpr Misses allowed{.air_velocity = 0.4, .attitude_deg = 0.01, .wind = 0.4, .wind_sigma = 0.005};

void expect_within(const Misses& worst) {
  EXPECT_LT(worst.air_velocity, allowed.air_velocity);
  EXPECT_LT(worst.attitude_deg, allowed.attitude_deg);
  EXPECT_LT(worst.wind, allowed.wind);
  EXPECT_LT(worst.wind_sigma, allowed.wind_sigma);
}

TEST(WindVectorOnTheBus, EkfReplays) { expect_within(replayed(Algorithm::ekf, "ekf")); }

TEST(WindVectorOnTheBus, HInfinityReplays) { expect_within(replayed(Algorithm::h_infinity, "hinf")); }

}  // namespace
}  // namespace canhil::target
