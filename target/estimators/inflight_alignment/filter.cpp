#include "target/estimators/inflight_alignment/filter.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <utility>

#include "target/estimators/inflight_alignment/fix.hpp"
#include "target/estimators/inflight_alignment/fix_error.hpp"
#include "target/estimators/inflight_alignment/psi_angle.hpp"
#include "target/estimators/inflight_alignment/sin_cos.hpp"
#include "target/estimators/inflight_alignment/wrong_fixes.hpp"
#include "target/estimators/strapdown/attitude.hpp"
#include "target/estimators/strapdown/earth.hpp"

namespace canhil::inflight_alignment {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::uint32_t orthonormalisation_period = 50;  // steps

// The sigma of the tilts [rad] after levelling by the first sample: levelling mistakes the vehicle's
// acceleration for gravity.
double levelling_sigma(const Settings& settings) {
  return settings.start_acceleration_sigma / standard_gravity;
}

bool is_levelled_first(const Settings& settings) {
  return settings.algorithm == Algorithm::sin_cos && settings.sin_cos_form == SinCosForm::levelled &&
         settings.tilt_sigma_0 > levelling_sigma(settings);
}

// Turns the attitude by the smallest angle that makes the specific force point upwards.
void level(strapdown::NavState& nav, const Vector3d& delta_v) {
  const Vector3d force = (nav.C_bn * delta_v).normalized(), up(0, 0, -1);
  const Vector3d axis = force.cross(up);
  const double sine = axis.norm();
  if (!(sine > 0)) return;
  nav.C_bn = strapdown::exp_rotation(std::atan2(sine, force.dot(up)) / sine * axis) * nav.C_bn;
}

template <int N>
Errors<N> initial_errors(const Settings& settings) {
  using At = Layout<N>;
  Vector<N> sigma = Vector<N>::Zero();
  sigma.template segment<3>(At::position) = settings.position_sigma_0;
  sigma.template segment<3>(At::velocity) = settings.velocity_sigma_0;
  // Levelling is a rotation by delta. If there is a tilt phi, levelling adds the heading error
  // (phi x delta)_z / 2.
  double tilt = settings.tilt_sigma_0, heading = settings.heading_sigma_0;
  if (is_levelled_first(settings)) {
    heading = std::hypot(heading, tilt * levelling_sigma(settings) / std::numbers::sqrt2);
    tilt = levelling_sigma(settings);
  }
  sigma.template segment<2>(At::attitude).setConstant(tilt);
  sigma.template segment<3>(At::accel_bias).setConstant(settings.accel_bias_sigma_0);
  sigma.template segment<3>(At::gyro_bias).setConstant(settings.gyro_bias_sigma_0);
  if constexpr (!is_sin_cos<N>) sigma(At::attitude + 2) = heading;
  if constexpr (At::has_fix_bias)
    sigma.template segment<3>(At::fix_bias) = fix_error_model(settings, {}).state.cwiseSqrt();
  Errors<N> errors;
  errors.P = sigma.cwiseAbs2().asDiagonal();
  errors.form = settings.sin_cos_form;
  if constexpr (is_sin_cos<N>) set_heading_prior<N>(errors, heading);
  return errors;
}

// Predicts the errors over the interval. Returns how often P was repaired.
template <int N>
int predict_errors(Errors<N>& errors, FixErrors& fixes, const Interval& interval, const Settings& settings) {
  if (!(interval.duration > 0)) return 0;
  if constexpr (is_sin_cos<N>) {
    predict_sin_cos<N>(errors, interval, settings);
    predict_fix_bias<N>(errors, fixes, settings, interval.duration);
  } else {
    if (settings.algorithm == Algorithm::ukf) return predict_ukf<N>(errors, interval, settings);
    predict_ekf<N>(errors, interval, settings);
  }
  return 0;
}

Vector3d position_difference(const GeodeticPosition& ins, const GeodeticPosition& fix) {
  const strapdown::LocalEarth earth = strapdown::local_earth(ins.latitude, ins.height);
  const double d_longitude = std::remainder(ins.longitude - fix.longitude, 2 * std::numbers::pi);
  return {(ins.latitude - fix.latitude) * (earth.meridian_radius + ins.height),
          d_longitude * (earth.transverse_radius + ins.height) * earth.cos_latitude, fix.height - ins.height};
}

enum class SensorBiases : std::uint8_t { stay, fed_back };

// Corrects position and velocity of the INS by their estimated errors, and its attitude by C_pc. Adds the
// estimated errors of the fix bias (not in the levelled form, where it need not be constant) and, with
// SensorBiases::fed_back, of the sensor biases to the bias estimates. Zeroes the states that it has fed back,
// except the attitude, which the caller zeroes.
template <int N>
void feed_back(State& state, Errors<N>& errors, const Matrix3d& C_pc, SensorBiases biases) {
  using At = Layout<N>;
  Vector<N>& x = errors.x;
  state.ins.nav = corrected(state.ins.nav, x.template segment<3>(At::position),
                            x.template segment<3>(At::velocity), C_pc);
  x.template head<6>().setZero();
  if constexpr (At::has_fix_bias) {
    if (!is_sin_cos<N> || errors.form == SinCosForm::published) {
      state.fix_bias += x.template segment<3>(At::fix_bias);
      x.template segment<3>(At::fix_bias).setZero();
    }
  }
  if (biases == SensorBiases::stay) return;
  state.accel_bias += x.template segment<3>(At::accel_bias);
  state.gyro_bias += x.template segment<3>(At::gyro_bias);
  x.template segment<6>(At::accel_bias).setZero();
}

template <int N>
void close_loop(State& state, Errors<N>& errors, const Settings& settings) {
  if constexpr (is_sin_cos<N>) {
    state.off_circle = is_off_circle<N>(errors, state.off_circle);
    state.handed_over = heading_is_resolved<N>(errors, settings) &&
                        !(errors.form == SinCosForm::levelled && state.off_circle);
    if (state.handed_over) {
      feed_back<N>(state, errors, take_out_attitude<N>(errors), SensorBiases::fed_back);
    } else if (errors.form == SinCosForm::levelled) {
      feed_back<N>(state, errors, take_out_tilt<N>(errors), SensorBiases::stay);
    } else {
      feed_back<N>(state, errors, Matrix3d::Identity(), SensorBiases::fed_back);
    }
  } else {
    const Vector3d psi = errors.x.template segment<3>(6);
    const bool platform = settings.attitude_error_frame == AttitudeErrorFrame::platform;
    // Tilts in navigation axes are applied after the heading: C_pc = exp([tilt x]) Rz(psi_z), as in sin_cos.
    const Matrix3d C_pc = platform ? platform_to_computer(psi)
                                   : Matrix3d(strapdown::exp_rotation({psi.x(), psi.y(), 0}) *
                                              strapdown::exp_rotation({0, 0, psi.z()}));
    feed_back<N>(state, errors, C_pc, SensorBiases::fed_back);
    errors.x.template segment<3>(6).setZero();
    if (!platform) return;
    // The errors that remain are small angles relative to the corrected platform. The rotation axes of the
    // old angles convert P to these small angles.
    const Matrix3d axes = rotation_axes(psi);
    errors.P.template middleRows<3>(6) = (axes * errors.P.template middleRows<3>(6)).eval();
    errors.P.template middleCols<3>(6) = (errors.P.template middleCols<3>(6) * axes.transpose()).eval();
    filtering::average_with_transpose<N>(errors.P);
  }
}

template <int N>
UpdateResult update_errors(State& state, const Errors<N>& before, const GeodeticPosition& ins,
                           const Vector3d& difference, const FixSigma& reported, const Settings& settings) {
  UpdateResult result;
  Errors<N> errors = before;
  FixErrors fixes = state.fixes;
  result.repairs = predict_errors<N>(errors, fixes, state.ins.interval, settings);
  const FixErrorModel fix_error = fix_error_model(settings, reported);
  if constexpr (Layout<N>::has_fix_bias)  // if fixes now report a larger sigma
    errors.P.diagonal().template segment<3>(Layout<N>::fix_bias) +=
        (fix_error.state - fixes.told).cwiseMax(0);
  fixes.told = fixes.told.cwiseMax(fix_error.state);
  result.innovation = difference + state.fix_bias - errors.x.template segment<3>(Layout<N>::position);
  if constexpr (Layout<N>::has_fix_bias)
    result.innovation += errors.x.template segment<3>(Layout<N>::fix_bias);

  result.position = corrected(ins, errors.x.template segment<3>(Layout<N>::position));

  auto c = correction<N>(errors, result.innovation, fix_error.white);
  result.innovation_covariance = c.S;
  result.outcome = Outcome::non_finite;
  if (!c.S.allFinite() || !result.innovation.allFinite()) return result;
  result.outcome = Outcome::not_positive_definite;
  if (!c.positive_definite) return result;
  result.nis = c.nis;
  const bool doubted = is_doubted(c.nis, state.rejected, settings);
  const bool beyond_gate = settings.gate_nis > 0 && doubted;
  if (beyond_gate && state.rejected < settings.gate_recovery) {
    result.outcome = Outcome::gated;
    ++state.rejected;
    return result;
  }
  if (models_fix_errors(settings)) {
    if (doubted) widen<N>(errors, fixes, result.innovation, 0);
    if (doubted || watch<N>(errors, fixes, result.innovation, c.S))
      c = correction<N>(errors, result.innovation, fix_error.white);
  }
  errors.x += c.dx;
  errors.P = c.P;
  result.outcome = Outcome::non_finite;
  // The sum is finite only if every element is.
  if (!std::isfinite(errors.x.sum()) || !std::isfinite(errors.P.sum())) return result;
  result.outcome = Outcome::not_positive_definite;
  if (!(errors.P.diagonal().minCoeff() >= 0)) return result;

  result.outcome = Outcome::ok;
  result.gate_opened = beyond_gate;
  result.position = corrected(ins, errors.x.template segment<3>(Layout<N>::position));
  if constexpr (!is_sin_cos<N>) errors.x(8) = std::remainder(errors.x(8), 2 * std::numbers::pi);
  if (is_sin_cos<N> || settings.closed_loop) close_loop<N>(state, errors, settings);
  errors.second_order = 0;
  fixes.reported = reported;
  fixes.age = 0;
  state.errors = errors;
  state.fixes = fixes;
  state.ins.interval = Interval{};
  state.updated_at = state.ins.steps;
  state.rejected = 0;
  state.repairs += static_cast<std::uint32_t>(result.repairs);
  return result;
}

}  // namespace

State initial(const strapdown::NavState& nav, const Settings& settings) {
  State state;
  state.ins.nav = nav;
  state.to_be_levelled = is_levelled_first(settings);
  state.fixes.told = fix_error_model(settings, {}).state;
  const bool ssbl = settings.aiding == Aiding::ssbl;
  if (settings.algorithm == Algorithm::sin_cos) {
    if (ssbl || models_fix_errors(settings)) {
      state.errors = initial_errors<19>(settings);
    } else {
      state.errors = initial_errors<16>(settings);
    }
  } else if (ssbl) {
    state.errors = initial_errors<18>(settings);
  } else {
    state.errors = initial_errors<15>(settings);
  }
  return state;
}

void mechanise(State& state, const strapdown::ImuIncrement& imu) {
  Ins& ins = state.ins;
  if (std::exchange(state.to_be_levelled, false)) level(ins.nav, imu.delta_v);
  const strapdown::MechanizationStep step = strapdown::mechanize_one_sample(
      ins.nav, strapdown::without_bias(imu, state.gyro_bias, state.accel_bias));
  ins.nav = step.nav;
  if (++ins.steps % orthonormalisation_period == 0) ins.nav.C_bn = strapdown::reorthonormalised(ins.nav.C_bn);
  strapdown::extend(ins.interval, step, imu);
}

bool prediction_is_due(const State& state, const Settings& settings) {
  return state.ins.interval.duration >= settings.longest_interval;
}

void predict(State& state, const Settings& settings) {
  const int repairs = std::visit(
      [&]<int N>(Errors<N>& errors) {
        return predict_errors<N>(errors, state.fixes, state.ins.interval, settings);
      },
      state.errors);
  state.repairs += static_cast<std::uint32_t>(repairs);
  state.ins.interval = Interval{};
}

void propagate(State& state, const strapdown::ImuIncrement& imu, const Settings& settings) {
  mechanise(state, imu);
  if (prediction_is_due(state, settings)) predict(state, settings);
}

UpdateResult update(State& state, const Fix& fix, const Settings& settings) {
  return update(state, position_of(state.ins.nav), fix, settings);
}

UpdateResult update(State& state, const GeodeticPosition& ins, const Fix& fix, const Settings& settings) {
  UpdateResult result;
  if (state.ins.steps == state.updated_at) return result;
  result.outcome = Outcome::non_finite;
  const Vector3d difference = position_difference(ins, fix.position);
  if (!difference.allFinite()) return result;
  return std::visit(
      [&]<int N>(const Errors<N>& errors) {
        return update_errors<N>(state, errors, ins, difference, fix.reported, settings);
      },
      state.errors);
}

}  // namespace canhil::inflight_alignment
