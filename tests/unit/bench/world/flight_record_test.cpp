#include "bench/world/flight_record.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/NormalGravity.hpp>
#include <cmath>
#include <vector>

#include "bench/world/motion/leg_path.hpp"
#include "bench/world/units.hpp"

namespace canhil::world {
namespace {

using units::deg;

constexpr double earth_rate = 7.292115e-5;  // [rad/s], WGS-84
const Position seoul{.latitude = 37 * deg, .longitude = 127 * deg, .height = 1000};

const Flight paper{.start = seoul,
                   .motion = LevelAcceleration{.heading = 0,
                                               .speed = 500 * units::kmph,
                                               .cruise_us = 10'000'000,
                                               .acceleration = units::standard_gravity}};
const Flight weaving{.start = {.latitude = -50 * deg, .longitude = -179.999 * deg, .height = 8000},
                     .motion = Weave{.heading = 2.0,
                                     .speed = 200,
                                     .heading_amplitude = 15 * deg,
                                     .turn_period = 11,
                                     .pitch_amplitude = 5 * deg,
                                     .pitch_period = 8}};
Flight coning() {
  Flight flight = weaving;
  auto& weave = std::get<Weave>(flight.motion);
  weave.coning_amplitude = 0.2 * deg;
  weave.coning_period = 0.1;
  return flight;
}

/// Legs with every kind of change.
Flight legs(Vehicle vehicle) {
  const double climb = vehicle == Vehicle::rotorcraft ? 2.0 : 0.1;
  const std::vector<Leg> legs{{.duration_us = 9'000'000,
                               .speed = 45,
                               .climb = climb,
                               .turn = 1.5,
                               .speed_us = 7'000'000,
                               .transition_us = 2'000'000,
                               .turn_us = 9'000'000},
                              {.duration_us = 6'000'000,
                               .speed = 30,
                               .climb = 0,
                               .drift = 0.5,
                               .turn = -0.5,
                               .speed_us = 5'000'000,
                               .transition_us = 3'000'000,
                               .turn_us = 6'000'000}};
  return {.start = seoul,
          .motion = Legs{std::make_shared<const LegPath>(
              Carrier{.vehicle = vehicle, .roll_by_acceleration = 0.01}, 0, 2, legs)}};
}

TEST(FlightRecord, AtRestTheAccelerometersFeelMinusGravityAndTheGyrosTheEarth) {
  const Euler angles{0.1, -0.2, 2.0};
  const FlightRecord record({.start = seoul, .motion = Rest{angles}}, 1'000'000, 10'000);
  const Matrix3 C_nb = C_bn_from(angles).transpose();
  // WGS-84 closed form (Somigliana) with the free-air term to second order: accurate to 1e-6 m/s^2 at 1000 m.
  const double s2 = std::pow(std::sin(seoul.latitude), 2);
  const double surface = 9.7803253359 * (1 + 0.00193185265241 * s2) / std::sqrt(1 - 6.69437999014e-3 * s2);
  const double f = 1 / 298.257223563;
  const double m = 0.00344978650684;
  const double x = seoul.height / 6378137.0;
  const double gravity = surface * (1 - 2 * (1 + f + m - 2 * f * s2) * x + 3 * x * x);
  const Vector3 omega_ie(earth_rate * std::cos(seoul.latitude), 0, -earth_rate * std::sin(seoul.latitude));
  for (const Truth& truth : record.epochs()) {
    // Normal gravity at height leans north by about 8e-6 m/s^2 per kilometre; the other tests check this
    // part.
    EXPECT_NEAR((truth.C_bn * truth.f_ib_b).z(), -gravity, 1e-6);
    EXPECT_LT((truth.C_bn * truth.f_ib_b).head<2>().norm(), 1e-5);
    EXPECT_LT((truth.omega_ib_b - C_nb * omega_ie).norm(), 1e-18);
    EXPECT_EQ(truth.v_eb_n, Vector3::Zero());
    EXPECT_EQ(truth.position.latitude, seoul.latitude);
  }
  for (const ImuIncrement& increment : record.increments()) {
    EXPECT_LT((increment.delta_v - record.epochs()[0].f_ib_b * 0.01).norm(), 1e-16);
    EXPECT_LT((increment.delta_theta - C_nb * omega_ie * 0.01).norm(), 1e-20);
  }
}

TEST(FlightRecord, GridAndIncrementsBelongTogether) {
  const FlightRecord record(paper, 125'000, 10'000);
  ASSERT_EQ(record.epochs().size(), 13U);
  ASSERT_EQ(record.increments().size(), 12U);
  EXPECT_EQ(record.end_us(), 120'000);
  for (std::size_t k = 0; k < 12; ++k) {
    EXPECT_EQ(record.epochs()[k].t_us, static_cast<std::int64_t>(k) * 10'000);
    EXPECT_EQ(record.increments()[k].t_us, record.epochs()[k + 1].t_us);
    EXPECT_EQ(record.increments()[k].interval_us, 10'000);
  }
}

// An independent navigator: Earth-centred inertial axes, attitude by two-sample coning, velocity by
// two-sample sculling (Savage), gravitation by GeographicLib in geocentric coordinates. This navigator shares
// no equation with the NED form of the record.
struct Inertial {
  Vector3 r;  // inertial axes coincide with ECEF at t = 0
  Vector3 v;
  Matrix3 C_bi;
};

const GeographicLib::Geocentric& geocentric() { return GeographicLib::Geocentric::WGS84(); }

struct EcefPose {
  Vector3 r;
  Matrix3 C_ne;
};
EcefPose ecef(const Position& position) {
  EcefPose pose;
  std::vector<double> enu(9);
  geocentric().Forward(position.latitude / deg, position.longitude / deg, position.height, pose.r.x(),
                       pose.r.y(), pose.r.z(), enu);
  const Matrix3 C_enu = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(enu.data());
  pose.C_ne.col(0) = C_enu.col(1);
  pose.C_ne.col(1) = C_enu.col(0);
  pose.C_ne.col(2) = -C_enu.col(2);
  return pose;
}

Matrix3 earth_turn(double t) {
  return Eigen::AngleAxisd(earth_rate * t, Vector3::UnitZ()).toRotationMatrix();
}

Inertial inertial(const Truth& truth) {
  const double t = 1e-6 * static_cast<double>(truth.t_us);
  const EcefPose pose = ecef(truth.position);
  const Matrix3 C_ei = earth_turn(t);
  return {.r = C_ei * pose.r,
          .v = C_ei * (pose.C_ne * truth.v_eb_n + Vector3(0, 0, earth_rate).cross(pose.r)),
          .C_bi = C_ei * pose.C_ne * truth.C_bn};
}

Vector3 gravitation(const Vector3& r_i, double t) {
  const Vector3 r_e = earth_turn(t).transpose() * r_i;
  Vector3 g;
  GeographicLib::NormalGravity::WGS84().V0(r_e.x(), r_e.y(), r_e.z(), g.x(), g.y(), g.z());
  return earth_turn(t) * g;
}

Inertial navigate(const FlightRecord& record) {
  Inertial state = inertial(record.epochs().front());
  const double h = 1e-6 * static_cast<double>(record.interval_us());
  Vector3 theta_before = record.increments().front().delta_theta;
  Vector3 v_before = record.increments().front().delta_v;
  for (const ImuIncrement& increment : record.increments()) {
    const double t_middle = 1e-6 * static_cast<double>(increment.t_us) - 0.5 * h;
    const Vector3& theta = increment.delta_theta;
    const Vector3& dv = increment.delta_v;
    const Vector3 rotated = dv + 0.5 * theta.cross(dv) + theta.cross(theta.cross(dv)) / 6.0;
    const Vector3 sculled = rotated + (theta_before.cross(dv) + v_before.cross(theta)) / 12.0;
    const Vector3 dv_i = state.C_bi * sculled + h * gravitation(state.r + 0.5 * h * state.v, t_middle);
    state.r += h * (state.v + 0.5 * dv_i);
    state.v += dv_i;
    state.C_bi *= rotation(theta + theta_before.cross(theta) / 12.0);
    theta_before = theta;
    v_before = dv;
  }
  return state;
}

// At 1 kHz the errors of the two-sample algorithms are below the limits: these errors are of the order
// (rate * h)^4, with rates of 1 rad/s. The trapezoid rule for the position has an error of h^2/12 times the
// change of acceleration; this is 1e-6 m.
class IndependentNavigator : public testing::TestWithParam<Flight> {};

TEST_P(IndependentNavigator, FliesTheIncrementsBackToTheTruth) {
  const FlightRecord record(GetParam(), 20'000'000, 1'000);
  const Inertial end = navigate(record);
  const Inertial truth = inertial(record.epochs().back());
  EXPECT_LT((end.v - truth.v).norm(), 1e-6);
  EXPECT_LT(misalignment(end.C_bi, truth.C_bi).norm(), 1e-9);
  EXPECT_LT((end.r - truth.r).norm(), 1e-5);
  EXPECT_GT((truth.v - inertial(record.epochs().front()).v).norm(), 10.0) << "the flight is not trivial";
}

INSTANTIATE_TEST_SUITE_P(Flights, IndependentNavigator,
                         testing::Values(paper, weaving, legs(Vehicle::car), legs(Vehicle::aircraft),
                                         legs(Vehicle::rotorcraft)));

TEST(FlightRecord, IncrementsOfACoarseGridAreTheSumsOfAFineOne) {
  // Coning at 10 Hz: 10 ms is 0.63 rad, for which the quadrature with five Gauss nodes has an error of 4e-13
  // * 0.63^10 = 4e-15 of the amplitude.
  const FlightRecord coarse(coning(), 2'000'000, 10'000);
  const FlightRecord fine(coning(), 2'000'000, 1'000);
  for (std::size_t k = 0; k < coarse.increments().size(); ++k) {
    Vector3 theta = Vector3::Zero();
    Vector3 v = Vector3::Zero();
    for (std::size_t j = 10 * k; j < 10 * k + 10; ++j) {
      theta += fine.increments()[j].delta_theta;
      v += fine.increments()[j].delta_v;
    }
    // The increments of a sample are about 2 mrad and 0.1 m/s. Each limit is 1e-13 times the size of its
    // increment.
    EXPECT_LT((coarse.increments()[k].delta_theta - theta).norm(), 2e-3 * 1e-13);
    EXPECT_LT((coarse.increments()[k].delta_v - v).norm(), 0.1 * 1e-13);
  }
}

TEST(FlightRecord, AJumpInsideASampleIsNotSmeared) {
  Flight flight = paper;
  std::get<LevelAcceleration>(flight.motion).cruise_us = 10'003'700;
  const FlightRecord coarse(flight, 10'020'000, 10'000);
  const FlightRecord fine(flight, 10'020'000, 100);
  Vector3 v = Vector3::Zero();
  for (std::size_t j = 100'000; j < 100'100; ++j) v += fine.increments()[j].delta_v;
  EXPECT_LT((coarse.increments()[1000].delta_v - v).norm(), 1e-14);
  EXPECT_NEAR(v.x(), units::standard_gravity * 6.3e-3,
              1e-4);  // the Coriolis term and the north component of gravity are smaller
  // Position change between epochs, across the jump. A Runge-Kutta step across the jump has an error of 1e-12
  // rad; rounding in the 540 steps of the fine record adds 1e-16 rad per step.
  const auto moved = [](const FlightRecord& record) {
    return record.at(10'009'000).position.latitude - record.at(10'000'000).position.latitude;
  };
  EXPECT_NEAR(moved(coarse), moved(fine), 1e-13);
}

TEST(FlightRecord, LookUpAgreesWithAFinerRecordBetweenEpochs) {
  const FlightRecord coarse(coning(), 2'000'000, 10'000);
  const FlightRecord fine(coning(), 2'000'000, 100);
  for (const std::int64_t t_us : {0, 100, 10'000, 123'400, 1'999'900, 2'000'000}) {
    const Truth a = coarse.at(t_us);
    const Truth& b = fine.epochs()[static_cast<std::size_t>(t_us / 100)];
    EXPECT_EQ(a.t_us, t_us);
    EXPECT_EQ(a.v_eb_n, b.v_eb_n);
    EXPECT_EQ(a.C_bn, b.C_bn);
    // Rounding: an ulp of the longitude is 2 nm; over the 1.2e5 steps of the fine record this is 0.7 um if
    // the rounding errors are independent.
    EXPECT_LT(displacement_n(a.position, b.position).norm(), 1e-6);
    EXPECT_LT((a.f_ib_b - b.f_ib_b).norm(), 1e-12);
    EXPECT_LT((a.omega_ib_b - b.omega_ib_b).norm(), 1e-15);
  }
}

TEST(FlightRecord, ThePapersFlightIsAsThePaperSays) {
  const FlightRecord record(paper, 20'000'000, 10'000);
  const Truth end = record.at(20'000'000);
  EXPECT_NEAR(end.v_eb_n.x(), 500 / 3.6 + 98.0665, 1e-9);
  EXPECT_EQ(end.position.height, seoul.height);
  EXPECT_EQ(end.position.longitude, seoul.longitude);
  // 20 s at the initial speed give 2777.78 m to the north, and 1 g during the last 10 s adds 490.33 m.
  // displacement_n() uses the radius at the start, which causes an error of 8 mm.
  const double north = 20 * 500 / 3.6 + 0.5 * 9.80665 * 100;
  EXPECT_NEAR(displacement_n(seoul, end.position).x(), north, 0.02);
  EXPECT_NEAR(record.at(15'000'000).f_ib_b.x(), units::standard_gravity, 1e-3);
}

}  // namespace
}  // namespace canhil::world
