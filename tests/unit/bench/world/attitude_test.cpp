#include "bench/world/attitude.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "bench/world/units.hpp"

namespace canhil::world {
namespace {

using units::deg;

TEST(Attitude, EulerAnglesTurnBodyAxesAsThePilotSaysIt) {
  // Heading east: body x points east, body y south.
  const Matrix3 east = C_bn_from({.heading = 90 * deg});
  EXPECT_LT((east * Vector3::UnitX() - Vector3::UnitY()).norm(), 1e-15);
  EXPECT_LT((east * Vector3::UnitY() + Vector3::UnitX()).norm(), 1e-15);
  // Nose up: body x points upwards, along -z.
  EXPECT_NEAR((C_bn_from({.pitch = 30 * deg}) * Vector3::UnitX()).z(), -0.5, 1e-15);
  // Right wing down: body y points down.
  EXPECT_NEAR((C_bn_from({.roll = 30 * deg}) * Vector3::UnitY()).z(), 0.5, 1e-15);
}

TEST(Attitude, EulerAnglesComeBack) {
  for (const double roll : {-170.0, -20.0, 0.0, 100.0}) {
    for (const double pitch : {-80.0, 0.0, 35.0}) {
      for (const double heading : {-179.0, 0.0, 45.0, 135.0}) {
        const Euler back = euler_from(C_bn_from({roll * deg, pitch * deg, heading * deg}));
        EXPECT_NEAR(back.roll, roll * deg, 1e-14);
        EXPECT_NEAR(back.pitch, pitch * deg, 1e-14);
        EXPECT_NEAR(back.heading, heading * deg, 1e-14);
      }
    }
  }
}

TEST(Attitude, StraightUpAndDownHaveAPitchAndNoNaN) {
  // Rounding may leave an entry just above 1.
  Matrix3 up = C_bn_from({.pitch = 90 * deg});
  up(2, 0) = -1.0 - 1e-15;
  EXPECT_DOUBLE_EQ(euler_from(up).pitch, 90 * deg);
}

TEST(Attitude, SkewIsTheCrossProduct) {
  const Vector3 a(1, -2, 3);
  const Vector3 b(-4, 0.5, 6);
  EXPECT_EQ(skew(a) * b, a.cross(b));
}

TEST(Attitude, RotationIsTheMatrixExponential) {
  const Vector3 a(0.3, -0.2, 0.5);
  const Matrix3 S = skew(a);
  Matrix3 sum = Matrix3::Identity();
  Matrix3 term = Matrix3::Identity();
  for (int k = 1; k < 25; ++k) {
    term = Matrix3(term * S / k);
    sum += term;
  }
  EXPECT_LT((rotation(a) - sum).norm(), 1e-15);
  EXPECT_EQ(rotation(Vector3::Zero()), Matrix3::Identity());
}

TEST(Attitude, BodyRateIsTheDerivativeOfC) {
  const Euler angles{0.4, -0.7, 2.0};
  const Euler rates{0.3, 0.2, -0.5};
  const double h = 1e-5;
  const auto at = [&](double t) {
    return C_bn_from(
        {angles.roll + rates.roll * t, angles.pitch + rates.pitch * t, angles.heading + rates.heading * t});
  };
  const Matrix3 derivative = (at(h) - at(-h)) / (2 * h);  // equals C [omega x] up to terms in h^2
  EXPECT_LT((derivative - at(0) * skew(omega_nb_b(angles, rates))).norm(), 1e-9);
}

TEST(Attitude, MisalignmentHasTheSignOfThePaper) {
  // For a small phi, the computed attitude is (I - [phi x]) C. A positive phi about the down axis turns the
  // computed heading to port.
  const Matrix3 C = C_bn_from({0.1, 0.2, 0.3});
  const Vector3 small(1e-8, -2e-8, 3e-8);
  EXPECT_LT((misaligned(C, small) - (Matrix3::Identity() - skew(small)) * C).norm(), 1e-15);
  const Euler turned = euler_from(misaligned(C_bn_from({.heading = 1.0}), {0, 0, 5 * deg}));
  EXPECT_NEAR(turned.heading, 1.0 - 5 * deg, 1e-15);
}

TEST(Attitude, MisalignmentIsTheInverseOfMisaligned) {
  const Matrix3 C = C_bn_from({0.5, -0.3, 2.5});
  for (const double size : {0.0, 1e-9, 1e-3, 0.1, 3.0}) {
    const Vector3 phi = size * Vector3(1, -2, 2) / 3;
    EXPECT_LT((misalignment(misaligned(C, phi), C) - phi).norm(), 1e-15 + 1e-14 * size);
  }
}

}  // namespace
}  // namespace canhil::world
