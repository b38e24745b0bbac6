#include "target/estimators/strapdown/attitude.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <numbers>
#include <random>

#include "tests/unit/target/estimators/random_matrix.hpp"

namespace canhil::strapdown {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

TEST(Attitude, SkewIsTheCrossProduct) {
  const Vector3d a(1, -2, 3), b(0.5, 7, -1);
  const Dense cross =
      Vector3d(a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x());
  EXPECT_EQ(Dense(skew(a)) * b, cross);
}

Vector3d rotation_by(double angle, std::mt19937_64& engine) {
  const Dense axis = random_dense(3, 1, engine);
  return (angle / norm(axis) * axis).fixed<3, 1>();
}

// At 0.1 rad the implementation changes from the series to the closed form.
TEST(Attitude, ExpIsTheMatrixExponential) {
  std::mt19937_64 engine(1);
  for (const double angle : {0.0, 1e-9, 1e-3, 0.0999999, 0.1000001, 0.7, 3.0}) {
    const Vector3d phi = rotation_by(angle, engine);
    EXPECT_LT(largest_difference(exp_rotation(phi), matrix_exponential(skew(phi))), 3e-16 * (1 + 10 * angle))
        << angle;
  }
}

TEST(Attitude, LogInvertsExp) {
  std::mt19937_64 engine(2);
  for (const double angle : {0.0, 1e-8, 1e-3, 0.5, 2.0, std::numbers::pi - 1e-3}) {
    const Vector3d phi = rotation_by(angle, engine);
    EXPECT_LT(norm(Dense(log_rotation(exp_rotation(phi))) - phi), 1e-14) << angle;
  }
}

TEST(Attitude, MisalignmentHasTheErrorModelsSign) {
  const Matrix3d C_true = dcm_from_euler({0.1, -0.2, 2.5});
  const Vector3d phi(0.02, -0.03, 0.08);
  const Dense C_computed = transposed(matrix_exponential(skew(phi))) * C_true;  // exp(-[phi x]) C
  EXPECT_LT(norm(Dense(misalignment(C_computed.fixed<3, 3>(), C_true)) - phi), 1e-15);
}

TEST(Attitude, EulerAnglesAreHeadingPitchRoll) {
  const Euler e{0.3, -1.2, 2.9};
  const Matrix3d C = dcm_from_euler(e);
  // The x axis points forward: its north, east and down components are those of a unit vector with this
  // heading and pitch.
  const Vector3d forward(std::cos(e.pitch) * std::cos(e.heading), std::cos(e.pitch) * std::sin(e.heading),
                         -std::sin(e.pitch));
  EXPECT_LT(norm(Dense(C).column(0) - forward), 1e-15);
  EXPECT_GT(C(2, 1), 0) << "positive roll: the right wing is down";
  const Euler back = euler_from_dcm(C);
  EXPECT_NEAR(back.roll, e.roll, 1e-15);
  EXPECT_NEAR(back.pitch, e.pitch, 1e-15);
  EXPECT_NEAR(back.heading, e.heading, 1e-15);
}

TEST(Attitude, ReorthonormalisationSquaresTheError) {
  std::mt19937_64 engine(3);
  const Dense C = dcm_from_euler({0.3, 0.2, 0.1}) + 1e-6 * random_dense(3, 3, engine);
  const auto error = [](const Dense& m) { return norm(transposed(m) * m - identity(3)); };
  EXPECT_GT(error(C), 1e-6);
  EXPECT_LT(error(reorthonormalised(C.fixed<3, 3>())), 1e-10);
}

}  // namespace
}  // namespace canhil::strapdown
