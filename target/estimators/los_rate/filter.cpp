#include "target/estimators/los_rate/filter.hpp"

#include <algorithm>
#include <cmath>

#include "target/estimators/los_rate/lag.hpp"

namespace canhil::los_rate {
namespace {

Plane angle(const Planes<double>& planes) { return {planes.yaw, planes.pitch}; }
Plane acceleration(const Planes<double>& planes) { return {planes.yaw, -planes.pitch}; }

bool finite(Plane value) { return std::isfinite(value.real()) && std::isfinite(value.imag()); }
bool finite(const Covariance& P) {
  return std::isfinite(P.ee + P.ew + P.ea + P.ww + P.wa + P.aa) && P.ee >= 0 && P.ww >= 0 && P.aa >= 0;
}
bool finite(const State& state) {
  return finite(state.error) && finite(state.rate) && finite(state.acceleration) &&
         finite(state.motion.antenna_rate) &&
         (!state.covariance || (finite(state.P.pitch) && finite(state.P.yaw)));
}

// A sample's inputs in the complex plane, and which of them are missing.
struct Sample {
  double gap, interval;  // of the lost samples before this sample; of this sample [s]
  Plane error, antenna_increment;
  double roll_increment;
  Motion motion;  // over `interval`; a missing value is replaced by its last measurement
  bool error_ok, antenna_ok, acceleration_ok;  // antenna_ok: over the whole step
  bool motion_known;                           // over its interval
  Fault fault;                                 // the first fault
};

// A gap can be bridged only between two samples with known motion; otherwise the motion of the whole step is
// unknown. The classical filter does not use the missile's acceleration.
Sample judged(const State& state, const Measurement& m, const Settings& settings) {
  const bool lost = m.interval > 0 && m.interval < m.dt;
  const Plane missile_acceleration = acceleration(m.missile_acceleration);
  const bool antenna_measured =
      m.antenna_valid && finite(angle(m.antenna_increment)) && std::isfinite(m.roll_increment);
  const bool acceleration_ok = m.acceleration_valid && finite(missile_acceleration);
  const bool motion_known =
      antenna_measured && (acceleration_ok || settings.algorithm == Algorithm::low_pass);
  const bool bridged = lost && m.dt - m.interval <= settings.gap_limit && state.motion_known && motion_known;
  Sample s{.gap = bridged ? m.dt - m.interval : 0,
           .interval = bridged ? m.interval : m.dt,
           .error = angle(m.error),
           .antenna_increment = angle(m.antenna_increment),
           .roll_increment = m.roll_increment,
           .motion = state.motion,
           .error_ok = m.error_valid && finite(angle(m.error)),
           .antenna_ok = antenna_measured && lost == bridged,
           .acceleration_ok = acceleration_ok,
           .motion_known = motion_known,
           .fault = Fault::none};
  if (!s.error_ok) {
    s.fault = Fault::error_angle;
  } else if (!(std::norm(s.error) <= settings.field_of_view * settings.field_of_view)) {
    s.error_ok = false;
    s.fault = Fault::field_of_view;
  } else if (!s.antenna_ok || bridged) {
    s.fault = Fault::antenna;
  } else if (!s.acceleration_ok) {
    s.fault = Fault::acceleration;
  }
  if (antenna_measured) {
    const double own = lost ? m.interval : m.dt;
    s.motion.antenna_rate = s.antenna_increment / own;
    s.motion.roll_rate = s.roll_increment / own;
  }
  if (s.acceleration_ok) s.motion.missile_acceleration = missile_acceleration;
  return s;
}

Geometry clamped(Geometry now, const Settings& settings, bool& blind) {
  const double least = least_range(settings, now.closing_speed);
  blind = now.range < least;
  return {blind ? least : now.range, now.closing_speed};
}

void start(State& state, Plane error, const Design& design, UpdateResult& result) {
  const Settings& settings = design.settings;
  const double w = settings.rate_sigma_0, a = settings.acceleration_sigma_0;
  state.error = error;
  state.P = of_planes(design, [&](auto plane) {
    return Covariance{
        .ee = sample_variance(plane(settings.noise), result.used.range), .ww = w * w, .aa = a * a};
  });
  state.started = state.covariance = true;
  const bool no_start_up =
      settings.algorithm == Algorithm::kalman || settings.algorithm == Algorithm::low_pass;
  state.start_up_s = no_start_up ? 0 : settings.start_up;
  result.outcome = Outcome::started;
}

// Predicts P over a leg and adds the variances of motion that was not measured. The sigmas of this motion are
// `turn` [rad] for the antenna and `pull` [m/s] for the missile.
void predict_covariance(State& state, Geometry end, double dt, double turn, double pull,
                        const Design& design) {
  const double w = pull / end.range;
  state.P = of_planes(design, [&](auto plane) {
    Covariance P = predicted(plane(state.P), end, dt, design.settings.jerk_density);
    P.ee += turn * turn;
    P.ww += w * w;
    return P;
  });
}

double normalised(Plane innovation, const Planes<double>& S) {
  return innovation.imag() * innovation.imag() / S.pitch + innovation.real() * innovation.real() / S.yaw;
}

void update_kalman(State& state, Plane innovation, const Design& design, UpdateResult& result) {
  const Planes<double> R = of_planes(
      design, [&](auto plane) { return sample_variance(plane(design.settings.noise), result.used.range); });
  const Planes<Gain> K = of_planes(design, [&](auto plane) { return kalman_gain(plane(state.P), plane(R)); });
  result.innovation_variance = {state.P.pitch.ee + R.pitch, state.P.yaw.ee + R.yaw};
  result.nis = normalised(innovation, result.innovation_variance);
  correct(state, innovation, K);
  note_lag(state, innovation, {K.pitch.e, K.yaw.e}, result.innovation_variance, design);
  state.P = of_planes(design, [&](auto plane) { return updated(plane(state.P), plane(K)); });
}

void update_closed(State& state, Plane innovation, const Design& design, UpdateResult& result) {
  const Settings& settings = design.settings;
  struct Closed {
    ClosedGain gain;
    double S;
  };
  const Planes<Closed> closed = of_planes(design, [&](auto plane) -> Closed {
    const double R = sample_variance(plane(settings.noise), result.used.range);
    if (settings.algorithm == Algorithm::low_pass) {
      const ClosedGain gain = closed_gain(design.low_pass, R, settings.sample_period);
      return {gain, R + gain.sigma.error * gain.sigma.error};
    }
    const ClosedGain gain = settings.algorithm == Algorithm::switched_table
                                ? closed_gain(plane(design.p_bar), settings, result.used)
                                : closed_gain(plane(design.combined), result.used);
    return {gain, R / (1 - gain.K.e)};  // K1 = P_ee/(P_ee + R)
  });
  result.innovation_variance = {closed.pitch.S, closed.yaw.S};
  result.nis = normalised(innovation, result.innovation_variance);
  correct(state, innovation, {closed.pitch.gain.K, closed.yaw.gain.K});
  note_lag(state, innovation, {closed.pitch.gain.K.e, closed.yaw.gain.K.e}, result.innovation_variance,
           design);
  state.covariance = false;
  result.sigma = {closed.pitch.gain.sigma, closed.yaw.gain.sigma};
}

void update(State& state, Plane measured, double dt, bool kalman, const Design& design,
            UpdateResult& result) {
  const Plane innovation = measured - state.error;
  result.innovation = {.pitch = innovation.imag(), .yaw = innovation.real()};
  state.coasted_s = 0;
  result.outcome = state.start_up_s > 0 ? Outcome::start_up : Outcome::updated;
  state.start_up_s -= dt;
  if (kalman) {
    update_kalman(state, innovation, design, result);
  } else {
    update_closed(state, innovation, design, result);
  }
}

// A closed gain assumes an estimate with steady-state accuracy. If a coast makes the estimate much worse, the
// Kalman filter of the start-up runs again.
void coast(State& state, double dt, const Sample& sample, const Settings& settings, UpdateResult& result) {
  result.outcome = Outcome::coasting;
  state.coasted_s += dt;
  const bool moved_unseen = !sample.antenna_ok || !sample.acceleration_ok;
  const bool has_closed_gain =
      settings.algorithm == Algorithm::combined || settings.algorithm == Algorithm::switched_table;
  if (has_closed_gain && (moved_unseen || state.coasted_s > settings.gap_limit))
    state.start_up_s = settings.start_up;
}

// The classical filter tracks the LOS angle itself: error+ = error + rate dt - antenna increment. The error
// and the rate are turned by the whole roll, the antenna increment only by half of the roll.
void predict_low_pass(State& state, double dt, Plane antenna_increment, double roll_increment) {
  const Plane half = std::polar(1.0, roll_increment / 2), whole = half * half;
  state.error = (state.error + state.rate * dt) * whole - antenna_increment * half;
  state.rate *= whole;
}

// The leg of the sample's own interval. If the antenna's increment is missing, the antenna is assumed to turn
// at the LOS rate.
Leg own_leg(const State& state, const Sample& sample, const Settings& settings) {
  const double dt = sample.interval;
  return {.dt = dt,
          .antenna_increment = sample.antenna_ok ? sample.antenna_increment : state.rate * dt,
          .roll_increment = sample.antenna_ok ? sample.roll_increment : 0,
          .missile_acceleration = sample.motion.missile_acceleration,
          .turn = sample.antenna_ok ? 0 : settings.antenna_rate_sigma * dt,
          .pull = sample.acceleration_ok ? 0 : settings.missile_acceleration_sigma * dt};
}

void predict(State& state, Geometry end, const Leg& leg, bool covariance, const Design& design) {
  if (design.settings.algorithm == Algorithm::low_pass) {
    predict_low_pass(state, leg.dt, leg.antenna_increment, leg.roll_increment);
  } else {
    predict(state, end, leg.dt, leg.antenna_increment, leg.missile_acceleration, leg.roll_increment);
  }
  state.drift *= std::polar(1.0, leg.roll_increment);
  if (covariance) predict_covariance(state, end, leg.dt, leg.turn, leg.pull, design);
}

void advance(State& state, const Measurement& m, const Sample& sample, bool range_ok, const Design& design,
             UpdateResult& result) {
  const Settings& settings = design.settings;
  const bool low_pass = settings.algorithm == Algorithm::low_pass;  // uses neither range nor acceleration
  const bool measured =
      sample.error_ok && sample.antenna_ok && (low_pass || (sample.acceleration_ok && range_ok));
  // A closed gain is valid only for one nominal step that begins in the steady state. After a gap or a coast
  // P is larger, so the update uses a Kalman gain.
  const bool uneven = !low_pass && (sample.gap > 0 || state.coasted_s > 0);
  const bool beyond_table =
      settings.algorithm == Algorithm::combined &&
      (result.used.range > settings.range_max || result.used.closing_speed > settings.closing_speed_max);
  const bool kalman =
      settings.algorithm == Algorithm::kalman || state.start_up_s > 0 || uneven || beyond_table;
  if (!state.covariance && (!measured || kalman)) {
    const Geometry begin{result.used.range + result.used.closing_speed * m.dt, result.used.closing_speed};
    state.P = of_planes(
        design, [&](auto plane) { return steady_covariance(settings, plane(settings.noise), begin); });
    state.covariance = true;
  }
  // At the clamped range a long extrapolation would let the rate grow without bound, because w' = (2 vc/r) w.
  // So the closing speed is set to 0.
  const Geometry end{result.used.range, result.blind && !measured ? 0 : result.used.closing_speed};
  const bool covariance = !measured || kalman;
  if (sample.gap > 0) {
    const Geometry gap_end{end.range + end.closing_speed * sample.interval, end.closing_speed};
    predict(state, gap_end, bridge(state.motion, sample.motion, sample.gap), covariance, design);
  }
  predict(state, end, own_leg(state, sample, settings), covariance, design);
  if (measured) {
    update(state, sample.error, m.dt, kalman, design, result);
  } else {
    coast(state, m.dt, sample, settings, result);
  }
}

}  // namespace

State initial() { return {}; }

void predict(State& state, Geometry end, double dt, Plane antenna_increment, Plane missile_acceleration,
             double roll_increment) {
  const Transition phi = transition(end, dt);
  // A roll rate p turns each complex state c according to c' = j p c. The states are turned by the whole
  // roll. The inputs are given in the axes at mid-roll, so they are first turned back by half of the roll.
  const Plane half = std::polar(1.0, roll_increment / 2), whole = half * half;
  antenna_increment *= std::conj(half);
  missile_acceleration *= std::conj(half);
  const Plane difference = state.acceleration - missile_acceleration;
  state.error = whole * (state.error + phi.ew * state.rate + phi.ea * difference - antenna_increment);
  state.rate = whole * (phi.ww * state.rate + phi.wa * difference);
  state.acceleration *= whole;
}

void correct(State& state, Plane innovation, const Planes<Gain>& gain) {
  const auto weighted = [innovation](double pitch, double yaw) -> Plane {
    return {yaw * innovation.real(), pitch * innovation.imag()};
  };
  state.error += weighted(gain.pitch.e, gain.yaw.e);
  state.rate += weighted(gain.pitch.w, gain.yaw.w);
  state.acceleration += weighted(gain.pitch.a, gain.yaw.a);
}

UpdateResult step(State& state, const Measurement& m, const Design& design) {
  const Settings& settings = design.settings;
  UpdateResult result;
  if (!(m.dt > 0 && m.dt <= settings.longest_step)) return result;
  State next = state;
  const Sample sample = judged(state, m, settings);
  const Fault range_fault = follow(next.track, m.range, m.dt, settings);
  const bool range_ok = range_fault == Fault::none;
  result.fault = sample.fault == Fault::none ? range_fault : sample.fault;
  result.used = clamped(next.track.now, settings, result.blind);
  if (next.started) {
    advance(next, m, sample, range_ok, design, result);
  } else if (sample.error_ok && range_ok) {
    start(next, sample.error, design, result);
  } else {
    result.outcome = Outcome::waiting;
  }
  next.motion = sample.motion;
  next.motion_known = sample.motion_known;
  if (!finite(next) || !std::isfinite(result.nis)) {
    result.outcome = Outcome::non_finite;
    return result;
  }
  if (!next.started) {
    const Sigma unknown{settings.field_of_view, settings.rate_sigma_0, settings.acceleration_sigma_0};
    result.sigma = {unknown, unknown};
  } else if (next.covariance) {
    result.sigma = of_planes(design, [&](auto plane) { return sigma_of(plane(next.P)); });
  }
  result.lag = next.lag;
  state = next;
  return result;
}

Estimate estimate(const State& state) {
  return {{state.error.imag(), state.error.real()},
          {state.rate.imag(), state.rate.real()},
          {-state.acceleration.imag(), state.acceleration.real()}};
}

}  // namespace canhil::los_rate
