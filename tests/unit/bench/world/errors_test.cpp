#include <gtest/gtest.h>

#include <cmath>

#include "bench/world/imu_errors.hpp"
#include "bench/world/navigation_errors.hpp"
#include "bench/world/units.hpp"

namespace canhil::world {
namespace {

/// Mean and mean square of a sequence of vectors, by axis.
struct Moments {
  int n = 0;
  Vector3 sum = Vector3::Zero();
  Vector3 squares = Vector3::Zero();

  void add(const Vector3& x) {
    ++n;
    sum += x;
    squares += x.cwiseProduct(x);
  }
  // The limits are 5 standard deviations. The standard deviation of the mean of n numbers is sigma/sqrt(n);
  // that of their mean square is sigma^2 sqrt(2/n).
  void expect_normal(const Vector3& mean, const Vector3& sigma) const {
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(sum(i) / n, mean(i), 5 * sigma(i) / std::sqrt(n)) << "axis " << i;
      const double variance = squares(i) / n - std::pow(sum(i) / n, 2);
      EXPECT_NEAR(variance, std::pow(sigma(i), 2), 5 * std::pow(sigma(i), 2) * std::sqrt(2.0 / n))
          << "axis " << i;
    }
  }
};

constexpr std::int64_t dt_us = 10'000;
constexpr double dt = 0.01;
const ImuIncrement exact{
    .t_us = 30'000, .interval_us = dt_us, .delta_theta = {1e-4, 2e-4, -3e-4}, .delta_v = {0.1, 0.0, -0.098}};

ImuStreams streams(std::uint64_t run) {
  return ImuStreams::of("imu", [run](const std::string& name) { return Stream(1, run, name); });
}

TEST(ErroneousImu, WithoutErrorsIsExact) {
  ErroneousImu imu({}, streams(0));
  const ImuIncrement measured = imu.measure(exact);
  EXPECT_EQ(measured.delta_theta, exact.delta_theta);
  EXPECT_EQ(measured.delta_v, exact.delta_v);
  EXPECT_EQ(measured.t_us, exact.t_us);
  EXPECT_EQ(measured.interval_us, exact.interval_us);
}

TEST(ErroneousImu, GivenConstantsEnterAsTheModelSays) {
  ImuErrorModel model;
  model.gyro.bias.value = {1e-5, -2e-5, 3e-5};
  model.gyro.scale_factor.value = {1e-3, 0, -1e-3};
  model.accel.bias.value = {3e-3, 2e-3, 1e-3};
  ErroneousImu imu(model, streams(0));
  EXPECT_EQ(imu.gyro_bias(), model.gyro.bias.value);
  EXPECT_EQ(imu.accel_bias(), model.accel.bias.value);
  const ImuIncrement measured = imu.measure(exact);
  EXPECT_LT((measured.delta_theta - (Vector3(1.001e-4, 2e-4, -2.997e-4) + Vector3(1e-7, -2e-7, 3e-7))).norm(),
            1e-18);
  EXPECT_LT((measured.delta_v - (exact.delta_v + Vector3(3e-5, 2e-5, 1e-5))).norm(), 1e-16);
}

TEST(ErroneousImu, BiasesAreConstantInARunAndNormalOverRuns) {
  ImuErrorModel model;
  model.gyro.bias.sigma = Vector3::Constant(3 * units::degph);
  model.accel.bias.sigma = Vector3::Constant(300 * units::ug);
  Moments gyro;
  Moments accel;
  for (std::uint64_t run = 0; run < 5000; ++run) {
    ErroneousImu imu(model, streams(run));
    gyro.add(imu.gyro_bias());
    accel.add(imu.accel_bias());
    const Vector3 first = imu.measure(exact).delta_v;
    ASSERT_EQ(imu.measure(exact).delta_v, first);
    ASSERT_LT((first - exact.delta_v - imu.accel_bias() * dt).norm(), 1e-16);
  }
  gyro.expect_normal(Vector3::Zero(), model.gyro.bias.sigma);
  accel.expect_normal(Vector3::Zero(), model.accel.bias.sigma);
}

TEST(ErroneousImu, NoiseIsWhiteWithTheDensityGiven) {
  ImuErrorModel model;
  model.gyro.noise = Vector3(1, 2, 3) * 0.125 * units::degprth;
  model.accel.noise = Vector3(1, 2, 3) * 50 * units::ugprthz;
  ErroneousImu imu(model, streams(0));
  Moments gyro;
  Moments accel;
  Moments gyro_pairs;  // products of successive samples
  Moments accel_gyro;  // products across the triads
  Vector3 last = Vector3::Zero();
  for (int k = 0; k < 100'000; ++k) {
    const ImuIncrement measured = imu.measure(exact);
    const Vector3 theta = measured.delta_theta - exact.delta_theta;
    const Vector3 v = measured.delta_v - exact.delta_v;
    gyro.add(theta);
    accel.add(v);
    gyro_pairs.add(theta.cwiseProduct(last));
    accel_gyro.add(v.cwiseProduct(theta));
    last = theta;
  }
  // If white noise of density N is integrated over dt, the integral has the standard deviation N sqrt(dt).
  const Vector3 theta_sigma = model.gyro.noise * std::sqrt(dt);
  const Vector3 v_sigma = model.accel.noise * std::sqrt(dt);
  gyro.expect_normal(Vector3::Zero(), theta_sigma);
  accel.expect_normal(Vector3::Zero(), v_sigma);
  for (int i = 0; i < 3; ++i) {
    EXPECT_LT(std::abs(gyro_pairs.sum(i)), 5 * theta_sigma(i) * theta_sigma(i) * std::sqrt(100'000));
    EXPECT_LT(std::abs(accel_gyro.sum(i)), 5 * v_sigma(i) * theta_sigma(i) * std::sqrt(100'000));
  }
}

TEST(ErroneousImu, NoiseOfASecondDoesNotDependOnTheRate) {
  // 0.125 deg/sqrt(h) is 0.125 deg after one hour, for any sample interval. The test adds up the samples of
  // each second, for 3600 seconds.
  ImuErrorModel model;
  model.gyro.noise = Vector3::Constant(0.125 * units::degprth);
  for (const std::int64_t interval_us : {5'000, 20'000}) {
    ErroneousImu imu(model, streams(0));
    ImuIncrement still{.interval_us = interval_us};
    Moments seconds;
    for (int second = 0; second < 3600; ++second) {
      Vector3 angle = Vector3::Zero();
      for (std::int64_t t = 0; t < 1'000'000; t += interval_us) angle += imu.measure(still).delta_theta;
      seconds.add(angle);
    }
    seconds.expect_normal(Vector3::Zero(), Vector3::Constant(0.125 * units::deg / 60));
  }
}

TEST(ErroneousImu, MisalignmentFillsTheOffDiagonal) {
  ImuErrorModel model;
  model.accel.misalignment_sigma = 1e-3;
  const ImuIncrement along_x{.interval_us = dt_us, .delta_v = {1, 0, 0}};
  Moments leak;
  for (std::uint64_t run = 0; run < 5000; ++run) {
    ErroneousImu imu(model, streams(run));
    const Vector3 measured = imu.measure(along_x).delta_v;
    ASSERT_EQ(measured.x(), 1.0);
    leak.add({measured.y(), measured.z(), measured.y() * measured.z() * 1e3});
  }
  leak.expect_normal(Vector3::Zero(),
                     Vector3::Constant(1e-3).cwiseProduct(Vector3(1, 1, 0)) + Vector3(0, 0, 1e-3));
}

Truth somewhere() {
  return {.t_us = 500,
          .position = {.latitude = 0.6, .longitude = 2.0, .height = 1000},
          .v_eb_n = {100, 50, -5},
          .C_bn = C_bn_from({0.1, 0.2, 0.3})};
}

TEST(NavigationErrors, WithoutErrorsIsTheTruth) {
  Stream stream(1, 0, "master_ins");
  const NavigationSolution solution = measure(somewhere(), {}, stream);
  EXPECT_EQ(solution.t_us, 500);
  EXPECT_EQ(solution.position.latitude, 0.6);
  EXPECT_EQ(solution.position.longitude, 2.0);
  EXPECT_EQ(solution.position.height, 1000);
  EXPECT_EQ(solution.v_eb_n, somewhere().v_eb_n);
  EXPECT_EQ(solution.C_bn, somewhere().C_bn);
}

TEST(NavigationErrors, EachKindHasItsMomentsInNed) {
  const NavigationErrorModel model{.position = {.value = {5, 0, 0}, .sigma = {10, 20, 30}},
                                   .velocity = {.value = {0, 1, 0}, .sigma = {0.05, 0.1, 0.2}},
                                   .attitude = {.value = {0, 0, 0.01}, .sigma = {1e-3, 2e-3, 3e-3}}};
  const Truth truth = somewhere();
  Stream stream(1, 0, "master_ins");
  Moments position;
  Moments velocity;
  Moments attitude;
  for (int k = 0; k < 50'000; ++k) {
    const NavigationSolution solution = measure(truth, model, stream);
    position.add(displacement_n(truth.position, solution.position));
    velocity.add(solution.v_eb_n - truth.v_eb_n);
    attitude.add(misalignment(solution.C_bn, truth.C_bn));
  }
  position.expect_normal(model.position.value, model.position.sigma);
  velocity.expect_normal(model.velocity.value, model.velocity.sigma);
  attitude.expect_normal(model.attitude.value, model.attitude.sigma);
}

TEST(InitialErrors, AHeadingErrorTurnsFirstSoThatTiltsKeepTheirSize) {
  InitialErrorModel model;
  model.attitude.sigma = {1e-3, 2e-3, 0};
  model.heading_magnitude = 3;
  const Truth truth = somewhere();
  Stream stream(1, 0, "initial_error");
  Moments tilts;
  int to_the_right = 0;
  for (int k = 0; k < 50'000; ++k) {
    const NavigationSolution solution = initial_solution(truth, model, stream);
    const Matrix3 error = solution.C_bn * truth.C_bn.transpose();  // exp(-[phi x]) Rz(-psi)
    const double psi = -std::atan2(error(1, 0), error(0, 0));
    ASSERT_NEAR(std::abs(psi), 3, 0.02);
    to_the_right += psi > 0 ? 1 : 0;
    tilts.add(misalignment(error * rotation(Vector3(0, 0, psi)), Matrix3::Identity())
                  .cwiseProduct(Vector3(1, 1, 0)));
  }
  tilts.expect_normal(Vector3::Zero(), model.attitude.sigma);
  EXPECT_NEAR(to_the_right, 25'000, 5 * 112);  // binomial: sigma = sqrt(50'000) / 2
}

TEST(InitialErrors, ASpreadOfHeadingIsNormal) {
  InitialErrorModel model;
  model.heading_sigma = 0.1;
  Stream stream(1, 0, "initial_error");
  Moments heading;
  for (int k = 0; k < 50'000; ++k) {
    const Vector3 phi = misalignment(initial_solution(somewhere(), model, stream).C_bn, somewhere().C_bn);
    EXPECT_LT(phi.head<2>().norm(), 1e-12);
    heading.add({0, 0, phi.z()});
  }
  heading.expect_normal(Vector3::Zero(), {0, 0, 0.1});
}

TEST(InitialErrors, WithoutAHeadingErrorAreThoseOfANavigationSystem) {
  InitialErrorModel model;
  model.position.sigma = {1, 2, 3};
  model.velocity.sigma = {4, 5, 6};
  model.attitude.sigma = {0.1, 0.2, 0.3};
  Stream one(1, 0, "initial_error"), other(1, 0, "initial_error");
  const NavigationSolution a = initial_solution(somewhere(), model, one);
  const NavigationSolution b = measure(somewhere(), model, other);
  EXPECT_EQ(a.C_bn, b.C_bn);
  EXPECT_EQ(a.v_eb_n, b.v_eb_n);
  EXPECT_EQ(a.position.latitude, b.position.latitude);
}

}  // namespace
}  // namespace canhil::world
