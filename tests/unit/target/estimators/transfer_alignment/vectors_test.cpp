// Acceptance limits 1 and 2: the filters reproduce the published double-precision runs.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "target/estimators/strapdown/attitude.hpp"
#include "target/estimators/transfer_alignment/filter.hpp"
#include "tests/unit/target/estimators/csv.hpp"
#include "tests/unit/target/estimators/flight.hpp"
#include "tests/unit/target/estimators/transfer_alignment/full_run.hpp"

namespace canhil::transfer_alignment {
namespace {

using Eigen::Map;
using Eigen::Vector3d;
using strapdown::NavState;
using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

const std::string data_folder = std::string(TEST_DATA_DIR) + "/transfer_alignment/";

double relative(double value, double expected) { return std::abs(value / expected - 1); }

double largest_relative(const StateVector& value, const double* expected) {
  double largest = 0;
  for (int i = 0; i < state_count; ++i) largest = std::max(largest, relative(value(i), expected[i]));
  return largest;
}

class FullRun : public testing::TestWithParam<Algorithm> {};

TEST_P(FullRun, ReplaysThePublishedRun) {
  const Csv outputs(data_folder + "full_run_outputs.csv");
  Settings settings;
  settings.algorithm = GetParam();
  settings.mechanization = strapdown::Mechanization::reference;
  const std::string filter = GetParam() == Algorithm::kalman ? "kf_" : "h2_";
  State state = initial(published_start(), settings);
  std::size_t k = 0;
  double worst_V = 0, worst_C = 0, worst_P = 0, worst_alpha_beta = 0, worst_bias = 0;
  for (const Sample& sample : full_run_inputs()) {
    propagate(state, sample.imu, settings);
    if (!sample.master_velocity) continue;
    const UpdateResult result = update(state, *sample.master_velocity, settings);
    ASSERT_EQ(result.outcome, Outcome::ok);
    const Map<const Vector3d> V(outputs.from(k, filter + "V_N"));
    const Map<const RowMajor3> C(outputs.from(k, filter + "C11"));
    worst_V = std::max(worst_V, (state.ins.nav.v_eb_n - V).cwiseAbs().maxCoeff());
    worst_C = std::max(worst_C, (state.ins.nav.C_bn - C).cwiseAbs().maxCoeff());
    worst_P = std::max(worst_P, largest_relative(state.P.diagonal(), outputs.from(k, filter + "P_dV_N")));
    worst_bias = std::max(
        {worst_bias, (state.ins.accel_bias - Map<const Vector3d>(outputs.from(k, filter + "ba_x"))).norm(),
         (state.ins.gyro_bias - Map<const Vector3d>(outputs.from(k, filter + "bg_x"))).norm()});
    if (GetParam() == Algorithm::robust_h2) {
      worst_alpha_beta = std::max(
          {worst_alpha_beta, relative(result.alpha, outputs.at(k, "h2_alpha")),
           relative(result.beta, outputs.at(k, "h2_beta")),
           relative(result.beta * result.alpha * result.alpha * 2, outputs.at(k, "h2_beta_LLt_NN"))});
    }
    ++k;
  }
  EXPECT_EQ(k, outputs.rows());
  EXPECT_LT(worst_V, 1e-9);
  EXPECT_LT(worst_C, 1e-11);
  EXPECT_LT(worst_P, 1e-9);
  EXPECT_LT(worst_alpha_beta, 1e-8);
  EXPECT_LT(worst_bias, 1e-11);
}

INSTANTIATE_TEST_SUITE_P(Filters, FullRun, testing::Values(Algorithm::kalman, Algorithm::robust_h2),
                         [](const auto& which) {
                           return which.param == Algorithm::kalman ? "Kalman" : "RobustH2";
                         });

class FourCases : public testing::TestWithParam<int> {};

TEST_P(FourCases, ReplayThePublishedErrors) {
  const Csv outputs(data_folder + "h2_four_cases.csv");
  Settings settings;
  settings.h2_case = static_cast<H2Case>(GetParam());
  settings.mechanization = strapdown::Mechanization::reference;
  const std::string column = "c" + std::to_string(GetParam()) + "_";
  NavState truth = flight_start();
  State state = initial(published_start(), settings);
  const double dt = 0.01;
  double worst_V = 0, worst_C = 0, worst_P = 0, worst_alpha_beta = 0;
  for (std::size_t k = 0; k < outputs.rows(); ++k) {
    for (std::size_t i = 0; i < 30; ++i) {
      const double t = static_cast<double>(30 * k + i) * dt;
      propagate(state, flight_increment(truth, t, dt), settings);
      truth = flight_next(truth, t, dt);
    }
    const UpdateResult result = update(state, truth.v_eb_n, settings);
    ASSERT_EQ(result.outcome, Outcome::ok);
    const Vector3d dV = state.ins.nav.v_eb_n - truth.v_eb_n;
    const Vector3d phi = strapdown::misalignment(state.ins.nav.C_bn, truth.C_bn);
    worst_V =
        std::max(worst_V, (dV - Map<const Vector3d>(outputs.from(k, column + "dV_N"))).cwiseAbs().maxCoeff());
    worst_C = std::max(worst_C,
                       (phi - Map<const Vector3d>(outputs.from(k, column + "phi_N"))).cwiseAbs().maxCoeff());
    worst_P = std::max(worst_P, largest_relative(state.P.diagonal(), outputs.from(k, column + "P0")));
    worst_alpha_beta = std::max({worst_alpha_beta, relative(result.alpha, outputs.at(k, column + "alpha")),
                                 relative(result.beta, outputs.at(k, column + "beta"))});
  }
  EXPECT_LT(worst_V, 1e-9);
  EXPECT_LT(worst_C, 1e-11);
  EXPECT_LT(worst_P, 1e-9);
  EXPECT_LT(worst_alpha_beta, 1e-8);
}

INSTANTIATE_TEST_SUITE_P(H2, FourCases, testing::Range(1, 5));

}  // namespace
}  // namespace canhil::transfer_alignment
