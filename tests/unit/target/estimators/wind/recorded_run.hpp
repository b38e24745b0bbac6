#pragma once
// The published run: 20 s at 50 Hz, coefficient errors of 20 % drawn anew every 50 ms; states and variances
// of a reference EKF and a reference H-infinity filter after each update.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "target/estimators/wind/filter.hpp"
#include "tests/unit/target/estimators/csv.hpp"

namespace canhil::wind {

struct RecordedRun {
  Settings settings;
  StateVector x0;
  Covariance P0;
  std::vector<Observation> y;
  std::vector<Inputs> inputs;
  std::vector<double> altitude;
  Csv csv{std::string(TEST_DATA_DIR) + "/wind/wind_v2_20pct_diagQ.csv"};

  RecordedRun();

  StateVector published(std::size_t k, const std::string& column) const {
    return Eigen::Map<const StateVector>(csv.from(k, column));
  }
  Eigen::Vector3d true_wind(std::size_t k) const {
    return Eigen::Map<const Eigen::Vector3d>(csv.from(k, "true_wn"));
  }

  /// Row k as the filter receives it from the bus.
  static std::int64_t t_us(std::size_t k) { return static_cast<std::int64_t>(k) * 20'000; }
  Navigation navigation(std::size_t k) const {
    return {.t_us = t_us(k),
            .v_eb_n = y[k].head<3>(),
            .omega = y[k].segment<3>(3),
            .attitude = y[k].tail<3>(),
            .altitude = altitude[k],
            .valid = true};
  }
  /// The published initial state, ready for row 0.
  State release() const {
    State state;
    state.x = x0;
    state.P = P0;
    state.started = true;
    state.t_us = 0;
    state.altitude = altitude[0];
    return state;
  }

  /// Runs the recorded inputs in the published order. For each row k, updates with the row, calls
  /// inspect(k, x, P, answer, prior x, prior P), and then predicts with the row.
  template <class Inspect>
  void run(const Design& design, Inspect inspect) const {
    StateVector x = x0;
    Covariance P = P0;
    const double dt = design.settings.sample_period;
    for (std::size_t k = 0; k < y.size(); ++k) {
      const StateVector x_prior = x;
      const Covariance P_prior = P;
      const Answer answer = update(x, P, y[k], dt, design);
      inspect(k, x, P, answer, x_prior, P_prior);
      RangeFlags outside;
      predict(x, P, dt, inputs[k], design.settings.density, design, outside);
    }
  }
};

}  // namespace canhil::wind
