// The closed forms, compared with a table of algebraic Riccati solutions, with the integrated differential
// equation, and with the discrete equation.
#include "target/estimators/los_rate/closed_form.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "target/estimators/los_rate/design.hpp"
#include "tests/unit/target/estimators/los_rate/polar_riccati.hpp"

namespace canhil::los_rate {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double q = 300, Ts = 0.005;
constexpr Noise thermal{.thermal = 1e-10, .glint = 0, .constant = 0};
constexpr Noise glint{.thermal = 0, .glint = 0.5, .constant = 0};
constexpr double thermal_psd = 1e-20 * Ts, glint_psd = 0.25 * Ts;

Dense columns(const std::array<double, 9>& entries) { return {entries.data(), 3, 3}; }

TEST(Riccati, EqualsThePublishedTable) {
  std::ifstream file(TEST_DATA_DIR "/los_rate/are_table.csv");
  std::string line, cell;
  std::getline(file, line);
  std::getline(file, line);
  int rows = 0;
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::getline(cells, cell, ',');
    std::vector<double> c;
    while (std::getline(cells, cell, ',')) c.push_back(std::stod(cell));
    const Covariance P = riccati(c.at(0), c[2], c[1]);
    // The table uses the sign convention of pitch, in which the acceleration has the opposite sign.
    const std::array ours{P.ee, P.ew, -P.ea, P.ww, -P.wa, P.aa};
    for (std::size_t i = 0; i < ours.size(); ++i)
      EXPECT_NEAR(ours[i] / c[3 + i], 1, 1e-9) << line << " P" << i + 1;
    ++rows;
  }
  EXPECT_EQ(rows, 135);
}

TEST(Riccati, SolvesItsEquationWhateverTheRatioOfSpeedToNoise) {
  for (const double x : {0.0, 0.01, 0.15, 0.5, 1.0, 3.0, 10.0}) {
    const double v = x * 7;  // W = 7
    const double s2 = 300 / std::pow(7.0, 6);
    const Dense P = matrix(riccati(300, s2, v)), P_size = entrywise_sizes(P);
    const Dense A = columns({1.5 * v, 0, 0, 1, 2.5 * v, 0, 0, 1, 0.5 * v});
    const Dense Q = diagonal_matrix(Vector3d(0, 0, 300));
    const Dense residual = A * P + P * transposed(A) - P.column(0) * P.row(0) / s2 + Q;
    const Dense size =
        entrywise_sizes(A * P) + P_size * transposed(A) + P_size.column(0) * P_size.row(0) / s2 + Q;
    EXPECT_LT(largest(entrywise_quotient(residual, size)), 1e-12) << x;
    // Only the stabilising solution satisfies these two conditions. With it, (A - k C)' is stable for every
    // x.
    const double c1 = P(0, 0) / s2 - 4.5 * v;
    EXPECT_GT(c1, 0);
    EXPECT_GT(determinant(P), 0);
  }
}

// Without process noise, an unstable plant still needs a gain: the poles of the plant are mirrored to -v/2,
// -3v/2, -5v/2.
TEST(Riccati, WithoutProcessNoiseMirrorsThePoles) {
  const double v = 2;
  const Covariance P = riccati(0, 1, v);
  EXPECT_NEAR(P.ee, 9 * v, 1e-12 * P.ee);  // k1 = c1 + 9v/2, c1 = v/2 + 3v/2 + 5v/2
}

class DifferentialRiccati : public testing::TestWithParam<double> {};

// Integrates the covariance from P0 at 5 km to 50 m. Returns the largest relative difference, at ranges of
// at most r_from, between `gain` and the gain of the integrated covariance. `gain` is the paper's closed
// form, corrected or as printed.
double worst_gain_error(const Noise& noise, double vc, const Matrix3d& P0, double r_from,
                        const std::function<Vector3d(double)>& gain) {
  double worst = 0;
  integrate_riccati(P0, noise, q, Ts, vc, 5000, 50, [&](double r, const Matrix3d& P) {
    if (r <= r_from) worst = std::max(worst, relative_difference(gain(r), riccati_gain(P, noise, r, Ts)));
  });
  return worst;
}

Matrix3d generic_start() { return diagonal_matrix(Vector3d(6e-6, 0.0025, 1600)).fixed<3, 3>(); }

TEST_P(DifferentialRiccati, ThermalStartedOnTheClosedFormStaysThere) {
  const double vc = GetParam();
  const Covariance p_bar = riccati(q, thermal_psd, vc);
  const auto gain = [&](double r) { return vector(thermal_gain(p_bar, thermal_psd, r)); };
  EXPECT_LT(worst_gain_error(thermal, vc, matrix(thermal_covariance(p_bar, 5000)), 5000, gain), 1e-7);
  EXPECT_LT(worst_gain_error(thermal, vc, generic_start(), 5000 - 3 * vc, gain), 1e-3);
}

TEST_P(DifferentialRiccati, GlintStartedOnTheClosedFormStaysThere) {
  const double vc = GetParam();
  const Covariance p_bar = riccati(q, glint_psd, 0);
  const auto gain = [&](double r) { return vector(glint_gain(p_bar, glint_psd, {r, vc})); };
  EXPECT_LT(worst_gain_error(glint, vc, matrix(glint_covariance(p_bar, {5000, vc})), 5000, gain), 1e-7);
  EXPECT_LT(worst_gain_error(glint, vc, generic_start(), 5000 - 3 * vc, gain), 1e-3);
}

// Eq. (9) as printed, K3 = P3bar/(s2 r^3), is wrong. No limit on an RMS detects this error, so the comparison
// of gains must detect it.
TEST_P(DifferentialRiccati, CatchesPrintedEquation9) {
  const double vc = GetParam();
  const Covariance p_bar = riccati(q, thermal_psd, vc);
  const auto printed = [&](double r) {
    Vector3d K = vector(thermal_gain(p_bar, thermal_psd, r));
    K(2) /= r;
    return K;
  };
  EXPECT_GT(worst_gain_error(thermal, vc, matrix(thermal_covariance(p_bar, 5000)), 5000, printed), 0.9);
}

// Compares eq. (10) as printed, P4 = vc^2 P4bar/r^4 + ..., with P of the integrated equation.
TEST_P(DifferentialRiccati, CatchesPrintedEquation10) {
  const double vc = GetParam();
  const Covariance p_bar = riccati(q, glint_psd, 0);
  double corrected = 0, printed = 1e9;
  integrate_riccati(matrix(glint_covariance(p_bar, {5000, vc})), glint, q, Ts, vc, 5000, 50,
                    [&](double r, const Matrix3d& P) {
                      const double right = glint_covariance(p_bar, {r, vc}).ww;
                      const double wrong = vc * vc * p_bar.ww / (r * r * r * r) +
                                           2 * vc * p_bar.ew / (r * r * r) + p_bar.ww / (r * r);
                      corrected = std::max(corrected, std::abs(right / P(1, 1) - 1));
                      printed = std::min(printed, std::abs(wrong / P(1, 1) - 1));
                    });
  EXPECT_LT(corrected, 1e-7);
  EXPECT_GT(printed, 1e-2) << "everywhere on the way";
}

// Uses eq. (11) as printed, K3 = P3bar/(s2 r), although r P3bar/s2 would be correct.
TEST_P(DifferentialRiccati, CatchesPrintedEquation11) {
  const double vc = GetParam();
  const Covariance p_bar = riccati(q, glint_psd, 0);
  const auto printed = [&](double r) {
    Vector3d K = vector(glint_gain(p_bar, glint_psd, {r, vc}));
    K(2) /= r * r;
    return K;
  };
  EXPECT_GT(worst_gain_error(glint, vc, matrix(glint_covariance(p_bar, {5000, vc})), 5000, printed), 0.9);
}

INSTANTIATE_TEST_SUITE_P(ClosingSpeeds, DifferentialRiccati, testing::Values(600.0, 900.0, 1200.0));

TEST(SteadyState, OfOneNoiseAloneIsThatNoisesClosedForm) {
  for (const double r : {5000.0, 1710.0, 300.0, 50.0}) {
    for (const double vc : {300.0, 900.0, 1800.0}) {
      const Geometry at{r, vc};
      const SteadyState a = steady_state(q, displacement_noise(thermal, at, Ts));
      const Covariance p_thermal = riccati(q, thermal_psd, vc);
      EXPECT_LT(relative_difference(vector(polar(a.d, at)), vector(thermal_gain(p_thermal, thermal_psd, r))),
                1e-12);
      EXPECT_LT(relative_difference(matrix(polar(a.P, at)), matrix(thermal_covariance(p_thermal, r))), 1e-12);
      const SteadyState b = steady_state(q, displacement_noise(glint, at, Ts));
      const Covariance p_glint = riccati(q, glint_psd, 0);
      EXPECT_LT(relative_difference(vector(polar(b.d, at)), vector(glint_gain(p_glint, glint_psd, at))),
                1e-12);
      EXPECT_LT(relative_difference(matrix(polar(b.P, at)), matrix(glint_covariance(p_glint, at))), 1e-12);
    }
  }
}

// The gain of the discrete algebraic Riccati equation of the glint problem, found by iterating the Kalman
// filter at r = 1, vc = 0. There, the polar and the displacement states are equal.
Vector3d discrete_gain(double W, double T) {
  const double psd = 0.25 * T, jerk = std::pow(W, 6) * psd;
  Covariance P{.ee = 1, .ww = 1, .aa = 100};
  Vector3d gain(0, 0, 0);
  for (int k = 0; k < 200'000; ++k) {
    P = predicted(P, {1, 0}, T, jerk);
    const Gain K = kalman_gain(P, 0.25);
    P = updated(P, K);
    const Vector3d previous = gain;
    gain = vector(K);
    if (gain == previous) break;
  }
  return gain;
}

TEST(PoleMatch, EqualsTheDiscreteRiccatiEquationOfGlint) {
  for (const double WT : {0.02, 0.05, 0.1, 0.2, 0.3}) {
    const double T = WT / 15;
    const Gain k{2 * 15.0, 2 * 225.0, 3375.0};
    EXPECT_LT(relative_difference(vector(pole_matched(k, T)), discrete_gain(15, T)), 1e-6) << WT;
    // The low-order rule K Ts fails this comparison.
    const Vector3d euler(k.e * T, k.w * T, k.a * T);
    EXPECT_GT(relative_difference(euler, discrete_gain(15, T)), 0.5 * WT) << WT;
  }
}

// Spectral radius of I - K H Phi in displacement states.
double spectral_radius(const Gain& K, double T) {
  const Dense Phi = columns({1, 0, 0, T, 1, 0, T * T / 2, T, 1});
  return canhil::spectral_radius(Phi - vector(K) * Phi.row(0));
}

TEST(PoleMatch, IsStableForAnyStepWhereEulerIsNot) {
  for (const double T : {1e-4, 0.01, 0.1, 1.0, 10.0}) {
    for (const double x : {0.0, 0.1, 1.0, 5.0}) {
      const SteadyState steady = steady_state(std::pow(10.0, 6), {1, 10 * x});
      EXPECT_LT(spectral_radius(pole_matched(steady.d, T), T), 1) << T << " " << x;
    }
  }
  const double T = 0.08;  // W T = 0.8
  EXPECT_GT(spectral_radius({20 * T, 200 * T, 1000 * T}, T), 1);
}

// The bandwidth [rad/s] at which the gain from true to estimated LOS rate has fallen by 3 dB. The transfer
// function is (d2 s + d3)/(s^3 + d1 s^2 + d2 s + d3).
double bandwidth(const Gain& d) {
  const auto gain = [&](double w) {
    const std::complex<double> s(0, w);
    return std::abs((d.w * s + d.a) / (((s + d.e) * s + d.w) * s + d.a));
  };
  double low = 0, high = 0;
  for (int i = 0; i < 1400; ++i) {
    const double w = 0.01 * std::pow(1.01, i);
    if (gain(w) > std::sqrt(0.5)) low = w, high = 1.02 * w;
  }
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (gain(middle) > std::sqrt(0.5) ? low : high) = middle;
  }
  return low;
}

// Fig. 3: the bandwidth, not the gain, is insensitive to closing speed.
TEST(Bandwidth, DoesNotDependOnClosingSpeed) {
  double low = 1e9, high = 0, low_gain = 1e9, high_gain = 0;
  for (int i = 3; i <= 18; ++i) {
    const double vc = 100.0 * i;
    const Gain d = steady_state(q, displacement_noise(thermal, {1000, vc}, Ts)).d;
    low = std::min(low, bandwidth(d));
    high = std::max(high, bandwidth(d));
    low_gain = std::min(low_gain, d.e);
    high_gain = std::max(high_gain, d.e);
  }
  EXPECT_LT(high / low - 1, 0.02);
  EXPECT_GT(high_gain / low_gain - 1, 0.2);
}

TEST(Bandwidth, IsAMultipleOfOmegaWhereClosingSpeedIsSmall) {
  for (const double x : {0.0, 0.05, 0.1, 0.2})
    EXPECT_NEAR(bandwidth(steady_state(1, {1, x}).d) / 1.70, 1, 0.0025) << x;
  EXPECT_NEAR(bandwidth(steady_state(1, {1, 0.5}).d), 1.88, 0.01);
  EXPECT_NEAR(bandwidth(steady_state(1, {1, 1}).d), 2.9, 0.05);
}

}  // namespace
}  // namespace canhil::los_rate
