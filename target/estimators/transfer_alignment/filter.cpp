#include "target/estimators/transfer_alignment/filter.hpp"

#include <algorithm>
#include <cmath>

#include "target/estimators/filtering/kalman.hpp"
#include "target/estimators/strapdown/attitude.hpp"
#include "target/estimators/transfer_alignment/invariant.hpp"
#include "target/estimators/transfer_alignment/uncertainty.hpp"

namespace canhil::transfer_alignment {
namespace {

constexpr double longest_prediction = 0.25;  // [s]
constexpr double longest_period = 1.05;      // of the master, 1 s and jitter: a longer wait is an outage [s]

struct Prediction {
  Covariance P;
  Sensitivity S;
  StateVector x;
  double alpha = 0, beta = 0;
  bool degraded = false;
};

// True if the attitude covariance (its trace) exceeds P0. Without a manoeuvre the attitude error keeps its
// initial size, except for gyro drift. So an H2 covariance larger than P0 is not a useful bound, and the H2
// terms would grow with this covariance.
bool beyond_the_start(const Covariance& P, const Settings& settings) {
  return !(P.diagonal().segment<3>(attitude_state).sum() <=
           initial_variance(settings).segment<3>(attitude_state).sum());
}

// Lost samples of the IMU were bridged by estimates.
void add_bridging_noise(Covariance& P, const Interval& interval) {
  const Eigen::Matrix3d velocity = root_in_n(interval, interval.delta_v_variance);
  const Eigen::Matrix3d attitude = root_in_n(interval, interval.delta_theta_variance);
  P.block<3, 3>(velocity_state, velocity_state) += velocity.lazyProduct(velocity.transpose());
  P.block<3, 3>(attitude_state, attitude_state) += attitude.lazyProduct(attitude.transpose());
}

// The master's period after a wait for a velocity. The settings state the noise as a density, which belongs
// to this period. A wait that is longer than the period counts once it comes twice in a row: a single one is
// a lost velocity.
double period_after(const State& state) {
  const double wait = state.ins.since_velocity;
  if (wait > longest_period) return state.velocity_period;
  const bool again = std::abs(wait - state.velocity_wait) < 0.1 * wait;
  return again ? wait : std::min(wait, state.velocity_period);
}

// P <- Phi P Phi' + Q_k, Phi = I + (A + P N'N/beta) dt, Q_k = (beta L L' + Q) dt. The whole update interval
// is one step, as the definition of the H2 filter includes the length of the step.
Prediction predicted(const State& state, const Settings& settings) {
  const Interval& interval = state.ins.interval;
  Prediction next;
  next.S = state.S;
  next.degraded = state.degraded;
  if (!(interval.duration > 0)) {
    next.P = state.P;
    next.x = state.x;
    return next;
  }
  Covariance G = transition_increment(interval);
  Eigen::Matrix3d Q_velocity = Eigen::Matrix3d::Zero();
  if (settings.algorithm == Algorithm::robust_h2) {
    next.alpha = uncertainty_size(settings, state.P, interval.delta_v_n / interval.duration);
    next.beta =
        add_h2_terms(uncertainty(settings.h2_case, next.alpha), state.P, interval.duration, G, Q_velocity);
  }
  if (next.beta > 0) {
    next.P = filtering::propagate_covariance_blocks<h2_blocks, state_count>(state.P, G);
    next.P.topLeftCorner<3, 3>() += Q_velocity;
    if (settings.loop == Loop::invariant && beyond_the_start(next.P, settings)) {
      next.degraded = true;
      next.beta = 0;
      G = transition_increment(interval);
    }
  }
  if (!(next.beta > 0)) {
    next.P = filtering::propagate_covariance_blocks<kalman_blocks, state_count>(state.P, G);
    if (settings.fading_per_s > 0 && settings.algorithm == Algorithm::kalman)
      next.P *= std::exp(2 * settings.fading_per_s * interval.duration);
  }
  next.P.diagonal() += process_noise(settings, interval.duration);
  if (settings.loop == Loop::invariant) {
    add_bridging_noise(next.P, interval);
    if (considers(settings))
      predict_considered(next.P, next.S, transition_increment(interval), interval, state.ins.measured,
                         settings);
  }
  next.x = state.x;
  if (settings.loop == Loop::open) next.x.noalias() += G.lazyProduct(state.x);
  return next;
}

// Corrects the INS by x: V -= dV; C <- exp([phi x]) C, where phi is in n axes; each bias += its estimated
// error.
Ins corrected(const Ins& ins, const StateVector& x) {
  Ins better = ins;
  better.nav.v_eb_n -= x.segment<3>(velocity_state);
  better.nav.C_bn =
      strapdown::reorthonormalised(strapdown::exp_rotation(x.segment<3>(attitude_state)) * ins.nav.C_bn);
  better.accel_bias += x.segment<3>(accel_bias_state);
  better.gyro_bias += x.segment<3>(gyro_bias_state);
  return better;
}

}  // namespace

State initial(const strapdown::NavState& nav, const Settings& settings) {
  State state;
  state.ins.nav = nav;
  state.P = initial_variance(settings).asDiagonal();
  state.x.setZero();
  state.S.setZero();
  state.velocity_period = settings.velocity_period;
  return state;
}

void propagate(State& state, const strapdown::ImuIncrement& imu, const Settings& settings) {
  Ins& ins = state.ins;
  const strapdown::ImuIncrement clean = strapdown::without_bias(imu, ins.gyro_bias, ins.accel_bias);
  const strapdown::MechanizationStep step =
      strapdown::mechanize(settings.mechanization, ins.nav, ins.previous, clean);
  ins.nav = step.nav;
  ins.previous = clean;
  extend(ins.interval, step, imu);
  ins.since_velocity += imu.dt;
  ins.measured.delta_v += clean.delta_v;
  ins.measured.delta_theta += clean.delta_theta;
}

bool prediction_is_due(const State& state, const Settings& settings) {
  return settings.loop == Loop::invariant && state.ins.interval.duration > longest_prediction;
}

void predict(State& state, const Settings& settings) {
  const Prediction next = predicted(state, settings);
  state.P = next.P;
  state.S = next.S;
  state.degraded = next.degraded;
  state.ins.interval = {};
  state.ins.measured = {};
}

UpdateResult update(State& state, const Eigen::Vector3d& master_velocity, const Settings& settings) {
  return update_with_difference(state, state.ins.nav.v_eb_n - master_velocity, settings);
}

UpdateResult update_with_difference(State& state, const Eigen::Vector3d& difference,
                                    const Settings& settings) {
  UpdateResult result;
  if (!(state.ins.since_velocity > 0)) return result;
  result.outcome = Outcome::non_finite;
  if (!difference.allFinite()) return result;

  const Prediction prior = predicted(state, settings);
  result.alpha = prior.alpha;
  result.beta = prior.beta;
  result.degraded = prior.degraded;
  result.innovation = difference - prior.x.segment<3>(velocity_state);
  // The settings state the master's noise as a density. The variance over an interval is the density divided
  // by the length of the interval, so the result does not depend on the update rate.
  const double period = settings.loop == Loop::invariant ? period_after(state) : state.ins.interval.duration;
  const Eigen::Matrix3d R = Eigen::Matrix3d::Identity() * (settings.velocity_noise_density / period);
  const bool with_considered = settings.loop == Loop::invariant && considers(settings);
  DifferenceOf H;
  if (with_considered)
    H = difference_of(state.ins.nav.C_bn, state.ins.previous.delta_theta / state.ins.previous.dt, settings);
  const auto correction = with_considered ? update_considered(prior.P, prior.S, H, R, result.innovation)
                                          : filtering::update_states<velocity_state, state_count, 3>(
                                                prior.P, R, result.innovation);
  result.innovation_covariance = correction.S;
  if (with_considered) result.lasting = considered_share(prior.S, H, correction.S);
  if (!correction.S.allFinite()) return result;
  result.outcome = Outcome::not_positive_definite;
  if (!correction.positive_definite) return result;
  result.nis = correction.nis;
  const bool beyond_gate =
      settings.loop == Loop::invariant && settings.gate_nis > 0 && result.nis > settings.gate_nis;
  if (beyond_gate && state.rejected < settings.gate_recovery) {
    result.outcome = Outcome::gated;
    ++state.rejected;
    return result;
  }
  result.dx = settings.loop == Loop::invariant ? invariant_correction(correction.K, result.innovation)
                                               : correction.dx;
  if (!result.dx.allFinite() || !correction.P.allFinite()) {
    result.outcome = Outcome::non_finite;
    return result;
  }
  // A variance of zero is valid: it means that a bias is known exactly.
  if (!(correction.P.diagonal().minCoeff() >= 0)) return result;

  result.outcome = Outcome::ok;
  state.P = correction.P;
  state.rejected = 0;
  state.degraded = false;
  state.velocity_period = period;
  state.velocity_wait = state.ins.since_velocity;
  state.ins.interval = Interval{};
  state.ins.measured = Measured{};
  state.ins.since_velocity = 0;
  if (settings.loop == Loop::open) {
    state.x = prior.x + result.dx;
    return result;
  }
  state.ins = corrected(state.ins, result.dx);
  if (settings.loop == Loop::invariant) {
    const Eigen::Vector3d phi = result.dx.segment<3>(attitude_state);
    turn_with_correction(state.P, phi);
    if (with_considered) {
      state.S = prior.S;
      correct_considered(state.S, correction.K, H);
      const Eigen::Matrix3d turn = strapdown::exp_rotation(phi);
      state.S.middleRows<3>(velocity_state) = (turn * state.S.middleRows<3>(velocity_state)).eval();
      state.S.middleRows<3>(attitude_state) = (turn * state.S.middleRows<3>(attitude_state)).eval();
    }
  }
  return result;
}

Covariance reported_covariance(const State& state) {
  Covariance P = state.P;
  if (state.ins.interval.duration > 0) add_bridging_noise(P, state.ins.interval);
  return P;
}

Ins estimate(const State& state) { return corrected(state.ins, state.x); }

}  // namespace canhil::transfer_alignment
