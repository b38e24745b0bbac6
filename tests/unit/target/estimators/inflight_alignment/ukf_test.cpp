// The unscented prediction against the transform as it is written down: all 2 N + 1 points, the centre's
// weight negative.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

#include "target/estimators/filtering/positive_definite.hpp"
#include "target/estimators/filtering/unscented.hpp"
#include "target/estimators/inflight_alignment/psi_angle.hpp"
#include "tests/unit/target/estimators/inflight_alignment/recorded_run.hpp"
#include "tests/unit/target/estimators/random_matrix.hpp"

namespace canhil::inflight_alignment {
namespace {

template <int N>
Errors<N> some_errors(double heading_sigma) {
  std::mt19937_64 engine(3);
  Settings settings = recorded_settings(Algorithm::ukf, N == 18 ? Aiding::ssbl : Aiding::gps);
  settings.heading_sigma_0 = heading_sigma;
  Errors<N> errors = std::get<Errors<N>>(initial({}, settings).errors);
  const Vector<N> sigma = errors.P.diagonal().cwiseSqrt();
  Matrix<N, N> mix = Matrix<N, N>::Identity() + 0.2 * random_matrix<N, N>(engine);
  errors.P = sigma.asDiagonal() * (mix * mix.transpose()) * sigma.asDiagonal();
  errors.x = 0.5 * sigma.cwiseProduct(random_matrix<N, 1>(engine));
  return errors;
}

Interval some_interval() {
  const RecordedRun inputs(Aiding::ssbl);
  State state = initial(inputs.start, {});
  for (std::size_t i = 0; i < samples_per_fix; ++i) mechanise(state, inputs.imu[i]);
  return state.ins.interval;
}

template <int N>
Errors<N> as_written(const Errors<N>& before, const Interval& interval, const Settings& settings) {
  const Matrix<N, N> root = settings.ukf_root == UkfRoot::symmetric
                                ? filtering::symmetric_root<N>(before.P)
                                : Matrix<N, N>(Eigen::LLT<Matrix<N, N>>(before.P).matrixL());
  const Vector<N> centre = predicted<N>(before.x, interval);
  std::vector<Vector<N>> difference;
  for (int j = 0; j < N; ++j)
    for (const double sign : {1.0, -1.0})
      difference.push_back(predicted<N>(before.x + sign * std::sqrt(3.0) * root.col(j), interval) - centre);
  Vector<N> shift = Vector<N>::Zero();
  for (const Vector<N>& d : difference) shift += d / 6;
  const bool about_mean = settings.ukf_covariance == UkfCovariance::about_mean;
  Errors<N> after;
  after.x = centre + shift;
  if (about_mean) after.P = (1 - N / 3.0) * shift * shift.transpose();
  for (Vector<N> d : difference) {
    if (about_mean) d -= shift;
    after.P += d * d.transpose() / 6;
  }
  after.P.diagonal().template segment<3>(3).array() +=
      settings.accel_noise_density * settings.accel_noise_density * interval.duration;
  after.P.diagonal().template segment<3>(6).array() +=
      settings.gyro_noise_density * settings.gyro_noise_density * interval.duration;
  return after;
}

template <int N>
void expect_as_written(UkfRoot root, UkfCovariance covariance) {
  Settings settings;
  settings.ukf_root = root;
  settings.ukf_covariance = covariance;
  const Interval interval = some_interval();
  const Errors<N> before = some_errors<N>(0.3);
  const Errors<N> expected = as_written<N>(before, interval, settings);
  Errors<N> errors = before;
  EXPECT_EQ(predict_ukf<N>(errors, interval, settings), 0);
  const Vector<N> sigma = expected.P.diagonal().cwiseSqrt();
  const Matrix<N, N> scaled =
      sigma.cwiseInverse().asDiagonal() * (errors.P - expected.P) * sigma.cwiseInverse().asDiagonal();
  EXPECT_LT(scaled.cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((errors.x - expected.x).cwiseQuotient(sigma).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_EQ(errors.P, errors.P.transpose());
}

TEST(Ukf, IsTheTransformAsWritten) {
  for (const UkfRoot root : {UkfRoot::lower_cholesky, UkfRoot::symmetric}) {
    for (const UkfCovariance covariance : {UkfCovariance::about_mean, UkfCovariance::about_central}) {
      expect_as_written<15>(root, covariance);
      expect_as_written<18>(root, covariance);
    }
  }
}

// W0 is negative: the transform itself may leave an indefinite P, which is mended and counted.
TEST(Ukf, RepairsWhatItsNegativeWeightBreaks) {
  const Interval interval = some_interval();
  Settings settings;
  int repairs = 0;
  for (double sigma = 1; sigma < 12; sigma += 0.5) {
    Errors<18> errors = some_errors<18>(sigma);
    repairs += predict_ukf<18>(errors, interval, settings);
    EXPECT_TRUE(filtering::is_positive_definite<18>(errors.P)) << sigma;
  }
  EXPECT_GT(repairs, 0);
  settings.ukf_covariance = UkfCovariance::about_central;
  for (double sigma = 1; sigma < 12; sigma += 0.5) {
    Errors<18> errors = some_errors<18>(sigma);
    EXPECT_EQ(predict_ukf<18>(errors, interval, settings), 0) << "about the centre it cannot break";
  }
}

TEST(Ukf, RepairsAPosteriorThatIsNotPositiveDefinite) {
  for (const UkfRoot root : {UkfRoot::lower_cholesky, UkfRoot::symmetric}) {
    Settings settings;
    settings.ukf_root = root;
    Errors<18> errors = some_errors<18>(0.3);
    errors.P(12, 12) = -1e-12;
    EXPECT_EQ(predict_ukf<18>(errors, some_interval(), settings), 1);
    EXPECT_TRUE(filtering::is_positive_definite<18>(errors.P));
  }
}

}  // namespace
}  // namespace canhil::inflight_alignment
