// The error models, compared with the difference of an INS with errors and an INS without errors; their
// Jacobians, compared with finite differences.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "target/estimators/inflight_alignment/psi_angle.hpp"
#include "target/estimators/inflight_alignment/sin_cos.hpp"
#include "target/estimators/strapdown/attitude.hpp"
#include "target/estimators/strapdown/earth.hpp"
#include "tests/unit/target/estimators/inflight_alignment/dense.hpp"
#include "tests/unit/target/estimators/inflight_alignment/recorded_run.hpp"

namespace canhil::inflight_alignment {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using strapdown::NavState;

// The printed eq. (8) lacks the minus sign of the first row, so the printed matrix is not a rotation.
TEST(PsiAngle, PlatformToComputerIsTheRotationByRollPitchYaw) {
  const Vector3d psi(0.3, -0.2, 1.2);
  const Matrix3d C = platform_to_computer(psi);
  EXPECT_LT((C - strapdown::dcm_from_euler({psi.x(), psi.y(), psi.z()})).norm(), 1e-15);
  const Matrix3d turned = platform_to_computer({0, 0, 0.1});
  EXPECT_NEAR(turned(0, 1), -std::sin(0.1), 1e-16);
}

TEST(PsiAngle, RotationAxesAreThoseOfItsDerivatives) {
  const Vector3d psi(0.3, -0.2, 1.2), v(1, 2, 3);
  const double step = 1e-6;
  for (int i = 0; i < 3; ++i) {
    const Vector3d change = (platform_to_computer(psi + step * Vector3d::Unit(i)) * v -
                             platform_to_computer(psi - step * Vector3d::Unit(i)) * v) /
                            (2 * step);
    EXPECT_LT((change - rotation_axes(psi).col(i).cross(platform_to_computer(psi) * v)).norm(), 1e-9) << i;
  }
}

Matrix3d C_ne(const NavState& nav) {
  return (Eigen::AngleAxisd(nav.longitude, Vector3d::UnitZ()) *
          Eigen::AngleAxisd(-nav.latitude - std::numbers::pi / 2, Vector3d::UnitY()))
      .toRotationMatrix();
}

Vector3d r_eb_e(const NavState& nav) {
  const strapdown::LocalEarth earth = strapdown::local_earth(nav.latitude, nav.height);
  const double across = (earth.transverse_radius + nav.height) * earth.cos_latitude;
  const double up = earth.transverse_radius * (1 - strapdown::eccentricity_squared) + nav.height;
  return {across * std::cos(nav.longitude), across * std::sin(nav.longitude), up * earth.sin_latitude};
}

// The errors of an INS: C_pc, and position and velocity in the computer frame.
struct Truth {
  Matrix3d C_pc;
  Vector3d dR, dV;
};

Truth errors_of(const NavState& ins, const NavState& truth) {
  const Matrix3d C_tc = C_ne(ins).transpose() * C_ne(truth);
  return {C_tc * truth.C_bn * ins.C_bn.transpose(), C_ne(ins).transpose() * (r_eb_e(ins) - r_eb_e(truth)),
          ins.v_eb_n - C_tc * truth.v_eb_n};
}

// A vehicle turns for a tenth of a second, with an INS without errors and an INS that starts with all errors.
struct Flight {
  Vector3d accel_bias{0.05, -0.03, 0.04};   // [m/s^2]
  Vector3d gyro_bias{2e-4, -3e-4, 1.5e-4};  // [rad/s]
  Vector3d psi;                             // [rad]
  Truth start, end;
  Interval interval;

  explicit Flight(double tilt) : psi(tilt, -1.5 * tilt, 1.3) {
    State ins, truth;
    truth.ins.nav.C_bn = strapdown::dcm_from_euler({0.05, -0.04, 0.6});
    truth.ins.nav.latitude = 0.61;
    truth.ins.nav.height = -20;
    truth.ins.nav.v_eb_n << 40, -30, 3;
    ins = truth;
    ins.ins.nav.latitude += 300 / 6.36e6;
    ins.ins.nav.longitude -= 500 / 5.2e6;
    ins.ins.nav.height += 400;
    ins.ins.nav.v_eb_n += Vector3d(50, 70, -40);
    // The attitude of the INS is chosen so that C_pc is the rotation by the given psi.
    const Matrix3d C_tc = C_ne(ins.ins.nav).transpose() * C_ne(truth.ins.nav);
    ins.ins.nav.C_bn = platform_to_computer(psi).transpose() * C_tc * truth.ins.nav.C_bn;
    start = errors_of(ins.ins.nav, truth.ins.nav);
    constexpr int samples = 100;
    constexpr double dt = 0.1 / samples;
    for (int k = 0; k < samples; ++k) {
      const strapdown::ImuIncrement imu{Vector3d(0.02, -0.01, 0.15) * dt, Vector3d(0.8, 0.5, -9.7) * dt, dt};
      mechanise(truth, imu);
      mechanise(ins, {imu.delta_theta + gyro_bias * dt, imu.delta_v + accel_bias * dt, dt});
    }
    end = errors_of(ins.ins.nav, truth.ins.nav);
    interval = ins.ins.interval;
  }
};

// The tolerances are needed because the model is of first order in T. But every term of the model changes the
// result by more than its tolerance: the Coriolis term by 1e-3 m/s, the gravity error by 8e-5 m/s, the
// rotation of the frame by 7e-4 m, the earth rate through C_pc by 7e-6 rad, and E by 1e-7 rad.
TEST(PsiAngle, PredictsTheErrorsOfAnIns) {
  const Flight flight(0.01);
  Vector<15> x;
  x << flight.start.dR, flight.start.dV, flight.psi, flight.accel_bias, flight.gyro_bias;
  const Vector<15> next = predicted<15>(x, flight.interval);
  EXPECT_LT((next.segment<3>(0) - flight.end.dR).norm(), 1e-4);
  EXPECT_LT((next.segment<3>(3) - flight.end.dV).norm(), 4e-5);
  const Matrix3d off = platform_to_computer(next.segment<3>(6)) * flight.end.C_pc.transpose();
  EXPECT_LT(strapdown::log_rotation(off).norm(), 1e-8);
}

// Splits C_pc into exp([phi x]) Rz(psi_z). The heading comes from the upper left 2x2 block, and the tilts
// come from the remaining rotation.
Vector<4> states(const Matrix3d& C_pc) {
  const double psi = std::atan2(C_pc(1, 0) - C_pc(0, 1), C_pc(0, 0) + C_pc(1, 1));
  const Vector3d phi = strapdown::log_rotation(C_pc * strapdown::exp_rotation({0, 0, -psi}));
  return {phi.x(), phi.y(), std::sin(psi), 1 - std::cos(psi)};
}

// In the levelled form, the heading error rotates the biases.
Errors<16> errors_at_the_start(const Flight& flight, SinCosForm form) {
  Errors<16> errors;
  errors.form = form;
  errors.x << flight.start.dR, flight.start.dV, states(flight.start.C_pc), flight.accel_bias,
      flight.gyro_bias;
  const Matrix3d Rz = axes_of_biases<16>(errors).transpose();
  errors.x.segment<3>(10) = (Rz * flight.accel_bias).eval();
  errors.x.segment<3>(13) = (Rz * flight.gyro_bias).eval();
  return errors;
}

TEST(SinCos, PredictsTheErrorsOfAnIns) {
  for (const SinCosForm form : {SinCosForm::published, SinCosForm::levelled}) {
    const Flight flight(0.001);  // the model is of first order in the tilts
    const Errors<16> errors = errors_at_the_start(flight, form);
    const Vector<16> next = predicted_sin_cos<16>(errors, flight.interval);
    EXPECT_LT((next.segment<3>(0) - flight.end.dR).norm(), 1e-4);
    EXPECT_LT((next.segment<3>(3) - flight.end.dV).norm(), 4e-5);
    EXPECT_LT((next.segment<4>(6) - states(flight.end.C_pc)).norm(), 1e-7);
  }
}

// With tilts of 10 and 15 deg, the second order in the tilts contributes 0.48 m/s^2 to the vertical force,
// 0.048 m/s in the interval. Terms of higher order amount to 8e-4 m/s.
TEST(SinCos, LevelledPredictsTheVerticalVelocityToTheSecondOrderOfTheTilts) {
  const Flight flight(10 * rad_per_deg);
  const auto off = [&](SinCosForm form) {
    const Errors<16> errors = errors_at_the_start(flight, form);
    return std::abs(predicted_sin_cos<16>(errors, flight.interval)(5) - flight.end.dV.z());
  };
  EXPECT_GT(off(SinCosForm::published), 0.02);
  EXPECT_LT(off(SinCosForm::levelled), 0.002);
}

// A level vehicle with unknown tilts. The predicted mean and variance of the vertical velocity error after 1
// s must equal those of g phi^2 / 2 for two normally distributed tilts.
TEST(SinCos, LevelledKnowsWhatUnknownTiltsDoToTheVertical) {
  Interval interval;
  interval.duration = 1;
  interval.delta_v_n << 0, 0, -standard_gravity;
  interval.C_bn_integral.setIdentity();
  Settings settings;
  settings.accel_noise_density = settings.gyro_noise_density = 0;
  constexpr double variance = 0.01;  // (5.7 deg)^2
  Errors<16> errors;
  errors.P(6, 6) = errors.P(7, 7) = variance;
  predict_sin_cos<16>(errors, interval, settings);
  EXPECT_NEAR(errors.x(5), -standard_gravity * variance, 1e-12);
  EXPECT_NEAR(errors.P(5, 5), 4 * standard_gravity * standard_gravity * variance * variance, 1e-12);
}

template <int N>
Matrix<N, N> central_differences(const std::function<Vector<N>(const Vector<N>&)>& map, const Vector<N>& x) {
  Matrix<N, N> J;
  const double step = 1e-5;
  for (int i = 0; i < N; ++i)
    J.col(i) = (map(x + step * Vector<N>::Unit(i)) - map(x - step * Vector<N>::Unit(i))) / (2 * step);
  return J;
}

TEST(PsiAngle, JacobianIsThatOfCentralDifferences) {
  const Flight flight(0.01);
  Vector<18> x;
  x << flight.start.dR, flight.start.dV, flight.psi, flight.accel_bias, flight.gyro_bias, 1, -2, 3;
  // The filter uses E = I, so here the predicted Euler rates are converted back into rotation rates.
  const auto without_E = [&](const Vector<18>& at) {
    Vector<18> next = predicted<18>(at, flight.interval);
    const Vector3d psi = at.segment<3>(6), rates = next.segment<3>(6) - psi;
    // The axes are given in frame c, so the axes times the rates are the rotation rate in c. C_pc' transforms
    // this rate to p.
    next.segment<3>(6) = psi + platform_to_computer(psi).transpose() * rotation_axes(psi) * rates;
    return next;
  };
  const Matrix<18, 18> expected = central_differences<18>(without_E, x) - Matrix<18, 18>::Identity();
  const Matrix<18, 18> G = dense<18>(transition<18>(x, flight.interval));
  EXPECT_LT((G - expected).cwiseAbs().maxCoeff(), 1e-8);
}

// The first-order terms are exact for zero tilts and biases, at any heading.
TEST(SinCos, JacobianIsThatOfCentralDifferences) {
  const Flight flight(0.01);
  for (const SinCosForm form : {SinCosForm::published, SinCosForm::levelled}) {
    Errors<19> errors;
    errors.form = form;
    errors.x << flight.start.dR, flight.start.dV, 0, 0, 0.7, 0.4, Vector<6>::Zero(), 1, -2, 3;
    const auto map = [&](const Vector<19>& at) {
      Errors<19> moved = errors;
      moved.x = at;
      return predicted_sin_cos<19>(moved, flight.interval);
    };
    const Matrix<19, 19> expected = central_differences<19>(map, errors.x) - Matrix<19, 19>::Identity();
    const Matrix<19, 19> G = dense<19>(transition_sin_cos<19>(errors, flight.interval));
    EXPECT_LT((G - expected).cwiseAbs().maxCoeff(), 1e-8);
  }
}

// The row of the vertical velocity in the Jacobian is exact at any tilt.
TEST(SinCos, JacobianOfTheVerticalForceHoldsWithTilts) {
  const Flight flight(0.01);
  Errors<16> errors;
  errors.x.segment<4>(6) << 0.1, -0.2, 0.7, 0.4;
  const auto map = [&](const Vector<16>& at) {
    Errors<16> moved = errors;
    moved.x = at;
    return predicted_sin_cos<16>(moved, flight.interval);
  };
  const Matrix<16, 16> expected = central_differences<16>(map, errors.x);
  const Matrix<16, 16> G = dense<16>(transition_sin_cos<16>(errors, flight.interval));
  EXPECT_LT((G.block<1, 4>(5, 6) - expected.block<1, 4>(5, 6)).norm(), 1e-8);
}

// At any heading error, the product of the remaining attitude and the removed attitude equals the attitude
// before the removal. An error of (s, k) changes both parts, so the new P must be the covariance of the error
// of the remaining part.
TEST(SinCos, TiltTakenOutLeavesTheSameAttitude) {
  Errors<19> errors;
  const Vector3d platform_tilt(0.12, -0.07, 0);
  const double psi = 1.9;
  const Vector3d phi = strapdown::exp_rotation({0, 0, psi}) * platform_tilt;
  errors.x.segment<4>(6) << phi.x(), phi.y(), std::sin(psi), 1 - std::cos(psi);
  Vector<19> truth = errors.x;
  truth.segment<4>(6) += Vector<4>(0.01, -0.02, 0.1, 0.2);
  const Vector<19> off = truth - errors.x;
  errors.P = off * off.transpose();
  const Matrix3d before = tilt_and_heading<19>(errors.x);
  const Matrix3d out = take_out_tilt<19>(errors);
  EXPECT_LT(strapdown::log_rotation(tilt_and_heading<19>(errors.x) * out * before.transpose()).norm(), 2e-3);
  const Vector3d taken = strapdown::log_rotation(out);
  const Vector3d remains =
      truth.segment<3>(6) - Vector3d((1 - truth(9)) * taken.x() - truth(8) * taken.y(),
                                     (1 - truth(9)) * taken.y() + truth(8) * taken.x(), 0);
  Vector<19> left = off;
  left.segment<2>(6) = remains.head<2>() - errors.x.segment<2>(6);
  EXPECT_LT((errors.P - left * left.transpose()).norm(), 1e-12);
}

// With unknown heading, the tilt is known only in platform axes, through its correlation with (s, k).
TEST(SinCos, TiltIsTakenOutBeforeTheHeadingIsKnown) {
  Errors<16> errors;
  errors.x(9) = 1;  // (s, 1 - k) = 0: any heading
  const Vector3d platform_tilt(0.05, -0.03, 0);
  errors.P(8, 8) = errors.P(9, 9) = 0.5;
  // The tilt is phi = Rz phi_p. So errors ds and dk cause the errors dphi_x = -phi_px dk - phi_py ds and
  // dphi_y = -phi_py dk + phi_px ds.
  errors.P(6, 8) = errors.P(8, 6) = -0.5 * platform_tilt.y();
  errors.P(6, 9) = errors.P(9, 6) = -0.5 * platform_tilt.x();
  errors.P(7, 8) = errors.P(8, 7) = 0.5 * platform_tilt.x();
  errors.P(7, 9) = errors.P(9, 7) = -0.5 * platform_tilt.y();
  errors.P(6, 6) = errors.P(7, 7) = 0.5 * platform_tilt.squaredNorm();
  EXPECT_LT((strapdown::log_rotation(take_out_tilt<16>(errors)) - platform_tilt).norm(), 1e-12);
  const Matrix<2, 2> left = errors.P.block<2, 2>(6, 6);
  EXPECT_LT(left.norm(), 1e-12);
}

// The biases, rotated by the heading error, become the biases in body axes; P is transformed accordingly.
TEST(SinCos, BiasesTurnedBackAreThoseOfTheBody) {
  Errors<16> errors;
  const double psi = 1.9, d_psi = 1e-5;
  const Vector3d bias(0.01, -0.02, 0.005), d_bias(1e-7, 2e-7, -1e-7);
  const auto turned = [](double by, const Vector3d& b) {
    return Vector3d(strapdown::exp_rotation({0, 0, by}) * b);
  };
  const auto at = [&](double heading, const Vector3d& b) {
    Vector<16> x = Vector<16>::Zero();
    x.segment<2>(8) << std::sin(heading), 1 - std::cos(heading);
    x.segment<3>(10) = turned(heading, b);
    x.segment<3>(13) = turned(heading, -2 * b);
    return x;
  };
  errors.x = at(psi, bias);
  const Vector<16> off = at(psi + d_psi, bias + d_bias) - errors.x;
  errors.P = off * off.transpose();
  turn_biases_back<16>(errors);
  Vector<16> expected = off;
  expected.segment<3>(10) = d_bias;
  expected.segment<3>(13) = -2 * d_bias;
  EXPECT_LT((errors.x.segment<3>(10) - bias).norm(), 1e-15);
  EXPECT_LT((errors.x.segment<3>(13) + 2 * bias).norm(), 1e-15);
  EXPECT_LT((errors.P - expected * expected.transpose()).norm(), 1e-4 * off.squaredNorm());
  EXPECT_LT((errors.P.block<6, 6>(10, 10) - (expected * expected.transpose()).block<6, 6>(10, 10)).norm(),
            1e-17);
}

// The covariance has rank one: a single error of the estimate. After the attitude is taken out, P must be the
// covariance of the error of the remaining attitude. If the tilts of 2 deg are not taken out (as published),
// P is wrong by 3.5 %.
TEST(SinCos, AttitudeTakenOutLeavesTheCovarianceOfWhatRemains) {
  Errors<19> errors;
  const double psi = 1.9, d_psi = 1e-5;
  errors.x.segment<4>(6) << 0.035, -0.02, std::sin(psi), 1 - std::cos(psi);
  Vector<19> truth = errors.x;
  truth(6) += 2e-7;  // the tilts are known far better than the heading
  truth(7) -= 4e-7;
  truth(8) = std::sin(psi + d_psi);
  truth(9) = 1 - std::cos(psi + d_psi);
  Vector<19> off = truth - errors.x;
  off(3) = 1e-5;
  off(12) = -1e-5;
  errors.P = off * off.transpose();
  const Matrix3d remains = tilt_and_heading<19>(truth) * tilt_and_heading<19>(errors.x).transpose();
  const Matrix3d out = take_out_attitude<19>(errors);
  EXPECT_LT((remains * out - tilt_and_heading<19>(truth)).norm(), 1e-14);

  // Neglected: the heading component of phi x dphi / 2 (1e-8), and phi^2 / 2 of d_psi (8e-9); together 2e-3
  // of d_psi.
  off.segment<4>(6) << states(remains).head<3>(), 0;
  EXPECT_NEAR(off(8), d_psi, 3e-3 * d_psi);
  const Matrix<19, 19> expected = off * off.transpose();
  EXPECT_LT((errors.P - expected).cwiseAbs().maxCoeff(), 3e-3 * d_psi * d_psi);
  EXPECT_TRUE(errors.x.isZero(0));
}

TEST(SinCos, PriorHasTheMomentsOfANormalHeading) {
  for (const double sigma : {0.1, 1.0, 10.0}) {
    Errors<16> errors;
    set_heading_prior<16>(errors, sigma);
    double s2 = 0, k = 0, k2 = 0, weight = 0;
    for (int i = -40000; i <= 40000; ++i) {
      const double psi = sigma * i * 2e-4, w = std::exp(-psi * psi / (2 * sigma * sigma));
      weight += w, s2 += w * std::sin(psi) * std::sin(psi), k += w * (1 - std::cos(psi));
      k2 += w * (1 - std::cos(psi)) * (1 - std::cos(psi));
    }
    EXPECT_NEAR(errors.x(9), k / weight, 1e-6) << sigma;
    EXPECT_NEAR(errors.P(8, 8), s2 / weight, 1e-6);
    EXPECT_NEAR(errors.P(9, 9), k2 / weight - k * k / weight / weight, 1e-6);
  }
}

}  // namespace
}  // namespace canhil::inflight_alignment
