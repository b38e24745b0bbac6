// Tests the claims that compare the robust H2 filter with the Kalman filter (Yang, Shim, Park 2001). The
// settings are those that reproduce the paper's Table 2: P0 of the attitude is 1 deg although the true errors
// are 5 deg, and R is far above the master's noise. Each test has 300 runs and a fixed seed. Two scatters are
// known: between five seeds with 300 runs each, and between ten batches of 30 runs of the reference
// simulation. The limits are wider than both. Seeds 1, 1000, 2000 and 5000 meet the limits.
#include <gtest/gtest.h>

#include "tests/papers/transfer_alignment/monte_carlo.hpp"

namespace canhil::transfer_alignment {
namespace {

constexpr int run_count = 300;
constexpr std::uint64_t first_seed = 20010101;
constexpr double k3mrad = 3e-3, k2mrad = 2e-3, k1mrad = 1e-3;

Settings filter(Algorithm algorithm, double sigma_0_deg) {
  Settings settings;
  settings.algorithm = algorithm;
  settings.attitude_sigma_0.setConstant(sigma_0_deg * rad_per_deg);
  return settings;
}
const Settings kalman_1 = filter(Algorithm::kalman, 1), kalman_5 = filter(Algorithm::kalman, 5),
               h2_filter = filter(Algorithm::robust_h2, 1);

// In the paper, the heading error falls below 3 mrad after 14.4 s and below 2 mrad after 15.6 s. In the
// reference simulation, these times are 14.7 s and 16.2 s. In both, the error never falls below 1 mrad.
TEST(TransferAlignmentPaper, KalmanFilterConfiguredWithOneDegreeIsSlow) {
  const auto runs = monte_carlo({kalman_1}, {}, run_count, first_seed).front();
  EXPECT_GT(convergence_time(runs, k3mrad), 13.8);
  EXPECT_LT(convergence_time(runs, k3mrad), 16.0);
  EXPECT_GT(convergence_time(runs, k1mrad), 18.0);
}

// In the paper, the heading error of the H2 filter falls below 3, 2 and 1 mrad after 11.4, 11.7 and 12.9 s.
// In the reference simulation, the times are 12.3, 12.9 and 15.5 s. The test and the simulation compute alpha
// in the same way, without the true errors, which a real filter cannot know.
TEST(TransferAlignmentPaper, H2IsFasterThanThatKalmanFilter) {
  const auto results = monte_carlo({h2_filter, kalman_1}, {}, run_count, first_seed);
  const auto &h2 = results[0], &kalman = results[1];
  EXPECT_LE(convergence_time(h2, k3mrad), 12.8);
  EXPECT_LE(convergence_time(h2, k2mrad), 13.6);
  EXPECT_LE(convergence_time(h2, k1mrad), 18.0);
  EXPECT_LE(heading_rms(h2, update_count - 1), k1mrad);
  EXPECT_LE(convergence_time(h2, k3mrad) + 1.5, convergence_time(kalman, k3mrad));
  EXPECT_GE(share_ahead(h2, kalman, 12), 0.90);
}

// A Kalman filter with the correct P0 converges faster than the H2 filter.
TEST(TransferAlignmentPaper, KalmanFilterConfiguredWithTheTruthIsFasterThanH2) {
  const auto results = monte_carlo({kalman_5, h2_filter}, {}, run_count, first_seed);
  const auto &kalman = results[0], &h2 = results[1];
  EXPECT_LE(convergence_time(kalman, k3mrad), 11.6);
  EXPECT_LE(convergence_time(kalman, k2mrad), 11.9);
  EXPECT_LE(convergence_time(kalman, k1mrad), 12.6);
  EXPECT_GE(share_ahead(kalman, h2, 12), 0.88);
}

// With P0 of 1 deg and fading memory, the Kalman filter is as fast as the H2 filter. In the reference
// simulation, the heading error of the Kalman filter falls below 3, 2 and 1 mrad after 12.0, 12.4 and 13.6 s
// if P is multiplied by exp(2 a dt), and after 13.1, 13.9 and 16.5 s if P is multiplied by exp(a dt). In both
// cases a is 0.1 /s.
TEST(TransferAlignmentPaper, FadingMemoryIsAsFastAsH2) {
  Settings fading = kalman_1;
  fading.fading_per_s = 0.1;
  const auto runs = monte_carlo({fading}, {}, run_count, first_seed).front();
  EXPECT_NEAR(convergence_time(runs, k3mrad), 12.0, 0.4);
  EXPECT_NEAR(convergence_time(runs, k2mrad), 12.4, 0.4);
  EXPECT_NEAR(convergence_time(runs, k1mrad), 13.6, 0.8);
}

// The master's velocity has noise. The H2 filter with the true P0 (5 deg) diverges in some runs; the test
// records the error of this filter without judging it.
TEST(TransferAlignmentPaper, KalmanFilterConvergesWithMasterNoise) {
  Truth truth;
  truth.master_noise_sigma = 0.05;
  const auto results = monte_carlo({kalman_5, filter(Algorithm::robust_h2, 5)}, truth, run_count, first_seed);
  EXPECT_LE(convergence_time(results[0], k3mrad), 11.8);
  EXPECT_LE(convergence_time(results[0], k2mrad), 12.2);
  EXPECT_LE(convergence_time(results[0], k1mrad), 13.4);
  RecordProperty("h2_p0_5deg_heading_rms_mrad",
                 std::to_string(1e3 * heading_rms(results[1], update_count - 1)));
}

// If P0, Q and R have the true values, the innovations are consistent: the mean NIS is 3. The standard error
// of this mean is 0.01 (300 runs with 200 updates each; chi-square with 3 degrees of freedom). The
// linearisation error is of the order of the square of 5 deg, and affects only the first updates.
TEST(TransferAlignmentPaper, HonestKalmanFilterIsConsistent) {
  Truth truth;
  truth.master_noise_sigma = std::sqrt(kalman_5.velocity_noise_density / update_interval);
  const auto runs = monte_carlo({kalman_5}, truth, run_count, first_seed).front();
  double nis = 0;
  for (const RunResult& run : runs) nis += run.mean_nis / run_count;
  EXPECT_NEAR(nis, 3, 0.06);
}

}  // namespace
}  // namespace canhil::transfer_alignment
