// Both filters reproduce every state and every variance of the published test vector.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tests/unit/target/estimators/wind/recorded_run.hpp"

namespace canhil::wind {
namespace {

// Largest difference of a state, and largest relative difference of a variance, over the run.
struct Misses {
  double state = 0, variance = 0;
};

Misses replayed(const RecordedRun& run, Algorithm algorithm, const std::string& name) {
  Settings settings = run.settings;
  settings.algorithm = algorithm;
  Misses worst;
  run.run(make_design(settings), [&](std::size_t k, const StateVector& x, const Covariance& P,
                                     const Answer& answer, const StateVector&, const Covariance&) {
    EXPECT_FALSE(answer.theta_capped) << k;
    worst.state = std::max(worst.state, (x - run.published(k, name + "_u")).cwiseAbs().maxCoeff());
    const StateVector variance = run.published(k, name + "_Pu");
    worst.variance =
        std::max(worst.variance, (P.diagonal() - variance).cwiseQuotient(variance).cwiseAbs().maxCoeff());
  });
  return worst;
}

TEST(WindVector, EkfReplays) {
  const RecordedRun run;
  ASSERT_EQ(run.y.size(), 1001);
  const Misses worst = replayed(run, Algorithm::ekf, "ekf");
  EXPECT_LT(worst.state, 1e-6);
  EXPECT_LT(worst.variance, 1e-6);
}

TEST(WindVector, HInfinityReplays) {
  const Misses worst = replayed(RecordedRun(), Algorithm::h_infinity, "hinf");
  EXPECT_LT(worst.state, 1e-6);
  EXPECT_LT(worst.variance, 1e-6);
}

}  // namespace
}  // namespace canhil::wind
