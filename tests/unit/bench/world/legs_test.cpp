#include "bench/world/motion/leg_path.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/world/flight_record.hpp"
#include "bench/world/units.hpp"

namespace canhil::world {
namespace {

using units::deg;

constexpr double g = units::standard_gravity;

/// Every change at once: the speed changes during the turn, and climb and drift change too.
std::vector<Leg> busy(Vehicle vehicle) {
  const bool rotorcraft = vehicle == Vehicle::rotorcraft;
  const double climb = vehicle == Vehicle::ship ? 0 : rotorcraft ? 1 : 0.1;
  const double drift = rotorcraft ? 60 * deg : 0;
  return {{.duration_us = 3'000'000},
          {.duration_us = 9'000'000,
           .speed = 20,
           .climb = climb,
           .drift = drift,
           .turn = 70 * deg,
           .speed_us = 5'000'000,
           .transition_us = 2'000'000,
           .turn_us = 8'000'000},
          {.duration_us = 5'000'000,
           .speed = 12,
           .climb = -climb,
           .drift = 0,
           .turn = 0,
           .speed_us = 5'000'000,
           .transition_us = 1'500'000,
           .turn_us = 0},
          {.duration_us = 4'000'000,
           .speed = 12,
           .climb = 0,
           .drift = drift,
           .turn = -drift,
           .speed_us = 0,
           .transition_us = 2'000'000,
           .turn_us = 4'000'000},
          {.duration_us = 6'000'000,
           .speed = 0,
           .climb = 0,
           .drift = drift,
           .turn = -100 * deg,
           .speed_us = 6'000'000,
           .transition_us = 2'000'000,
           .turn_us = 3'000'000},
          {.duration_us = 4'000'000, .speed = 0, .climb = 0, .drift = drift}};
}

LegPath path_of(Vehicle vehicle) {
  const auto legs = busy(vehicle);
  return {{.vehicle = vehicle, .angle_of_attack = 0.05, .roll_by_acceleration = 0.02}, 0, 0.3, legs};
}

class EachVehicle : public testing::TestWithParam<Vehicle> {};

/// Velocity and attitude, and their first derivatives, as the motion says.
using Six = Eigen::Matrix<double, 6, 1>;
Six values(const Kinematics& now) {
  Six all;
  all << now.v_eb_n, now.angles.roll, now.angles.pitch, now.angles.heading;
  return all;
}
Six rates(const Kinematics& now) {
  Six all;
  all << now.v_eb_n_rate, now.rates.roll, now.rates.pitch, now.rates.heading;
  return all;
}

TEST_P(EachVehicle, HasTheDerivativesOfItsVelocityAndAttitude) {
  const LegPath path = path_of(GetParam());
  const double h = 1e-4;
  double greatest = 0;
  for (double t = 2.03; t < 32; t += 0.0917) {
    const Six difference = (8 * (values(path.kinematics(t + h)) - values(path.kinematics(t - h))) -
                            (values(path.kinematics(t + 2 * h)) - values(path.kinematics(t - 2 * h)))) /
                           (12 * h);
    EXPECT_LT((difference - rates(path.kinematics(t))).norm(), 1e-8) << t;
    greatest = std::max(greatest, difference.norm());
  }
  EXPECT_GT(greatest, 5.0) << "the motion is real";
}

// The second derivatives on both sides of each time at which a blend begins or ends, and between: their
// difference must vanish with the step, so the third derivative is finite there.
TEST_P(EachVehicle, IsSmoothToTheSecondDerivative) {
  const LegPath path = path_of(GetParam());
  ASSERT_GT(path.jumps_us().size(), 12U);
  const auto jump = [&](double t, double h) {
    const Six middle = rates(path.kinematics(t));
    const Six after = (rates(path.kinematics(t + h)) - middle) / h;
    const Six before = (middle - rates(path.kinematics(t - h))) / h;
    return (after - before).norm();
  };
  for (const std::int64_t t_us : path.jumps_us()) {
    const double t = 1e-6 * static_cast<double>(t_us);
    if (t_us == 0) continue;
    EXPECT_LT(jump(t, 1e-3), 0.5) << t;
    EXPECT_LT(jump(t, 1e-5), 5e-3) << t;
    EXPECT_LT((values(path.kinematics(t + 1e-9)) - values(path.kinematics(t - 1e-9))).norm(), 1e-7) << t;
  }
}

TEST_P(EachVehicle, IsExactlyAtRestBeforeAndAfter) {
  const LegPath path = path_of(GetParam());
  for (const double t : {0.0, 1.7, 3.0, 27.0, 29.0, 31.0, 500.0}) {
    EXPECT_EQ(path.kinematics(t).v_eb_n, Vector3::Zero()) << t;
    EXPECT_EQ(rates(path.kinematics(t)), Six::Zero()) << t;
  }
}

TEST_P(EachVehicle, TurnsByTheAnglesOfItsLegs) {
  const LegPath path = path_of(GetParam());
  const double drift = GetParam() == Vehicle::rotorcraft ? 60 * deg : 0;
  EXPECT_NEAR(path.kinematics(12).angles.heading, 0.3 + 70 * deg, 1e-12);
  EXPECT_NEAR(path.kinematics(21).angles.heading, 0.3 + 70 * deg - drift, 1e-12);
  EXPECT_NEAR(path.kinematics(100).angles.heading, 0.3 - 30 * deg - drift, 1e-12);
  EXPECT_NEAR(path.kinematics(14.5).v_eb_n.norm(), 16, 0.5) << "half way from 20 to 12 m/s";
}

// The tests of flight_record_test.cpp for the other motions, over these: the increments, flown by an
// independent navigator, lead back to the truth; and a coarse grid has the sums of a fine one to rounding.
TEST_P(EachVehicle, IncrementsOfACoarseGridAreTheSumsOfAFineOne) {
  const Flight flight{.start = {.latitude = 0.6, .longitude = 2, .height = 100},
                      .motion = Legs{std::make_shared<const LegPath>(path_of(GetParam()))}};
  const FlightRecord coarse(flight, 28'000'000, 10'000);
  const FlightRecord fine(flight, 28'000'000, 1'000);
  for (std::size_t k = 0; k < coarse.increments().size(); ++k) {
    Vector3 theta = Vector3::Zero();
    Vector3 v = Vector3::Zero();
    for (std::size_t j = 10 * k; j < 10 * k + 10; ++j) {
      theta += fine.increments()[j].delta_theta;
      v += fine.increments()[j].delta_v;
    }
    // The increments of a sample are up to 5 mrad and 0.15 m/s; the limits are rounding errors of these.
    EXPECT_LT((coarse.increments()[k].delta_theta - theta).norm(), 5e-16) << k;
    EXPECT_LT((coarse.increments()[k].delta_v - v).norm(), 1e-14) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(All, EachVehicle,
                         testing::Values(Vehicle::car, Vehicle::ship, Vehicle::auv, Vehicle::aircraft,
                                         Vehicle::rotorcraft));

// The blends begin and end inside the samples. A rule that steps across an end errs by
// up to 8e-3 m/s here, and one that takes a whole blend in one step by 5e-8 m/s.
TEST(Legs, ABlendThatEndsInsideASampleIsNotSmeared) {
  const std::vector<Leg> legs{{.duration_us = 33'700},
                              {.duration_us = 171'300,
                               .speed = 3,
                               .turn = 0.1,
                               .speed_us = 61'100,
                               .transition_us = 40'300,
                               .turn_us = 130'700}};
  const Flight flight{.start = {.latitude = 0.6, .longitude = 2, .height = 100},
                      .motion = Legs{std::make_shared<const LegPath>(Carrier{}, 0, 0.3, legs)}};
  const FlightRecord coarse(flight, 250'000, 50'000);
  const FlightRecord fine(flight, 250'000, 100);
  for (std::size_t k = 0; k < coarse.increments().size(); ++k) {
    Vector3 theta = Vector3::Zero();
    Vector3 v = Vector3::Zero();
    for (std::size_t j = 500 * k; j < 500 * k + 500; ++j) {
      theta += fine.increments()[j].delta_theta;
      v += fine.increments()[j].delta_v;
    }
    EXPECT_LT((coarse.increments()[k].delta_theta - theta).norm(), 1e-14) << k;
    EXPECT_LT((coarse.increments()[k].delta_v - v).norm(), 1e-12) << k;
  }
}

TEST(Legs, AnAircraftTurnsCoordinated) {
  const LegPath path = path_of(Vehicle::aircraft);
  for (double t = 3; t < 26; t += 0.31) {
    const Kinematics now = path.kinematics(t);
    const double turn_rate = now.rates.heading, over_ground = std::hypot(now.v_eb_n.x(), now.v_eb_n.y());
    EXPECT_NEAR(std::tan(now.angles.roll), over_ground * turn_rate / g, 1e-12) << t;
    if (over_ground < 1) continue;
    EXPECT_NEAR(now.angles.pitch - 0.05, std::atan2(-now.v_eb_n.z(), over_ground), 1e-12) << t;
  }
}

TEST(Legs, ACarLeansOutOfATurn) {
  const LegPath path = path_of(Vehicle::car);
  const Kinematics now = path.kinematics(7);
  const double lateral = std::hypot(now.v_eb_n.x(), now.v_eb_n.y()) * now.rates.heading;
  EXPECT_GT(lateral, 1.0);
  EXPECT_NEAR(now.angles.roll, -0.02 * lateral, 1e-12);
}

// In hover and flight, the accelerometers of a rotorcraft see thrust only along -z.
TEST(Legs, ARotorcraftTiltsItsThrust) {
  const LegPath path = path_of(Vehicle::rotorcraft);
  double greatest = 0;
  for (double t = 0; t < 31; t += 0.17) {
    const Kinematics now = path.kinematics(t);
    const Vector3 thrust = C_bn_from(now.angles).transpose() * (now.v_eb_n_rate - Vector3(0, 0, g));
    EXPECT_LT(thrust.head<2>().norm(), 1e-12) << t;
    EXPECT_LT(thrust.z(), 0) << t;
    greatest = std::max(greatest, std::hypot(now.angles.roll, now.angles.pitch));
  }
  EXPECT_GT(greatest, 20 * deg);
}

TEST(Legs, ARotorcraftTurnsItsNoseOnAStraightCourse) {
  const LegPath path = path_of(Vehicle::rotorcraft);
  const Vector3 before = path.kinematics(17).v_eb_n;
  for (double t = 17; t < 21; t += 0.1)
    EXPECT_LT((path.kinematics(t).v_eb_n.head<2>() - before.head<2>()).norm(), 1e-12) << t;
  EXPECT_NEAR(before.head<2>().norm(), 12, 1e-12);
}

}  // namespace
}  // namespace canhil::world
