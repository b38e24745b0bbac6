#pragma once
// The published flight (200 Hz, pitch plane), and filters composed of the estimator's functions with exact
// gains. These filters do not limit the range and have no start-up.
#include <functional>
#include <string>
#include <vector>

#include "target/estimators/los_rate/filter.hpp"
#include "tests/unit/target/estimators/csv.hpp"

namespace canhil::los_rate {

struct Row {
  double t, e_meas, dtheta_ant, am, r_hat, vc_hat, true_w;
  Geometry at() const { return {r_hat, vc_hat}; }
};

/// An estimate in the sign convention of pitch, and its gain.
struct Point {
  double t, e, w, a;
  Gain K;
};

inline const Csv& vector_file() {
  static const Csv file(TEST_DATA_DIR "/los_rate/vec1_200hz.csv");
  return file;
}

inline std::vector<Row> vector_rows() {
  const Csv& csv = vector_file();
  std::vector<Row> rows;
  for (std::size_t k = 0; k < csv.rows(); ++k)
    rows.push_back({csv.at(k, "t"), csv.at(k, "e_meas"), csv.at(k, "dtheta_ant"), csv.at(k, "am"),
                    csv.at(k, "r_hat"), csv.at(k, "vc_hat"), csv.at(k, "true_w")});
  return rows;
}

inline constexpr double vector_q = 300, vector_T = 0.005;
inline constexpr Noise vector_noise{.thermal = 1e-10, .glint = 0.5, .constant = 0};
inline constexpr Noise thermal_part{.thermal = 1e-10, .glint = 0, .constant = 0};
inline constexpr Noise glint_part{.thermal = 0, .glint = 0.5, .constant = 0};

/// The continuous gain of the polar states for this noise.
inline Gain exact_gain(const Noise& noise, Geometry at) {
  return polar(steady_state(vector_q, displacement_noise(noise, at, vector_T)).d, at);
}
inline Gain discrete(const Gain& continuous, Geometry at) {
  return polar(pole_matched(displacement(continuous, at), vector_T), at);
}
inline Gain combined_gain(Geometry at) { return discrete(exact_gain(vector_noise, at), at); }
inline Gain switched_gain(Geometry at) {
  return discrete(exact_gain(at.range > crossing_range(vector_noise) ? thermal_part : glint_part, at), at);
}

/// Passes the rows to predict() and correct(), with the signs that a Measurement has. Calls `gain` once per
/// row.
inline std::vector<Point> run_vector(const std::vector<Row>& rows,
                                     const std::function<Gain(Geometry)>& gain) {
  std::vector<Point> points;
  State state = initial();
  state.error = {0, rows.front().e_meas};
  points.push_back({rows.front().t, rows.front().e_meas, 0, 0, {}});
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const Row& row = rows[k];
    predict(state, row.at(), vector_T, {0, row.dtheta_ant}, {0, -row.am}, 0);
    const Gain K = gain(row.at());
    correct(state, {0, row.e_meas - state.error.imag()}, {K, K});
    const Estimate x = estimate(state);
    points.push_back({row.t, x.error.pitch, x.rate.pitch, x.acceleration.pitch, K});
  }
  return points;
}

}  // namespace canhil::los_rate
