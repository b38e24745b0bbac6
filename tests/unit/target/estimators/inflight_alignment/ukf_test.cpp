// The unscented prediction, compared with the textbook transform: all 2 N + 1 points, with a negative weight
// of the centre.
#include <gtest/gtest.h>

#include <functional>
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
  const Dense sigmas = diagonal_matrix(entrywise_roots(diagonal(errors.P)));
  const Dense mix = identity(N) + 0.2 * random_dense(N, N, engine);
  errors.P = (sigmas * (mix * transposed(mix)) * sigmas).fixed<N, N>();
  errors.x = (0.5 * sigmas * random_dense(N, 1, engine)).fixed<N, 1>();
  return errors;
}

Interval some_interval() {
  const RecordedRun inputs(Aiding::ssbl);
  State state = initial(inputs.start, {});
  for (std::size_t i = 0; i < samples_per_fix; ++i) mechanise(state, inputs.imu[i]);
  return state.ins.interval;
}

struct Normal {
  Dense x, P;
};

// The textbook transform. `image` maps the errors over the interval, `root` is a matrix square root of P.
Normal as_written(const Dense& x, const Dense& root, const std::function<Dense(const Dense&)>& image,
                  const Interval& interval, const Settings& settings) {
  const int N = x.rows();
  const Dense centre = image(x);
  std::vector<Dense> difference;
  for (int j = 0; j < N; ++j)
    for (const double sign : {1.0, -1.0})
      difference.push_back(image(x + sign * std::sqrt(3.0) * root.column(j)) - centre);
  Dense shift(N, 1);
  for (const Dense& d : difference) shift = shift + d / 6;
  const bool about_mean = settings.ukf_covariance == UkfCovariance::about_mean;
  Normal after{centre + shift, Dense(N, N)};
  if (about_mean) after.P = (1 - N / 3.0) * shift * transposed(shift);
  for (Dense d : difference) {
    if (about_mean) d = d - shift;
    after.P = after.P + d * transposed(d) / 6;
  }
  for (int i = 0; i < 3; ++i) {
    after.P(3 + i, 3 + i) += settings.accel_noise_density * settings.accel_noise_density * interval.duration;
    after.P(6 + i, 6 + i) += settings.gyro_noise_density * settings.gyro_noise_density * interval.duration;
  }
  return after;
}

template <int N>
void expect_as_written(UkfRoot root, UkfCovariance covariance) {
  Settings settings;
  settings.ukf_root = root;
  settings.ukf_covariance = covariance;
  const Interval interval = some_interval();
  Errors<N> errors = some_errors<N>(0.3);
  const Dense root_of_P =
      root == UkfRoot::symmetric ? Dense(filtering::symmetric_root<N>(errors.P)) : lower_cholesky(errors.P);
  const auto image = [&](const Dense& x) -> Dense { return predicted<N>(x.fixed<N, 1>(), interval); };
  const Normal expected = as_written(errors.x, root_of_P, image, interval, settings);
  EXPECT_EQ(predict_ukf<N>(errors, interval, settings), 0);
  const Dense sigma = entrywise_roots(diagonal(expected.P));
  const Dense weights = inverse(diagonal_matrix(sigma));
  EXPECT_LT(largest(weights * (errors.P - expected.P) * weights), 1e-9);
  EXPECT_LT(largest(entrywise_quotient(errors.x - expected.x, sigma)), 1e-10);
  EXPECT_EQ(Dense(errors.P), transposed(errors.P));
}

TEST(Ukf, IsTheTransformAsWritten) {
  for (const UkfRoot root : {UkfRoot::lower_cholesky, UkfRoot::symmetric}) {
    for (const UkfCovariance covariance : {UkfCovariance::about_mean, UkfCovariance::about_central}) {
      expect_as_written<15>(root, covariance);
      expect_as_written<18>(root, covariance);
    }
  }
}

// W0 is negative, so the transform itself can give an indefinite P. Such a P is repaired, and the repair is
// counted.
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
