// Tests how the recommended in-flight filter models the errors of fixes, and what it does if they are larger.
#include "target/estimators/inflight_alignment/fix_error.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "target/estimators/inflight_alignment/filter.hpp"
#include "tests/unit/target/estimators/inflight_alignment/recorded_run.hpp"

namespace canhil::inflight_alignment {
namespace {

using Eigen::Vector3d;

Settings correlated(double share, double time) {
  Settings settings;
  settings.fix_noise_vertical = 3;
  settings.fix_correlated_share = share;
  settings.fix_correlation_time = time;
  return settings;
}

TEST(FixError, TheToldShareOfTheVarianceIsCorrelated) {
  Settings settings = correlated(0.75, 30);
  settings.fix_bias_sigma_0 = 3;
  const FixErrorModel ssbl = fix_error_model(settings, {});
  EXPECT_TRUE(ssbl.white.isApprox(Vector3d(1, 1, 2.25)));
  EXPECT_TRUE(ssbl.state.isApprox(Vector3d(12, 12, 15.75)));
  EXPECT_TRUE(ssbl.density.isApprox(2.0 / 30 * Vector3d(3, 3, 6.75)));
  settings.aiding = Aiding::gps;
  EXPECT_TRUE(fix_error_model(settings, {}).state.isApprox(Vector3d(3, 3, 6.75))) << "no constant error";
  const FixSigma reported{.horizontal = 4};
  EXPECT_TRUE(fix_error_model(settings, reported).white.isApprox(Vector3d(4, 4, 2.25))) << "the larger sigma";
  settings.sin_cos_form = SinCosForm::published;
  EXPECT_TRUE(fix_error_model(settings, reported).white.isApprox(Vector3d(16, 16, 9))) << "as published";
}

TEST(FixError, AnUnknownTimeIsCovered) {
  Settings settings = correlated(1, 0);
  settings.aiding = Aiding::gps;
  const FixErrorModel model = fix_error_model(settings, {});
  const double sigma_squared = 4, decay = model.density.x() / (2 * model.state.x());
  for (const double w : {1.0 / 120, 1.0 / 60, 1.0 / 20, 1.0 / 15}) {
    const double largest = sigma_squared / w;  // of all Gauss-Markov errors with this sigma
    EXPECT_GE(model.white.x() + model.density.x() / (decay * decay + w * w), largest) << w;
  }
}

TEST(FixError, TheStateKeepsItsVarianceAndForgets) {
  const Settings settings = correlated(1, 30);
  Errors<19> errors;
  errors.x(16) = 5;
  errors.P(16, 16) = 1;
  errors.P(0, 16) = errors.P(16, 0) = 0.5;
  FixErrors fixes;
  predict_fix_bias<19>(errors, fixes, settings, 10);
  const double b = settings.fix_bias_sigma_0 * settings.fix_bias_sigma_0;
  const double keep = std::exp(-10 * (4 / (b + 4)) / 30);  // only the correlated part decays
  EXPECT_NEAR(errors.x(16), 5 * keep, 1e-12);
  EXPECT_NEAR(errors.P(0, 16), 0.5 * keep, 1e-12);
  for (int i = 0; i < 200; ++i) predict_fix_bias<19>(errors, fixes, settings, 10);
  EXPECT_NEAR(errors.P(16, 16), b + 4, 1e-9);
  EXPECT_NEAR(errors.P(18, 18), b + 9, 1e-9);

  Errors<19> constant;
  constant.x(16) = 5;
  predict_fix_bias<19>(constant, fixes, correlated(0, 30), 10);
  EXPECT_EQ(constant.x(16), 5);
}

// A source of fixes whose reported sigma changes from fix to fix adds no variance that was not there: the
// sigma of the fix bias stays near that of the largest report.
TEST(FixError, ASigmaThatChangesFromFixToFixDoesNotPumpTheCovariance) {
  const auto sigma_with = [](double low, double high) {
    RecordedRun flight(Aiding::gps);
    Settings settings = correlated(1, 0);
    settings.aiding = Aiding::gps;
    for (std::size_t i = 0; i < flight.fixes.size(); ++i) {
      const double sigma = i % 2 == 0 ? low : high;
      flight.fixes[i].reported = {.horizontal = sigma, .vertical = sigma};
    }
    return uncertainty(run(flight, settings)).position.x();
  };
  EXPECT_LT(sigma_with(10, 12), 1.3 * sigma_with(12, 12));
  EXPECT_LT(sigma_with(10, 30), 1.3 * sigma_with(30, 30));
  EXPECT_GT(sigma_with(30, 30), 1.5 * sigma_with(10, 10)) << "a larger sigma counts";
}

// Flies the recorded path with its fixes, which are `offset` [m] further north from `from` on.
State flown(double offset, std::size_t from, const Settings& settings) {
  RecordedRun flight(Aiding::ssbl);
  for (std::size_t i = from; i < flight.fixes.size(); ++i)
    flight.fixes[i].position.latitude += offset / 6.37e6;
  return run(flight, settings);
}

TEST(FixError, AJumpOfTheFixesWidensPositionAndFixBiasAndSparesTheVelocity) {
  for (const double gate : {0.0, 30.0}) {
    Settings settings = correlated(1, 0);
    settings.gate_nis = gate;
    const State before = flown(0, 0, settings), after = flown(50, 60, settings);
    EXPECT_FALSE(before.fixes.charts.alarmed());
    EXPECT_EQ(before.fixes.seen, Vector3d::Zero());
    EXPECT_GT(std::sqrt(after.fixes.seen.x()), 40);
    const Uncertainty good = uncertainty(before), doubtful = uncertainty(after);
    EXPECT_GT(doubtful.position.x(), 25);
    EXPECT_GT(doubtful.fix_bias.x(), 25);
    EXPECT_NEAR(doubtful.position.y(), good.position.y(), 0.5 * good.position.y());
    EXPECT_LT((estimate(after).nav.v_eb_n - estimate(before).nav.v_eb_n).norm(), 0.5) << gate;
  }
}

TEST(FixError, FixesBeyondTheToldErrorsWidenTheCovariance) {
  Settings settings = correlated(0, 0);
  settings.position_sigma_0.setConstant(0.1);
  settings.fix_bias_sigma_0 = 0.1;
  const State state = flown(9, 0, settings);  // from the start, with sigmas that do not allow for it
  EXPECT_GT(std::sqrt(state.fixes.seen.x()), 3);
  EXPECT_GT(uncertainty(state).position.x(), 2);
}

}  // namespace
}  // namespace canhil::inflight_alignment
