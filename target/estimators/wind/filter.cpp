#include "target/estimators/wind/filter.hpp"

#include <algorithm>
#include <cmath>

#include "target/estimators/wind/squared.hpp"

namespace canhil::wind {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double us = 1e-6;
constexpr double theta_interval_most = 0.1;  // upper limit of the interval for theta [s]

Observation observation(const Navigation& n) {
  Observation y;
  y << n.v_eb_n, n.omega, n.attitude;
  return y;
}

Fault judged(const Navigation& n, const Observation& y, const Design& design) {
  const Settings& s = design.settings;
  if (!n.valid) return Fault::invalid;
  if (!std::isfinite(y.sum() + n.altitude)) return Fault::not_finite;
  if (n.v_eb_n.norm() > s.ground_speed_most || n.omega.norm() > s.rate_most ||
      n.attitude.cwiseAbs().maxCoeff() > 2 * std::numbers::pi)
    return Fault::not_physical;
  if (std::abs(n.attitude.y()) > design.airframe.pitch_most) return Fault::pitch;
  return Fault::none;
}

// True if the navigation samples have been bit-identical for too long, which means that their source has
// stopped.
bool is_stale(State& state, const Observation& y, double gap, const Settings& settings) {
  state.unchanged_s = y == state.last ? state.unchanged_s + gap : 0;
  state.last = y;
  return state.unchanged_s > settings.stale_limit;
}

// Null: lasting errors are not considered.
Sensitivity* sensitivity_of(State& state, const Settings& settings) {
  return considers_lasting_errors(settings) ? &state.sensitivity : nullptr;
}

// Makes the next usable sample restart the filter, which then uses only the wind of this state.
void forget(State& state) {
  state.started = false;
  state.coasted_s = 0;
  state.jumps = 0;
  state.noise_factor = 1;
}

// Starts from navigation and the known wind: v_a = C_nb (v_eb_n - v_w). The error of v_a is
// C_nb (dv - dv_w - D dPhi), where D is the derivative of C_bn v_a with respect to Phi.
void start(State& state, const Navigation& n, const Settings& settings) {
  const Matrix3d P_wind = state.P.block<3, 3>(wind_at, wind_at);
  const Matrix3d C_nb = C_bn(n.attitude).transpose();
  state.x << C_nb * (n.v_eb_n - state.x.segment<3>(wind_at)), n.omega, n.attitude,
      Vector3d(state.x.segment<3>(wind_at));
  const Matrix3d D = ground_velocity(state.x).by_attitude;
  const double R_v = squared(settings.velocity_sigma), R_attitude = squared(settings.attitude_sigma);
  Covariance& P = state.P;
  P.setZero();
  P.block<3, 3>(rate_at, rate_at).diagonal().setConstant(squared(settings.rate_sigma));
  P.block<3, 3>(attitude_at, attitude_at).diagonal().setConstant(R_attitude);
  P.block<3, 3>(wind_at, wind_at) = P_wind;
  P.block<3, 3>(air_velocity_at, air_velocity_at) =
      C_nb * (R_v * Matrix3d::Identity() + P_wind + R_attitude * D * D.transpose()) * C_nb.transpose();
  P.block<3, 3>(wind_at, air_velocity_at) = -P_wind * C_nb.transpose();
  P.block<3, 3>(attitude_at, air_velocity_at) = -R_attitude * D.transpose() * C_nb.transpose();
  filtering::mirror_lower<12>(P);
  Sensitivity& S = state.sensitivity;
  S.topRows<9>().setZero();
  S.block<3, 3>(attitude_at, attitude_bias_at).setIdentity();
  S.middleRows<3>(air_velocity_at) = -C_nb.lazyProduct(S.bottomRows<3>());
  S.block<3, 3>(air_velocity_at, velocity_bias_at) += C_nb;
  S.block<3, 3>(air_velocity_at, attitude_bias_at) -= C_nb * D;
  state.started = true;
  state.sample_used = true;
  state.coasted_s = 0;
}

void note_fins(const ActingFins& acting, const Settings& settings, Flags& flags) {
  const double gap = us * static_cast<double>(acting.gap_us);
  flags.fins_late |= !acting.known || gap > settings.fins_late;
  flags.fins_missing |= !acting.known || gap > settings.fins_missing;
  flags.fins_not_physical |= acting.not_physical;
}

// The altitude after dt, extrapolated by the downward velocity. Used within a gap and for coasting, where no
// sample gives the altitude.
double reckoned_altitude(const State& state, double dt) {
  const double down = C_bn(state.x.segment<3>(attitude_at)).row(2).dot(state.x.segment<3>(air_velocity_at)) +
                      state.x(wind_at + 2);
  return state.altitude - down * dt;
}

// Advances by one part of a step, with the mean deflections over this part.
void advance(State& state, double dt, const ActingFins& acting, const Design& design, Flags& flags) {
  const Range& range = design.airframe.altitude;
  RangeFlags outside;
  outside.altitude = !(state.altitude >= range.least && state.altitude <= range.most);
  const Inputs inputs{acting.mean, standard_atmosphere(std::clamp(state.altitude, range.least, range.most))};
  Densities density = design.settings.density;
  (follows_loads(design.settings.process_noise) ? density.coefficient : density.rate) *=
      std::sqrt(state.noise_factor);
  if (flags.fins_missing) density = raised(density, design.settings.degraded);
  predict(state.x, state.P, dt, inputs, density, design, outside, sensitivity_of(state, design.settings));
  flags.outside |= outside;
}

// Advances from state.t_us to t_us in parts. `reckon`: the sample is not usable, so the altitude at t_us is
// extrapolated.
void advance(State& state, std::int64_t t_us, bool reckon, const FinHistory& fins, const Design& design,
             Flags& flags) {
  const std::int64_t begin = *state.t_us, gap_us = t_us - begin;
  const auto longest_us = std::int64_t{std::llround(std::max(design.settings.longest_prediction, 1e-3) / us)};
  const std::int64_t parts = (gap_us + longest_us - 1) / longest_us;
  for (std::int64_t i = 0; i < parts; ++i) {
    const std::int64_t from = begin + gap_us * i / parts, to = begin + gap_us * (i + 1) / parts;
    const double dt = us * static_cast<double>(to - from);
    const ActingFins acting = fins.over(from, to);
    note_fins(acting, design.settings, flags);
    const bool last = i + 1 == parts;
    const double altitude = !last || reckon ? reckoned_altitude(state, dt) : state.altitude;
    advance(state, dt, acting, design, flags);
    state.altitude = altitude;
  }
  state.t_us = t_us;
  state.sample_used = false;
}

// Adapts the process noise so that the NIS gets its expected value. This takes a few samples if the NIS is
// far too large, as at release, and is slow while the NIS only scatters about its mean.
void adapt(State& state, double nis, double gap, const Settings& settings) {
  const double excess = std::clamp(nis / 9 - 1, -1.0, 50.0);
  state.noise_factor = std::clamp(state.noise_factor * std::exp(excess * gap / settings.adaptation_time), 1.0,
                                  settings.adaptation_limit);
}

bool is_sound(const State& state) {  // a sum is finite only if all of its terms are
  return std::isfinite(state.x.sum() + state.P.sum() + state.sensitivity.sum()) &&
         state.P.diagonal().minCoeff() > 0;
}

bool jumped(const Observation& innovation, const Settings& settings) {
  return innovation.head<3>().norm() > settings.velocity_gate ||
         innovation.tail<3>().cwiseAbs().maxCoeff() > settings.attitude_gate;
}

// Updates by a usable sample, or refuses it as a jump.
void use(State& state, const Navigation& n, const Observation& y, double gap, const Settings& settings,
         const Design& design, UpdateResult& result) {
  const GroundVelocity at = ground_velocity(state.x);
  result.innovation = innovation_of(y, state.x, at);
  if (jumped(result.innovation, settings)) {
    result.fault = Fault::jump;
    if (++state.jumps < settings.jumps_limit) {
      result.outcome = Outcome::coasting;
      state.coasted_s += gap;
      return;
    }
    forget(state);
    state.x.tail<3>().setZero();  // navigation or the wind estimate was wrong, so the wind is unknown now
    state.sensitivity.bottomRows<3>().setZero();
    state.P.block<3, 3>(wind_at, wind_at) = squared(settings.wind_sigma_0) * Matrix3d::Identity();
    start(state, n, settings);
    result.outcome = Outcome::started;
    return;
  }
  state.jumps = 0;
  const double interval = gap > 0 ? std::min(gap, theta_interval_most)
                                  : settings.sample_period;  // gap 0: first sample, at release
  const Answer answer =
      update(state.x, state.P, result.innovation, at, interval, design, sensitivity_of(state, settings));
  result.normalised = answer.normalised;
  result.lasting = answer.lasting;
  result.nis = answer.nis;
  result.surprise = answer.surprise;
  result.theta = answer.theta;
  result.flags.theta_capped = answer.theta_capped;
  result.outcome = Outcome::updated;
  if (settings.algorithm == Algorithm::adaptive_q) adapt(state, answer.nis, interval, settings);
  state.coasted_s = 0;
  state.sample_used = true;
}

void follow(State& state, const Navigation& n, const FinHistory& fins, const Design& design,
            UpdateResult& result) {
  const Settings& settings = design.settings;
  const Observation y = observation(n);
  const double gap = state.t_us ? us * static_cast<double>(n.t_us - *state.t_us) : 0;
  result.fault = judged(n, y, design);
  if (is_stale(state, y, gap, settings) && result.fault == Fault::none) result.fault = Fault::stale;
  const bool usable = result.fault == Fault::none;
  if (state.started && state.coasted_s + gap > settings.coast_limit) forget(state);
  if (state.started) {
    advance(state, n.t_us, !usable, fins, design, result.flags);
    if (usable) {
      use(state, n, y, gap, settings, design, result);
    } else {
      result.outcome = Outcome::coasting;
      state.coasted_s += gap;
    }
  } else {
    state.P.diagonal().tail<3>().array() += squared(settings.density.wind) * gap;
    if (usable) {
      start(state, n, settings);
      result.outcome = Outcome::started;
    }
  }
  state.t_us = n.t_us;
  if (usable) state.altitude = n.altitude;
  state.x(attitude_at) = wrapped(state.x(attitude_at));
  state.x(attitude_at + 2) = wrapped(state.x(attitude_at + 2));
}

}  // namespace

State initial(const Design& design, const Vector3d& wind) {
  State state;
  state.x.tail<3>() = wind;
  state.P *= squared(design.settings.wind_sigma_0);
  return state;
}

State initial(const Start& s, const Design& design) {
  const Settings& settings = design.settings;
  State state;
  state.x << s.air_velocity, s.omega, s.attitude, Vector3d::Zero();
  const GroundVelocity g = ground_velocity(state.x);
  state.x.tail<3>() = s.v_eb_n - g.C_v_a;
  const double P_a = squared(settings.air_velocity_sigma_0), P_attitude = squared(settings.attitude_sigma_0);
  Covariance& P = state.P;
  P.setZero();
  P.diagonal() << Vector3d::Constant(P_a), Vector3d::Constant(squared(settings.rate_sigma_0)),
      Vector3d::Constant(P_attitude), Vector3d::Zero();
  P.block<3, 3>(wind_at, air_velocity_at) = -P_a * g.C_bn;
  P.block<3, 3>(wind_at, attitude_at) = -P_attitude * g.by_attitude;
  P.block<3, 3>(wind_at, wind_at) = (squared(settings.velocity_sigma_0) + P_a) * Matrix3d::Identity() +
                                    P_attitude * g.by_attitude * g.by_attitude.transpose();
  filtering::mirror_lower<12>(P);
  state.started = true;
  state.t_us = s.t_us;
  state.altitude = s.altitude;
  return state;
}

Covariance reported_covariance(const State& state, const Settings& settings) {
  if (!considers_lasting_errors(settings)) return state.P;
  const Sensitivity by_sigma = state.sensitivity * lasting_sigma(settings).asDiagonal();
  Covariance P = state.P + by_sigma.lazyProduct(by_sigma.transpose());
  filtering::mirror_lower<12>(P);
  return P;
}

UpdateResult step(State& state, const Navigation& navigation, const FinHistory& fins, const Design& design) {
  UpdateResult result;
  if (state.t_us &&
      (navigation.t_us < *state.t_us || (navigation.t_us == *state.t_us && state.sample_used))) {
    result.outcome = Outcome::out_of_order;
    return result;
  }
  State next = state;
  follow(next, navigation, fins, design, result);
  if (is_sound(next) && std::isfinite(result.nis)) {
    state = next;
    return result;
  }
  // A previous state that is finite is kept, but after forget() only its wind is used.
  result.outcome = Outcome::non_finite;
  if (!is_sound(state)) state = initial(design);
  forget(state);
  state.t_us = navigation.t_us;
  return result;
}

}  // namespace canhil::wind
