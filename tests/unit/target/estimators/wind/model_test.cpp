// Each equation of the model, compared with its physical meaning. If a corrected equation is replaced by the
// printed equation, the test with its number in the name fails.
#include "target/estimators/wind/model.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>

#include "target/estimators/strapdown/attitude.hpp"
#include "target/estimators/wind/filter.hpp"

namespace canhil::wind {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

StateVector state(const Vector3d& v_a, const Vector3d& omega, const Vector3d& attitude,
                  const Vector3d& wind) {
  StateVector x;
  x << v_a, omega, attitude, wind;
  return x;
}

const Design& design() {
  static const Design design = make_design({});
  return design;
}

const StateVector banked = state({200, 9, 14}, {0.2, -0.1, 0.15}, {0.6, -0.3, 2.1}, {10, -40, 1});
constexpr Deflection some_fins{0.05, -0.03, 0.08};

Inputs at_altitude(double altitude, const Deflection& fins = some_fins) {
  return {fins, standard_atmosphere(altitude)};
}
Inputs vacuum() { return {some_fins, {0, 300}}; }

StateVector rate_of(const StateVector& x, const Inputs& inputs, const Design& d = design()) {
  RangeFlags outside;
  return derivative(x, inputs, d, outside);
}

// Derivative of a function of the state along its motion, by central differences.
template <class Function>
auto along_motion(const StateVector& x, const Inputs& inputs, const Function& function) {
  const double h = 1e-5;
  const StateVector f = rate_of(x, inputs);
  return ((function(StateVector(x + h * f)) - function(StateVector(x - h * f))) / (2 * h)).eval();
}

Matrix3d attitude_of(const StateVector& x) {
  return strapdown::dcm_from_euler({x(attitude_at), x(attitude_at + 1), x(attitude_at + 2)});
}

Covariance dense(const Jacobian& A) {
  Covariance M = Covariance::Zero();
  M.block<3, 3>(0, 0) = A.aa;
  M.block<3, 3>(0, 3) = A.ao;
  M.block<3, 3>(0, 6) = A.ap;
  M.block<3, 3>(3, 0) = A.oa;
  M.block<3, 3>(3, 3) = A.oo;
  M.block<3, 3>(6, 3) = A.po;
  M.block<3, 3>(6, 6) = A.pp;
  return M;
}

double jacobian_miss(const StateVector& x, const Inputs& inputs) {
  RangeFlags outside;
  const Covariance A = dense(linearise(x, inputs, design(), outside).A);
  Covariance differences;
  for (int j = 0; j < 12; ++j) {
    const double h = 3e-6 * std::max(1.0, std::abs(x(j)));
    StateVector up = x, down = x;
    up(j) += h;
    down(j) -= h;
    differences.col(j) = (rate_of(up, inputs) - rate_of(down, inputs)) / (up(j) - down(j));
  }
  return (A - differences).cwiseAbs().maxCoeff() / A.cwiseAbs().maxCoeff();
}

TEST(WindModel, JacobianIsThatOfCentralDifferences) {
  const std::array states{banked, state({252, -2.5, 0.4}, {0, 0, 0}, {-0.003, 0, -0.001}, {4, 60, 0}),
                          state({165, 20, -10}, {1, 0.5, -0.7}, {-2.5, 1.2, -3}, {0, 0, 0}),
                          state({290, 0, 10}, {0.1, 0.1, 0.1}, {0, -1.4, 0}, {0, 0, 0})};  // in the drag rise
  for (const StateVector& x : states)
    for (const double altitude : {0.0, 9000.0, 15'000.0})
      EXPECT_LT(jacobian_miss(x, at_altitude(altitude)), 1e-6) << x.transpose() << " at " << altitude;
}

// Compares every entry; the tolerance depends on the largest entry of the column, not of the matrix.
TEST(WindModel, JacobianIsRightColumnByColumn) {
  RangeFlags outside;
  const Inputs inputs = at_altitude(9000);
  const Covariance A = dense(linearise(banked, inputs, design(), outside).A);
  for (int j = 0; j < 9; ++j) {
    const double h = 3e-6 * std::max(1.0, std::abs(banked(j)));
    StateVector up = banked, down = banked;
    up(j) += h;
    down(j) -= h;
    const StateVector difference = (rate_of(up, inputs) - rate_of(down, inputs)) / (up(j) - down(j));
    for (int i = 0; i < 9; ++i)
      EXPECT_NEAR(A(i, j), difference(i), 1e-6 * std::max(A.col(j).cwiseAbs().maxCoeff(), 1.0) * 0.1)
          << i << ' ' << j;
  }
}

TEST(WindModel, JacobianOfTheHeldModelIsThatOfCentralDifferences) {
  const std::array states{state({100, 0, 60}, {0.1, 0, 0}, {0, 0, 0}, {0, 0, 0}),         // alpha
                          state({200, 90, 5}, {0, 0.1, 0}, {0, 0, 0}, {0, 0, 0}),         // beta
                          state({30, 1, 1}, {0, 0, 0.1}, {0, 0, 0}, {0, 0, 0}),           // too slow
                          state({330, 1, 1}, {0.1, 0, 0}, {0, 0, 0}, {0, 0, 0}),          // Mach
                          state({200, 1, 1}, {0.1, 0.2, 0}, {0.5, 1.53, 0}, {0, 0, 0})};  // pitch
  for (const StateVector& x : states) {
    RangeFlags outside;
    linearise(x, at_altitude(9000), design(), outside);
    EXPECT_TRUE(outside.any()) << x.transpose();
    EXPECT_LT(jacobian_miss(x, at_altitude(9000)), 1e-6) << x.transpose();
  }
}

TEST(WindModel, ObservationJacobianIsThatOfCentralDifferences) {
  const GroundVelocity at = ground_velocity(banked);
  EXPECT_LT((at.C_bn - attitude_of(banked)).cwiseAbs().maxCoeff(), 1e-15);
  for (int j = 0; j < 3; ++j) {
    StateVector up = banked, down = banked;
    up(attitude_at + j) += 1e-5;
    down(attitude_at + j) -= 1e-5;
    const Vector3d difference = (ground_velocity(up).C_v_a - ground_velocity(down).C_v_a) / 2e-5;
    EXPECT_LT((at.by_attitude.col(j) - difference).cwiseAbs().maxCoeff(), 1e-6);
  }
}

// Eqs. (3), (16): for any rotation, only force and gravity change the ground velocity C_bn v_a + v_w. The
// printed -omega x (v_a + v_w), a force not divided by the mass, or a sum of body and NED vectors would fail.
TEST(WindModel, Eq3And16GroundAccelerationIsForcePerMassAndGravity) {
  const Inputs inputs = at_altitude(9000);
  const auto v_eb_n = [](const StateVector& x) -> Vector3d { return ground_velocity(x).C_v_a + x.tail<3>(); };
  const Flow f = flow(banked.head<3>(), banked.segment<3>(rate_at), inputs.air, airframe_table);
  const Loads load = loads(f, coefficients(f, some_fins, airframe_table), inputs.air, airframe_table);
  const Vector3d expected = attitude_of(banked) * load.specific_force + Vector3d(0, 0, 9.80665);
  EXPECT_LT((along_motion(banked, inputs, v_eb_n) - expected).norm(), 1e-6);

  Airframe heavy = airframe_table;
  heavy.mass *= 2;
  const Loads half = loads(f, coefficients(f, some_fins, heavy), inputs.air, heavy);
  EXPECT_LT((2 * half.specific_force - load.specific_force).norm(), 1e-12);
}

// Eq. (4): without air the angular momentum is constant.
TEST(WindModel, Eq4AngularMomentumIsConservedWithoutAir) {
  const auto momentum = [](const StateVector& x) -> Vector3d {
    return attitude_of(x) * design().inertia * x.segment<3>(rate_at);
  };
  EXPECT_LT(along_motion(banked, vacuum(), momentum).norm(), 1e-7);
  EXPECT_EQ(design().inertia(0, 2), -airframe_table.Ixz);
}

// Eq. (5): d(C_bn)/dt = C_bn [omega x]; the printed third row or a missing omega would fail this test.
TEST(WindModel, Eq5EulerAnglesFollowTheRates) {
  const auto motion = along_motion(banked, at_altitude(9000), attitude_of);
  const Matrix3d expected = attitude_of(banked) * strapdown::skew(banked.segment<3>(rate_at));
  EXPECT_LT((motion - expected).cwiseAbs().maxCoeff(), 1e-8);
}

// Eq. (7): in the plane of symmetry, the lift is perpendicular to the flow and the drag acts against the
// flow; the side force acts along y. The test also computes the same force in full wind axes, in which the
// side force S has the opposite sign in the paper.
TEST(WindModel, Eq7ForcesAreOfStabilityAxesAndBodySideForce) {
  const Air air = standard_atmosphere(9000);
  const Vector3d v_a(200, 25, 30);
  const Flow f = flow(v_a, Vector3d(0.1, 0.2, 0.3), air, airframe_table);
  const Coefficients c = coefficients(f, some_fins, airframe_table);
  const Vector3d specific = loads(f, c, air, airframe_table).specific_force;
  const double force = 0.5 * air.density * v_a.squaredNorm() * airframe_table.area / airframe_table.mass;
  const double L = force * c.lift, D = force * c.drag, Y = force * c.side;
  const Vector3d stability_x = Vector3d(v_a.x(), 0, v_a.z()).normalized();
  const Vector3d stability_z = stability_x.cross(Vector3d::UnitY());
  EXPECT_NEAR(specific.dot(stability_x), -D, 1e-12);
  EXPECT_NEAR(specific.dot(stability_z), -L, 1e-12);
  EXPECT_NEAR(specific.y(), Y, 1e-12);
  EXPECT_GT(c.lift, 0);
  EXPECT_GT(f.beta, 0);
  const Vector3d slip = loads(f, coefficients(f, {}, airframe_table), air, airframe_table).specific_force;
  EXPECT_LT(slip.y(), 0);  // wind from the right pushes to the left
  const double cb = std::cos(f.beta), sb = std::sin(f.beta), ca = f.cos_alpha, sa = f.sin_alpha;
  const double D_wind = D * cb - Y * sb, S = Y * cb + D * sb;  // along and across the flow
  EXPECT_NEAR(specific.x(), -D_wind * ca * cb - S * ca * sb + L * sa, 1e-12);
  EXPECT_NEAR(specific.y(), -D_wind * sb + S * cb, 1e-12);
  EXPECT_NEAR(specific.z(), -D_wind * sa * cb - S * sa * sb - L * ca, 1e-12);
}

// Eq. (8): gravity has no moment about the centre of gravity.
TEST(WindModel, Eq8GravityGivesNoMoment) {
  StateVector x = banked;
  x.segment<3>(rate_at).setZero();
  EXPECT_EQ(rate_of(x, vacuum()).segment<3>(rate_at), Vector3d::Zero());
}

// Eqs. (9)-(14): the table of the airframe, computed by hand for alpha = 0.1, beta = 0.05 at Mach 0.6.
TEST(WindModel, Eq9To14CoefficientsAreThoseOfTheTable) {
  Flow f;
  f.alpha = 0.1;
  f.beta = 0.05;
  f.mach = 0.6;
  f.compressibility = 1 + 0.3 * 0.36;
  f.rates = {0.01, 0.002, -0.004};
  const Coefficients c = coefficients(f, {0.1, 0.2, -0.1}, airframe_table);
  EXPECT_NEAR(c.lift, 1.108 * (0.1 + 0.55 + 0.04) + 0.012, 1e-15);
  EXPECT_NEAR(c.side, 1.108 * (-0.045 - 0.025) - 0.0014, 1e-15);
  EXPECT_NEAR(c.roll, 1.108 * (-0.0025 + 0.016 - 0.001) - 0.005 - 0.0004, 1e-15);
  EXPECT_NEAR(c.pitch, 1.108 * (0.06 - 0.15 - 0.18) - 0.054, 1e-15);
  EXPECT_NEAR(c.yaw, 1.108 * (0.004 - 0.001 + 0.01) - 0.0003 + 0.001, 1e-15);
  const double wave = 0.03 * (1 + std::tanh((0.6 - 0.92) / 0.04));
  EXPECT_NEAR(c.drag, 0.07 + 0.05 * c.lift * c.lift + 0.5 * 0.0025 + 0.3 * 0.06 + wave, 1e-15);
}

TEST(WindModel, AtmosphereIsTheStandardOne) {
  EXPECT_NEAR(standard_atmosphere(0).density, 1.2250, 5e-5);
  EXPECT_NEAR(standard_atmosphere(0).speed_of_sound, 340.294, 5e-4);
  EXPECT_NEAR(standard_atmosphere(5000).density, 0.73612, 5e-5);
  EXPECT_NEAR(standard_atmosphere(11'000).density, 0.36392, 5e-5);
  EXPECT_NEAR(standard_atmosphere(20'000).density, 0.08803, 5e-5);
  EXPECT_NEAR(standard_atmosphere(20'000).speed_of_sound, 295.07, 5e-3);
  EXPECT_EQ(standard_atmosphere(1e6).density, standard_atmosphere(20'000).density);
}

// The noise of Eq. (3): the noise of the wind also enters the air velocity, so that this noise does not
// change the ground velocity.
TEST(WindModel, Eq3NoiseWindNoiseDoesNotMoveTheGroundVelocity) {
  Settings settings;
  settings.density = {0, 0, 0, 0.3};
  const auto added = [&](ProcessNoise noise) {
    settings.process_noise = noise;
    StateVector x = banked;
    Covariance P = Covariance::Zero();
    RangeFlags outside;
    predict(x, P, 0.02, at_altitude(9000), settings.density, make_design(settings), outside);
    filtering::Matrix<3, 12> H = filtering::Matrix<3, 12>::Zero();
    H.leftCols<3>() = attitude_of(banked);
    H.rightCols<3>().setIdentity();
    EXPECT_LT((P - P.transpose()).cwiseAbs().maxCoeff(), 1e-18);
    EXPECT_NEAR(P(wind_at, wind_at), 0.09 * 0.02, 1e-15);
    return (H * P * H.transpose()).eval();
  };
  EXPECT_LT(added(ProcessNoise::correlated).cwiseAbs().maxCoeff(), 1e-17);
  EXPECT_NEAR(added(ProcessNoise::block_diagonal)(0, 0), 0.09 * 0.02, 1e-15);
}

// Doubles each part of each coefficient, one at a time, in a copy of the airframe data. The change of the
// loads is the contribution of this part; the covariance is the sum of the squares. The drag polar always
// uses the nominal lift, even if a part of the lift is doubled.
TEST(WindModel, CovarianceOfTheLoadsIsTheSumOverTheParts) {
  const Deflection fins{0.05, -0.03, 0.02};
  const Air air = standard_atmosphere(9000);
  const Flow at = flow(banked.segment<3>(air_velocity_at), banked.segment<3>(rate_at), air, airframe_table);
  const Coefficients nominal = coefficients(at, fins, airframe_table);
  const Loads before = loads(at, nominal, air, airframe_table);
  Eigen::Matrix3d force = Eigen::Matrix3d::Zero(), moment = Eigen::Matrix3d::Zero();
  const auto add = [&](double Coefficients::*coefficient, auto enlarge) {
    Airframe more = airframe_table;
    enlarge(more);
    Coefficients c = nominal;
    c.*coefficient = coefficients(at, fins, more).*coefficient;
    const Loads after = loads(at, c, air, airframe_table);
    const Vector3d f = after.specific_force - before.specific_force, M = after.moment - before.moment;
    force += f * f.transpose();
    moment += M * M.transpose();
  };
  const auto longitudinal = [&](double Coefficients::*coefficient, Longitudinal Airframe::*part) {
    add(coefficient, [&](Airframe& a) { (a.*part).constant *= 2, (a.*part).alpha *= 2; });
    add(coefficient, [&](Airframe& a) { (a.*part).pitch_rate *= 2; });
    add(coefficient, [&](Airframe& a) { (a.*part).elevator *= 2; });
  };
  const auto lateral = [&](double Coefficients::*coefficient, Lateral Airframe::*part) {
    add(coefficient, [&](Airframe& a) { (a.*part).sideslip *= 2; });
    add(coefficient, [&](Airframe& a) { (a.*part).roll_rate *= 2, (a.*part).yaw_rate *= 2; });
    add(coefficient, [&](Airframe& a) { (a.*part).aileron *= 2, (a.*part).rudder *= 2; });
  };
  longitudinal(&Coefficients::lift, &Airframe::lift);
  longitudinal(&Coefficients::pitch, &Airframe::pitch);
  lateral(&Coefficients::side, &Airframe::side);
  lateral(&Coefficients::roll, &Airframe::roll);
  lateral(&Coefficients::yaw, &Airframe::yaw);
  add(&Coefficients::drag, [](Airframe& a) {
    a.drag.constant *= 2, a.drag.lift_squared *= 2, a.drag.sideslip_squared *= 2, a.drag.wave *= 2;
  });
  add(&Coefficients::drag, [](Airframe& a) { a.drag.deflection_squared *= 2; });

  const LoadsByPart found = loads_by_part(at, fins, nominal, air, airframe_table);
  const Eigen::Matrix3d of_force = found.specific_force * found.specific_force.transpose();
  const Eigen::Matrix3d of_moment = found.moment * found.moment.transpose();
  EXPECT_LT((of_force - force).norm(), 1e-12 * force.norm());
  EXPECT_LT((of_moment - moment).norm(), 1e-12 * moment.norm());
  const Loads sum = loads(at, nominal, air, airframe_table);
  EXPECT_LT((found.specific_force.rowwise().sum() - sum.specific_force).norm(),
            1e-12 * sum.specific_force.norm());
  EXPECT_LT((found.moment.rowwise().sum() - sum.moment).norm(), 1e-12 * sum.moment.norm());
}

TEST(WindModel, NoiseOfTheCoefficientsIsThatOfTheLoads) {
  Settings settings;
  settings.density = {0, 0, 0, 0, 0.01};
  settings.process_noise = ProcessNoise::aerodynamic;
  StateVector x = banked;
  Covariance P = Covariance::Zero();
  RangeFlags outside;
  const Inputs inputs = at_altitude(9000);
  predict(x, P, 0.02, inputs, settings.density, make_design(settings), outside);
  const Flow at =
      flow(banked.segment<3>(air_velocity_at), banked.segment<3>(rate_at), inputs.air, airframe_table);
  const LoadsByPart loads = loads_by_part(at, inputs.fins, coefficients(at, inputs.fins, airframe_table),
                                          inputs.air, airframe_table);
  const auto turn = (design().inertia_inverse * loads.moment).eval();
  Covariance expected = Covariance::Zero();
  expected.block<3, 3>(air_velocity_at, air_velocity_at) =
      1e-4 * 0.02 * loads.specific_force * loads.specific_force.transpose();
  expected.block<3, 3>(rate_at, rate_at) = 1e-4 * 0.02 * turn * turn.transpose();
  EXPECT_LT((P - expected).norm(), 1e-12 * expected.norm());
}

// The expected covariance is F P F' with F = I + A dt + (A dt)^2/2, by dense products.
TEST(WindModel, CovariancePredictionIsThatOfTheDenseTransition) {
  RangeFlags outside;
  const Jacobian A = linearise(banked, at_altitude(9000), design(), outside).A;
  Covariance root;
  for (int i = 0; i < 144; ++i) root(i) = std::sin(1.7 * i + 0.3 * i * i);
  const Covariance P = root * root.transpose(), Adt = 0.02 * dense(A);
  const Covariance F = Covariance::Identity() + Adt + Adt * Adt / 2;
  const Covariance expected = F * P * F.transpose();
  EXPECT_LT((predicted(P, growth(A, 0.02)) - expected).cwiseAbs().maxCoeff(),
            1e-12 * expected.cwiseAbs().maxCoeff());
}

// The filter has an error in one part of one coefficient; its samples come from the right model without
// noise. The estimation error of the filter must be the sensitivity times the coefficient error. The steps
// are short, because at 20 ms the second order of Phi contributes 6 %.
TEST(WindModel, SensitivityIsWhatAWrongShareDoesToTheFilter) {
  struct Part {
    int column;
    void (*scale)(Airframe&, double);
  };
  const std::array parts{Part{0, [](Airframe& a, double s) { a.lift.constant *= s, a.lift.alpha *= s; }},
                         Part{7, [](Airframe& a, double s) { a.side.aileron *= s, a.side.rudder *= s; }},
                         Part{14, [](Airframe& a, double s) { a.pitch.pitch_rate *= s; }}};
  const Inputs inputs = at_altitude(9000);
  Settings settings;
  settings.process_noise = ProcessNoise::aerodynamic;
  const Design right = make_design(settings);
  for (const Part& part : parts) {
    SCOPED_TRACE(part.column);
    constexpr double share = 1e-3;
    Design wrong = right;
    // Both models omit the induced drag: it depends on the lift, but its error is a separate part.
    part.scale(wrong.airframe, 1 + share);
    wrong.airframe.drag.lift_squared = 0;
    Design truth = right;
    truth.airframe.drag.lift_squared = 0;
    StateVector x = banked, x_true = banked;
    Covariance P = Covariance::Identity() * 0.01, unused = P;
    Sensitivity S = Sensitivity::Zero();
    RangeFlags outside;
    for (int i = 0; i < 200; ++i) {
      predict(x_true, unused, 0.002, inputs, settings.density, truth, outside);
      predict(x, P, 0.002, inputs, settings.density, wrong, outside, &S);
      const GroundVelocity at = ground_velocity(x);
      Observation y;
      y << ground_velocity(x_true).C_v_a + x_true.tail<3>(), x_true.segment<6>(rate_at);
      update(x, P, innovation_of(y, x, at), at, 0.002, wrong, &S);
    }
    const StateVector expected = share * S.col(part.column);
    EXPECT_GT(expected.norm(), 0);
    EXPECT_LT((x - x_true - expected).norm(), 0.03 * expected.norm());
  }
}

}  // namespace
}  // namespace canhil::wind
