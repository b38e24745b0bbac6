#pragma once
// The published run: 90 s of an S path at 50 Hz, one fix per second, and an INS with an initial heading error
// of 90 deg.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "target/estimators/inflight_alignment/filter.hpp"
#include "tests/unit/target/estimators/csv.hpp"

namespace canhil::inflight_alignment {

inline std::string recorded(const std::string& name) {
  return std::string(TEST_DATA_DIR) + "/inflight_alignment/" + name + ".csv";
}

inline strapdown::NavState nav_of(const Csv& csv, std::size_t row) {
  using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  strapdown::NavState nav;
  nav.latitude = csv.at(row, "lat");
  nav.longitude = csv.at(row, "lon");
  nav.height = csv.at(row, "h");
  nav.v_eb_n = Eigen::Map<const Eigen::Vector3d>(csv.from(row, "vn"));
  nav.C_bn = Eigen::Map<const RowMajor3>(csv.from(row, "C00"));
  return nav;
}

struct RecordedRun {
  strapdown::NavState start;
  std::vector<strapdown::ImuIncrement> imu;
  std::vector<Fix> fixes;  // one after every 50 increments

  explicit RecordedRun(Aiding aiding) {
    const std::string aid = aiding == Aiding::ssbl ? "ssbl" : "gps";
    start = nav_of(Csv(recorded("init_" + aid)), 0);
    const Csv increments(recorded("imu"));
    for (std::size_t i = 0; i < increments.rows(); ++i)
      imu.push_back({Eigen::Map<const Eigen::Vector3d>(increments.from(i, "dthx")),
                     Eigen::Map<const Eigen::Vector3d>(increments.from(i, "dvx")), 0.02});
    const Csv positions(recorded("fix_" + aid));
    for (std::size_t i = 0; i < positions.rows(); ++i)
      fixes.emplace_back(
          GeodeticPosition{positions.at(i, "lat"), positions.at(i, "lon"), positions.at(i, "h")});
  }
};

inline constexpr std::size_t samples_per_fix = 50;

inline Settings recorded_settings(Algorithm algorithm, Aiding aiding) {
  Settings settings;
  settings.algorithm = algorithm;
  settings.aiding = aiding;
  if (aiding == Aiding::gps) {
    settings.fix_noise_horizontal = 10;
    settings.fix_noise_vertical = 15;
    settings.position_sigma_0 << 10, 10, 15;
  }
  return settings;
}

/// Runs the recorded inputs and passes each state and result to inspect(k, state, result).
template <class Inspect>
State run(const RecordedRun& run, const Settings& settings, Inspect inspect) {
  State state = initial(run.start, settings);
  for (std::size_t i = 0; i < run.imu.size(); ++i) {
    propagate(state, run.imu[i], settings);
    if ((i + 1) % samples_per_fix != 0) continue;
    const std::size_t k = i / samples_per_fix;
    const UpdateResult result = update(state, run.fixes[k], settings);
    inspect(k, state, result);
  }
  return state;
}
inline State run(const RecordedRun& inputs, const Settings& settings) {
  return run(inputs, settings, [](std::size_t, const State&, const UpdateResult&) {});
}

inline double heading(const State& state) {
  const Eigen::Matrix3d C = estimate(state).nav.C_bn;
  return std::atan2(C(1, 0), C(0, 0));
}

}  // namespace canhil::inflight_alignment
