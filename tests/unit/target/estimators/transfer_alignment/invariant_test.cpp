// The feedback of an invariant error: its algebra compared with dense references, and its benefit.
#include "target/estimators/transfer_alignment/invariant.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "target/estimators/strapdown/attitude.hpp"
#include "target/estimators/transfer_alignment/filter.hpp"
#include "tests/unit/target/estimators/flight.hpp"
#include "tests/unit/target/estimators/random_matrix.hpp"

namespace canhil::transfer_alignment {
namespace {

using Eigen::Vector3d;

// J(phi) is the mean of exp([s phi x]) over s from 0 to 1, computed with Simpson's rule.
Dense left_jacobian(const Vector3d& phi) {
  constexpr int steps = 100;
  Dense sum(3, 3);
  for (int k = 0; k <= steps; ++k) {
    const double weight = k == 0 || k == steps ? 1 : k % 2 == 0 ? 2 : 4;
    sum = sum + weight / (3 * steps) * Dense(strapdown::exp_rotation(k * phi / steps));
  }
  return sum;
}

TEST(InvariantCorrection, IsOneIterationOfAConstantGain) {
  std::mt19937_64 engine(11);
  for (const double size : {1e-3, 0.02, 1.0}) {
    const auto K = (size * random_dense(state_count, 3, engine)).fixed<state_count, 3>();
    const Vector3d y(0.4, -0.5, 0.3);
    const Dense first = Dense(K) * y;
    const Vector3d phi = first.block(attitude_state, 0, 3, 1).fixed<3, 1>();
    const Dense zeta = first.block(velocity_state, 0, 3, 1);
    const Dense left = Dense(strapdown::exp_rotation(-phi)) * (Dense(y) - left_jacobian(phi) * zeta);
    const Dense second = Dense(K) * (left + zeta);
    const StateVector x = invariant_correction(K, y);
    EXPECT_LT(largest_difference(Dense(x).block(3, 0, 9, 1), second.block(3, 0, 9, 1)), 1e-9) << size;
    const Dense velocity = left_jacobian(second.block(attitude_state, 0, 3, 1).fixed<3, 1>()) *
                           second.block(velocity_state, 0, 3, 1);
    EXPECT_LT(largest_difference(Dense(x).block(velocity_state, 0, 3, 1), velocity), 1e-9) << size;
  }
}

TEST(InvariantCorrection, TurnsTheCovarianceOfVelocityAndAttitude) {
  std::mt19937_64 engine(12);
  const Covariance before = random_covariance<state_count>(engine);
  const Vector3d phi(0.2, -0.1, 0.6);
  const Dense turn = strapdown::exp_rotation(phi);
  const Dense T = identity(state_count).set(0, 0, turn).set(3, 3, turn);
  Covariance P = before;
  turn_with_correction(P, phi);
  EXPECT_LT(largest_difference(P, T * before * transposed(T)), 1e-13);
  EXPECT_EQ(Dense(P), transposed(P));
}

struct Flown {
  State cruised, ended;
  int degraded = 0;             // number of updates
  double attitude_trace = 0;    // maximum trace of the attitude block of P in the cruise
  double worst_of_heading = 0;  // error over sigma, after the first second of the manoeuvre
};

// The paper's flight with an error-free IMU and master, starting with the attitude error phi [rad].
Flown fly(const Settings& settings, const Vector3d& phi) {
  Flown flown;
  State state = initial(with_errors(flight_start(), Vector3d::Zero(), phi), settings);
  strapdown::NavState truth = flight_start();
  for (int k = 0; k < 2000; ++k) {
    const double dt = 0.01, t = k * dt;
    propagate(state, flight_increment(truth, t, dt), settings);
    truth = flight_next(truth, t, dt);
    if (k % 10 != 9) continue;
    const UpdateResult result = update(state, truth.v_eb_n, settings);
    EXPECT_EQ(result.outcome, Outcome::ok);
    if (result.degraded) ++flown.degraded;
    if (k < 1000) {
      flown.attitude_trace =
          std::max(flown.attitude_trace, state.P.diagonal().segment<3>(attitude_state).sum());
    } else if (k >= 1100) {
      const double error = strapdown::misalignment(state.ins.nav.C_bn, truth.C_bn).z();
      flown.worst_of_heading = std::max(flown.worst_of_heading, std::abs(error) / std::sqrt(state.P(5, 5)));
    }
    if (k == 999) flown.cruised = state;
  }
  flown.ended = state;
  return flown;
}

Settings configured(Algorithm algorithm, Loop loop, double tilt_deg, double heading_deg) {
  Settings settings;
  settings.algorithm = algorithm;
  settings.loop = loop;
  settings.velocity_noise_density = 0.00025;
  settings.attitude_sigma_0 = Vector3d(tilt_deg, tilt_deg, heading_deg) * rad_per_deg;
  return settings;
}

// The cruise makes the tilts observable, but not the heading: a correction of the tilts must not change the
// heading's sigma. If P keeps the axes from before the correction, or if the tilts' sigmas are as small as
// their errors, the heading's sigma falls by a quarter or more.
TEST(InvariantLoop, LeavesTheHeadingSigmaAloneInTheCruise) {
  const Vector3d phi = Vector3d(6, -6, 25) * rad_per_deg;
  const double sigma_0 = 30 * rad_per_deg;
  const Flown invariant = fly(configured(Algorithm::kalman, Loop::invariant, 5, 30), phi);
  const Flown published = fly(configured(Algorithm::kalman, Loop::published, 5, 30), phi);
  EXPECT_GT(std::sqrt(invariant.cruised.P(5, 5)) / sigma_0, 0.9);
  EXPECT_LT(std::sqrt(published.cruised.P(5, 5)) / sigma_0, 0.75);
}

// The initial heading error is large, far beyond first order. It becomes observable within one or two updates
// when the manoeuvre begins.
TEST(InvariantLoop, FindsALargeHeadingWithinItsSigma) {
  for (const double heading_deg : {-60.0, -25.0, 40.0}) {
    const Vector3d phi = Vector3d(1, -1, heading_deg) * rad_per_deg;
    EXPECT_LT(fly(configured(Algorithm::kalman, Loop::invariant, 1, 30), phi).worst_of_heading, 2)
        << heading_deg;
  }
  const Vector3d phi = Vector3d(1, -1, 40) * rad_per_deg;
  EXPECT_GT(fly(configured(Algorithm::kalman, Loop::published, 1, 30), phi).worst_of_heading, 2);
}

// With the gate, a single wrong velocity must not change the INS; after five wrong velocities in a row, the
// sixth must change the INS.
TEST(InvariantLoop, RefusesAVelocityBeyondTheGateUntilTooManyAre) {
  for (const Loop loop : {Loop::invariant, Loop::published}) {
    const Settings settings = configured(Algorithm::kalman, loop, 1, 5);
    State state = initial(flight_start(), settings);
    strapdown::NavState truth = flight_start();
    int gated = 0;
    for (int k = 0; k < 20; ++k) {
      propagate(state, flight_increment(truth, 0.1 * k, 0.1), settings);
      truth = flight_next(truth, 0.1 * k, 0.1);
      const bool wrong = k == 10 || k >= 13;
      const State before = state;
      const UpdateResult result =
          update(state, truth.v_eb_n + (wrong ? Vector3d(0, 0, 100) : Vector3d::Zero()), settings);
      if (result.outcome != Outcome::gated) continue;
      ++gated;
      EXPECT_GT(result.nis, settings.gate_nis) << k;
      EXPECT_EQ(state.P, before.P) << k;
      EXPECT_EQ(state.ins.nav.v_eb_n, before.ins.nav.v_eb_n) << k;
    }
    // The gate rejects the wrong update of k = 10. From k = 13 on, it rejects every wrong update except the
    // sixth: the sixth is accepted, so the INS takes over the master's wrong velocity.
    EXPECT_EQ(gated, loop == Loop::invariant ? 7 : 0);
    // The invariant loop gives it the weight of one velocity, the published filter that of the whole wait.
    EXPECT_GT(state.ins.nav.v_eb_n.z() - truth.v_eb_n.z(), loop == Loop::invariant ? 5 : 30);
  }
}

// H2 with an initial heading sigma of 15 deg: without the guard, the attitude covariance diverges in the
// cruise. With the guard, the covariance stays below its initial value, and the filter reports `degraded`.
TEST(InvariantLoop, GuardsH2AgainstItsOwnCovariance) {
  const Vector3d phi = Vector3d(5, -5, 15) * rad_per_deg;
  const Settings settings = configured(Algorithm::robust_h2, Loop::invariant, 5, 15);
  const double start = initial_variance(settings).segment<3>(attitude_state).sum();
  const Flown guarded = fly(settings, phi);
  EXPECT_GT(guarded.degraded, 10);
  EXPECT_LT(guarded.degraded, 190);
  EXPECT_LT(guarded.attitude_trace, 1.001 * start);
  EXPECT_LT(guarded.worst_of_heading, 3);
  const Flown published = fly(configured(Algorithm::robust_h2, Loop::published, 5, 15), phi);
  EXPECT_EQ(published.degraded, 0);
  EXPECT_GT(published.attitude_trace, 4 * start);
}

}  // namespace
}  // namespace canhil::transfer_alignment
