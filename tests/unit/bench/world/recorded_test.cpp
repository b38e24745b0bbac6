// A recorded flight passes through the recorded states, and integrating its IMU increments reproduces these
// states.
#include "bench/world/motion/recorded.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "bench/world/flight_record.hpp"
#include "bench/world/units.hpp"
#include "target/estimators/strapdown/mechanization.hpp"

namespace canhil::world {
namespace {

using units::deg;

// Crosses the 180 degree meridian, with a heading that swings through north and south.
const Flight turning{.start = {.latitude = 40 * deg, .longitude = 179.99 * deg, .height = 2000},
                     .motion = Weave{.heading = 170 * deg,
                                     .speed = 60,
                                     .heading_amplitude = 100 * deg,
                                     .turn_period = 50,
                                     .pitch_amplitude = 6 * deg,
                                     .pitch_period = 14}};

std::vector<RecordedState> states_of(const FlightRecord& record, std::int64_t every_us) {
  std::vector<RecordedState> states;
  for (std::int64_t t_us = 0; t_us <= record.end_us(); t_us += every_us) {
    const Truth truth = record.at(t_us);
    states.push_back({.t_us = t_us, .position = truth.position, .v_eb_n = truth.v_eb_n, .C_bn = truth.C_bn});
  }
  return states;
}

Flight flown_again(const std::vector<RecordedState>& states, const Position& start = {}) {
  auto path = std::make_shared<const RecordedPath>(states, start);
  return {.start = path->position(0), .motion = Recorded{.path = std::move(path)}};
}

double angle_between(const Matrix3& a, const Matrix3& b) { return misalignment(a, b).norm(); }

RC_GTEST_PROP(RecordedPath, PassesThroughItsSamplesWithTheRatesOfItsCurve, ()) {
  const auto within = [](double least, double most) {
    return rc::gen::map(rc::gen::inRange(0, 1'000'001),
                        [=](int share) { return least + 1e-6 * share * (most - least); });
  };
  const Weave weave{.heading = *within(-3.1, 3.1),
                    .speed = *within(0, 250),
                    .heading_amplitude = *within(0, 1.5),
                    .turn_period = *within(8, 60),
                    .pitch_amplitude = *within(0, 0.7),
                    .pitch_period = *within(6, 30)};
  const Position start{.latitude = *within(-1.4, 1.4), .longitude = *within(-3.1, 3.1), .height = 1000};
  const std::int64_t every_us = *rc::gen::element(10'000, 20'000, 37'000, 50'000);
  const FlightRecord flown({.start = start, .motion = weave}, 12'000'000, 10'000);
  const auto states = states_of(flown, every_us);
  const Flight again = flown_again(states);
  const FlightRecord record(again, states.back().t_us, 10'000);
  // The velocity of the repeated flight differs from the recorded one, because a cubic spline through
  // velocities has an error of up to 5/384 h^4 v''''. The fastest part of the velocity is a product of two
  // oscillations with periods of 6 s or more. For a speed of 250 m/s sampled every 50 ms, the error is
  // 4e-4 m/s. Therefore the positions agree within this error times the 12 s of the flight.
  const double h = 1e-6 * static_cast<double>(every_us);
  const double w = 2 * std::numbers::pi / 6;
  const double bend = weave.speed * std::pow(2 * w, 4) * 5 / 384 * std::pow(h, 4) + 1e-9;
  for (std::size_t i = 0; i < states.size(); i += 7) {
    const Truth truth = record.at(states[i].t_us);
    RC_ASSERT((truth.v_eb_n - states[i].v_eb_n).norm() < bend);
    RC_ASSERT(angle_between(truth.C_bn, states[i].C_bn) < 1e-14 * 100);
    RC_ASSERT(displacement_n(truth.position, *states[i].position).norm() < 12 * bend + 1e-6);
  }
  // The error of central differences with steps of e is e^2 times a third derivative. The third derivative of
  // a spline jumps by as much as its second derivative changes from one sample to the next.
  constexpr double e = 1e-5;
  for (double t = 0.3; t < 11; t += 0.777) {
    const Movement before = movement(again.motion, t - e), now = movement(again.motion, t),
                   after = movement(again.motion, t + e);
    RC_ASSERT(((after.v_eb_n - before.v_eb_n) / (2 * e) - now.v_eb_n_rate).norm() < 1e-4);
    RC_ASSERT((now.C_bn.transpose() * (after.C_bn - before.C_bn) / (2 * e) - skew(now.omega_nb_b)).norm() <
              1e-5);
  }
}

// Integrates the increments as an INS without errors does. The strapdown navigation used here is that of the
// target, which shares no code with the record.
strapdown::NavState navigated(const FlightRecord& record) {
  const Truth& start = record.epochs().front();
  strapdown::NavState nav{.C_bn = start.C_bn,
                          .v_eb_n = start.v_eb_n,
                          .latitude = start.position.latitude,
                          .longitude = start.position.longitude,
                          .height = start.position.height};
  strapdown::ImuIncrement previous;
  for (const ImuIncrement& increment : record.increments()) {
    const strapdown::ImuIncrement imu{.delta_theta = increment.delta_theta,
                                      .delta_v = increment.delta_v,
                                      .dt = 1e-6 * static_cast<double>(increment.interval_us)};
    nav = strapdown::mechanize_two_sample(nav, previous, imu).nav;
    previous = imu;
  }
  return nav;
}

class RecordedEvery : public testing::TestWithParam<std::int64_t> {};

// The errors after 100 s at 100 Hz. The record has the recorded velocity and attitude, and its increments are
// the integrals of these two. So the remaining error is the error of the mechanisation, as in the analytic
// flight: 1.2e-8 rad, 1.6 mm/s and 82 mm. Interpolation may change this error by a twentieth; the limits are
// three times the error.
TEST_P(RecordedEvery, StrapdownNavigationOfItsIncrementsReturnsToWhatWasRecorded) {
  const FlightRecord flown(turning, 100'000'000, 10'000);
  const auto states = states_of(flown, GetParam());
  const FlightRecord record(flown_again(states), 100'000'000, 10'000);
  const auto errors = [&](const strapdown::NavState& nav) {
    const RecordedState& end = states.back();
    const Position position{.latitude = nav.latitude, .longitude = nav.longitude, .height = nav.height};
    return Vector3(angle_between(nav.C_bn, end.C_bn), (nav.v_eb_n - end.v_eb_n).norm(),
                   displacement_n(*end.position, position).norm());
  };
  const Vector3 analytic = errors(navigated(flown)), recorded = errors(navigated(record));
  EXPECT_LT(recorded.x(), 4e-8) << "[rad]";
  EXPECT_LT(recorded.y(), 5e-3) << "[m/s]";
  EXPECT_LT(recorded.z(), 0.25) << "[m]";
  EXPECT_LT((recorded.cwiseQuotient(analytic) - Vector3::Ones()).cwiseAbs().maxCoeff(), 0.05);
  EXPECT_GT((states.back().v_eb_n - states.front().v_eb_n).norm(), 1) << "the flight is not trivial";
}

INSTANTIATE_TEST_SUITE_P(Rates, RecordedEvery, testing::Values(10'000, 20'000, 40'000));

// The velocities are rounded, so the derivatives of the spline jump at each recorded time. If the quadrature
// never steps across a recorded time, the increments differ from the sums of their parts by rounding errors
// only. These are below 1e-14 rad for increments of 2 mrad, and below 1e-12 m/s for increments of 0.1 m/s.
TEST(RecordedPath, IncrementsOfACoarseGridAreTheSumsOfAFineOne) {
  const FlightRecord flown(turning, 4'000'000, 1'000);
  auto states = states_of(flown, 37'000);
  for (RecordedState& state : states) state.v_eb_n = (state.v_eb_n * 100).array().round() / 100;
  const Flight again = flown_again(states);
  const FlightRecord coarse(again, 3'900'000, 10'000), fine(again, 3'900'000, 1'000);
  for (std::size_t k = 0; k < coarse.increments().size(); ++k) {
    Vector3 theta = Vector3::Zero(), v = Vector3::Zero();
    for (std::size_t j = 10 * k; j < 10 * k + 10; ++j) {
      theta += fine.increments()[j].delta_theta;
      v += fine.increments()[j].delta_v;
    }
    ASSERT_LT((coarse.increments()[k].delta_theta - theta).norm(), 1e-14) << k;
    ASSERT_LT((coarse.increments()[k].delta_v - v).norm(), 1e-12) << k;
  }
}

// A navigation system reports a wrong velocity and correct positions: over a long flight the truth must
// follow the positions.
TEST(RecordedPath, FollowsThePositionsWhereTheVelocityIsBiased) {
  const FlightRecord flown(turning, 120'000'000, 10'000);
  auto states = states_of(flown, 20'000);
  for (RecordedState& state : states) state.v_eb_n += Vector3(0.2, -0.1, 0.05);
  const RecordedPath path(states, {});
  double worst = 0, worst_acceleration = 0;
  for (const RecordedState& state : states) {
    const double t = 1e-6 * static_cast<double>(state.t_us);
    worst = std::max(worst, displacement_n(*state.position, path.position(t)).norm());
    const Movement exact = movement(turning.motion, t);
    if (t > 1 && t < 119)
      worst_acceleration =
          std::max(worst_acceleration, (path.movement(t).v_eb_n_rate - exact.v_eb_n_rate).norm());
  }
  EXPECT_LT(worst, 0.1) << "without the correction it would be 27 m";
  EXPECT_NEAR(path.contradiction().velocity, Vector3(0.2, -0.1, 0.05).norm(), 0.01) << "and it is reported";
  EXPECT_LT(worst_acceleration, 1e-3) << "[m/s^2], 100 ug";
}

// The positions are rounded to a centimetre, like values in 1e-7 degrees. A curve through these positions
// would have accelerations of 25 m/s^2.
TEST(RecordedPath, RoundingOfPositionsIsNoAcceleration) {
  const FlightRecord flown(turning, 60'000'000, 10'000);
  auto states = states_of(flown, 20'000);
  constexpr double step = 1e-7 * deg;
  for (RecordedState& state : states) {
    state.position->latitude = std::round(state.position->latitude / step) * step;
    state.position->longitude = std::round(state.position->longitude / step) * step;
  }
  const RecordedPath path(states, {});
  for (double t = 1; t < 59; t += 0.013) {
    ASSERT_LT((path.movement(t).v_eb_n_rate - movement(turning.motion, t).v_eb_n_rate).norm(), 1e-3) << t;
  }
  EXPECT_LT(path.contradiction().position, 0.02);
}

TEST(RecordedPath, WithoutPositionsItStartsWhereConfigured) {
  const FlightRecord flown(turning, 20'000'000, 10'000);
  auto states = states_of(flown, 20'000);
  for (RecordedState& state : states) state.position.reset();
  const FlightRecord record(flown_again(states, turning.start), 20'000'000, 10'000);
  EXPECT_LT(displacement_n(record.at(20'000'000).position, flown.at(20'000'000).position).norm(), 1e-3);
}

}  // namespace
}  // namespace canhil::world
