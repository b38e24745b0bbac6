// The published flight: gains to 1e-9, estimates to 1e-9 rad/s, and the effect of a wrong sign on both.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/target/estimators/los_rate/vector_run.hpp"

namespace canhil::los_rate {
namespace {

// Largest absolute value of a column.
double largest(const std::string& name) {
  const Csv& csv = vector_file();
  double value = 0;
  for (std::size_t k = 0; k < csv.rows(); ++k) value = std::max(value, std::abs(csv.at(k, name)));
  return value;
}

double relative(double value, double reference) { return std::abs(value / reference - 1); }

// Compares every row of a run with the columns of `name`. The relative error of a gain may be 1e-9. The error
// of an estimate may be 1e-9 plus 1e-8 times the largest value of its column.
void expect_published(const std::vector<Point>& points, const std::string& name) {
  const Csv& csv = vector_file();
  const double e_bar = 1e-9 + 1e-8 * largest(name + "_e"), w_bar = 1e-9 + 1e-8 * largest(name + "_w");
  const double a_bar = 1e-9 + 1e-8 * largest(name + "_a");
  ASSERT_EQ(points.size(), csv.rows());
  double gain = 0, e = 0, w = 0, a = 0;
  for (std::size_t k = 1; k < points.size(); ++k) {
    const Point& p = points[k];
    gain = std::max({gain, relative(p.K.e, csv.at(k, name + "_Kd1")),
                     relative(p.K.w, csv.at(k, name + "_Kd2")), relative(-p.K.a, csv.at(k, name + "_Kd3"))});
    e = std::max(e, std::abs(p.e - csv.at(k, name + "_e")));
    w = std::max(w, std::abs(p.w - csv.at(k, name + "_w")));
    a = std::max(a, std::abs(p.a - csv.at(k, name + "_a")));
  }
  EXPECT_LE(gain, 1e-9) << name;
  EXPECT_LE(e, e_bar) << name;
  EXPECT_LE(w, w_bar) << name;
  EXPECT_LE(a, a_bar) << name;
}

TEST(Vector, ContinuousCombinedGain) {
  const Csv& csv = vector_file();
  const std::vector<Row> rows = vector_rows();
  double worst = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Gain K = exact_gain(vector_noise, rows[k].at());
    worst = std::max({worst, relative(K.e, csv.at(k, "comb_Kc1")), relative(K.w, csv.at(k, "comb_Kc2")),
                      relative(-K.a, csv.at(k, "comb_Kc3"))});
  }
  EXPECT_LE(worst, 1e-9);
}

TEST(Vector, Combined) { expect_published(run_vector(vector_rows(), combined_gain), "comb"); }
TEST(Vector, Switched) { expect_published(run_vector(vector_rows(), switched_gain), "switch"); }

Settings vector_settings(Algorithm algorithm) {
  Settings settings;
  settings.algorithm = algorithm;
  settings.start_up = 0;
  settings.range_sigma = 0;
  settings.blind_range = 0;
  return settings;
}

// Passes the rows to step() until the range falls to the estimator's least range: 10 times the closing speed
// times the sample interval.
std::vector<Point> run_steps(const std::vector<Row>& rows, const Design& design) {
  State state = initial();
  std::vector<Point> points;
  for (const Row& row : rows) {
    Measurement m{.dt = vector_T, .error_valid = true, .antenna_valid = true, .acceleration_valid = true};
    m.error.pitch = row.e_meas;
    m.antenna_increment.pitch = row.dtheta_ant;
    m.missile_acceleration.pitch = row.am;
    m.range = {row.r_hat, row.vc_hat, true, true};
    const UpdateResult result = step(state, m, design);
    if (result.blind) break;
    EXPECT_EQ(result.outcome, points.empty() ? Outcome::started : Outcome::updated) << row.t;
    EXPECT_EQ(estimate(state).rate.yaw, 0);
    const Estimate x = estimate(state);
    points.push_back({row.t, x.error.pitch, x.rate.pitch, x.acceleration.pitch, {}});
  }
  return points;
}

// The largest |w - reference| of the rows within [from, to) s.
double worst_rate(const std::vector<Point>& points, const std::string& column, double from, double to) {
  double worst = 0;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (points[k].t >= from && points[k].t < to)
      worst = std::max(worst, std::abs(points[k].w - vector_file().at(k, column)));
  return worst;
}

TEST(Vector, KalmanThroughTheWholeStep) {
  const std::vector<Point> points = run_steps(vector_rows(), make_design(vector_settings(Algorithm::kalman)));
  ASSERT_GT(points.size(), 1095U);
  EXPECT_LE(worst_rate(points, "kf_w", 0, 6), 1e-9);
  const Csv& csv = vector_file();
  for (std::size_t k = 0; k < points.size(); ++k) {
    ASSERT_NEAR(points[k].e, csv.at(k, "kf_e"), 1e-9 + 1e-8 * largest("kf_e")) << k;
    ASSERT_NEAR(points[k].a, csv.at(k, "kf_a"), 1e-9 + 1e-8 * largest("kf_a")) << k;
  }
}

// The table of P-bar uses cubic interpolation and loses no accuracy; the combined table is bilinear.
TEST(Vector, TablesThroughTheWholeStep) {
  const std::vector<Point> switched =
      run_steps(vector_rows(), make_design(vector_settings(Algorithm::switched_table)));
  EXPECT_LE(worst_rate(switched, "switch_w", 0, 6), 1e-9 + 1e-8 * largest("switch_w"));
  const std::vector<Point> combined =
      run_steps(vector_rows(), make_design(vector_settings(Algorithm::combined)));
  EXPECT_LE(worst_rate(combined, "comb_w", 0, 6), 1e-3 * largest("comb_w"));
}

// Rows are changed as a wrong sign in a driver or in the filter would change them. The result must fail the
// same comparison. Between 3 s and 1 s before the closest approach, the result is nearly right, so only the
// start and the end are compared.
using Change = void (*)(Row&);
double wrong_over_right(Change change, double from, double to) {
  std::vector<Row> rows = vector_rows();
  for (Row& row : rows) change(row);
  const double bar = 1e-9 + 1e-8 * largest("comb_w");
  return worst_rate(run_vector(rows, combined_gain), "comb_w", from, to) / bar;
}

TEST(SignTraps, RightSignsPassTheComparison) {
  EXPECT_LE(wrong_over_right([](Row&) {}, 0, 6), 1);
}
TEST(SignTraps, FlippedAntennaIncrementIsCaught) {
  const Change flip = [](Row& row) { row.dtheta_ant = -row.dtheta_ant; };
  EXPECT_GT(wrong_over_right(flip, 0, 0.5), 1e5);
  EXPECT_GT(wrong_over_right(flip, 5, 6), 1e5);
}
TEST(SignTraps, FlippedMissileAccelerationIsCaught) {
  const Change flip = [](Row& row) { row.am = -row.am; };
  EXPECT_GT(wrong_over_right(flip, 0, 0.5), 1e5);
  EXPECT_GT(wrong_over_right(flip, 5, 6), 1e5);
}
TEST(SignTraps, MissingMissileAccelerationIsCaught) {
  const Change drop = [](Row& row) { row.am = 0; };
  EXPECT_GT(wrong_over_right(drop, 0, 0.5), 1e5);
  EXPECT_GT(wrong_over_right(drop, 5, 6), 1e5);
}

// The RMS error of the estimate from the changed rows, compared with the truth from 5.05 to 5.45 s. This
// error distinguishes right from wrong signs without a reference filter.
double rms_error(Change change) {
  std::vector<Row> rows = vector_rows();
  for (Row& row : rows) change(row);
  const std::vector<Point> points = run_vector(rows, combined_gain);
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (points[k].t < 5.05 || points[k].t > 5.45) continue;
    const double error = points[k].w - rows[k].true_w;
    sum += error * error;
    ++count;
  }
  return std::sqrt(sum / count);
}

TEST(SignTraps, TruthDistinguishesRightFromWrongNearTheEnd) {
  const double right = rms_error([](Row&) {});
  EXPECT_LT(right, 0.012);
  EXPECT_GT(rms_error([](Row& row) { row.dtheta_ant = -row.dtheta_ant; }), 3 * right);
  EXPECT_GT(rms_error([](Row& row) { row.am = -row.am; }), 3 * right);
  EXPECT_GT(rms_error([](Row& row) { row.am = 0; }), 3 * right);
}

// The printed equations (9) and (11) must fail the comparison of gains with the vector.
TEST(PrintedEquations, NineAndElevenFailTheGainComparison) {
  const Csv& csv = vector_file();
  const std::vector<Row> rows = vector_rows();
  double right = 0, nine = 1e9, eleven = 1e9;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const Geometry at = rows[k].at();
    const bool thermal = at.range > crossing_range(vector_noise);
    const Gain K = exact_gain(thermal ? thermal_part : glint_part, at);
    const double reference = -csv.at(k, "switch_Kd3");
    right = std::max(right, relative(discrete(K, at).a, reference));
    if (thermal) nine = std::min(nine, relative(discrete({K.e, K.w, K.a / at.range}, at).a, reference));
    if (!thermal)
      eleven = std::min(eleven, relative(discrete({K.e, K.w, K.a / (at.range * at.range)}, at).a, reference));
  }
  EXPECT_LE(right, 1e-9);
  EXPECT_GT(nine, 0.9);
  EXPECT_GT(eleven, 0.9);
}

}  // namespace
}  // namespace canhil::los_rate
