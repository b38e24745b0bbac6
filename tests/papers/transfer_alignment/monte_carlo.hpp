#pragma once
// A Monte Carlo simulation of the paper's flight, with the filter alone and without a bus. In a
// flight of 20 s, there are 100 IMU samples and 10 master velocities per second. In each run, all filters
// have the same errors and the same noise.
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "target/estimators/strapdown/attitude.hpp"
#include "target/estimators/transfer_alignment/filter.hpp"
#include "tests/unit/target/estimators/flight.hpp"

namespace canhil::transfer_alignment {

struct Truth {
  double velocity_sigma = 1;                              // [m/s]
  double attitude_sigma = 5 * rad_per_deg;                // [rad]
  double accel_bias_sigma = 300e-6 * standard_gravity;    // [m/s^2]
  double gyro_bias_sigma = 3 * rad_per_deg / 3600;        // [rad/s]
  double accel_noise_density = 50e-6 * standard_gravity;  // [m/s^2/sqrt(Hz)]
  double gyro_noise_density = 0.125 * rad_per_deg / 60;   // [rad/s/sqrt(Hz)]
  double master_noise_sigma = 0;                          // white noise of each velocity component [m/s]
};

inline constexpr int update_count = 200;
inline constexpr double update_interval = 0.1, imu_interval = 0.01;

/// The results of one filter in one run: heading error after each update [rad], and mean NIS.
struct RunResult {
  std::array<double, update_count> heading_error;
  double mean_nis = 0;
};

/// Flies `runs` runs with each filter. The first index of the result is the filter, the second index is the
/// run. The same seed gives the same results.
inline std::vector<std::vector<RunResult>> monte_carlo(const std::vector<Settings>& filters,
                                                       const Truth& truth, int runs, std::uint64_t seed) {
  std::vector<std::vector<RunResult>> results(filters.size());
  for (int r = 0; r < runs; ++r) {
    std::mt19937_64 engine(seed + static_cast<std::uint64_t>(r));
    std::normal_distribution<double> normal;
    const auto draw = [&](double sigma) -> Eigen::Vector3d {
      const double x = normal(engine), y = normal(engine), z = normal(engine);
      return sigma * Eigen::Vector3d(x, y, z);
    };
    strapdown::NavState nav = flight_start();
    const Eigen::Vector3d dV = draw(truth.velocity_sigma), phi = draw(truth.attitude_sigma);
    const Eigen::Vector3d accel_bias = draw(truth.accel_bias_sigma), gyro_bias = draw(truth.gyro_bias_sigma);
    std::vector<State> states;
    states.reserve(filters.size());
    for (const Settings& settings : filters) states.push_back(initial(with_errors(nav, dV, phi), settings));
    for (auto& result : results) result.emplace_back();
    const double root_dt = std::sqrt(imu_interval);
    for (int k = 0; k < update_count; ++k) {
      for (int i = 0; i < 10; ++i) {
        const double t = (10 * k + i) * imu_interval;
        strapdown::ImuIncrement imu = flight_increment(nav, t, imu_interval);
        imu.delta_theta += gyro_bias * imu_interval + draw(truth.gyro_noise_density * root_dt);
        imu.delta_v += accel_bias * imu_interval + draw(truth.accel_noise_density * root_dt);
        nav = flight_next(nav, t, imu_interval);
        for (std::size_t f = 0; f < filters.size(); ++f) propagate(states[f], imu, filters[f]);
      }
      const Eigen::Vector3d master = nav.v_eb_n + draw(truth.master_noise_sigma);
      for (std::size_t f = 0; f < filters.size(); ++f) {
        RunResult& run = results[f].back();
        run.mean_nis += update(states[f], master, filters[f]).nis / update_count;
        run.heading_error[static_cast<std::size_t>(k)] =
            strapdown::misalignment(estimate(states[f]).nav.C_bn, nav.C_bn).z();
      }
    }
  }
  return results;
}

/// The RMS, over all runs, of the heading error after update k.
inline double heading_rms(const std::vector<RunResult>& runs, int k) {
  double sum = 0;
  for (const RunResult& run : runs) sum += std::pow(run.heading_error[static_cast<std::size_t>(k)], 2);
  return std::sqrt(sum / static_cast<double>(runs.size()));
}

/// The time [s] of the first update after which the RMS of the heading error is below `threshold` [rad] until
/// the end; infinity if there is no such update.
inline double convergence_time(const std::vector<RunResult>& runs, double threshold) {
  int k = update_count;
  while (k > 0 && heading_rms(runs, k - 1) < threshold) --k;
  return k == update_count ? std::numeric_limits<double>::infinity() : (k + 1) * update_interval;
}

/// The share of runs in which filter `a` has a smaller heading error than filter `b` at the time t [s].
inline double share_ahead(const std::vector<RunResult>& a, const std::vector<RunResult>& b, double t) {
  const auto k = static_cast<std::size_t>(std::lround(t / update_interval)) - 1;
  int ahead = 0;
  for (std::size_t r = 0; r < a.size(); ++r)
    ahead += std::abs(a[r].heading_error[k]) < std::abs(b[r].heading_error[k]);
  return static_cast<double>(ahead) / static_cast<double>(a.size());
}

}  // namespace canhil::transfer_alignment
