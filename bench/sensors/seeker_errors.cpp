#include "bench/sensors/seeker_errors.hpp"

#include <algorithm>
#include <cmath>

#include "bench/world/gauss_markov.hpp"

namespace canhil::sensors {
namespace {

using world::GaussMarkov;

Vector3 draw3(const RandomValue& constant, Stream& stream) {
  return Vector3::Constant(constant.value) + constant.sigma * stream.normal3();
}

Planes<double> normals(Stream& stream) {
  const double pitch = stream.normal();
  return {.pitch = pitch, .yaw = stream.normal()};
}

}  // namespace

ErroneousSeeker::ErroneousSeeker(const SeekerErrorModel& model, Stream stream)
    : model_(model), stream_(stream), gyro_bias_(draw3(model.gyro_bias, stream_)) {
  accel_bias_.pitch = draw(model.accel_bias, stream_);
  accel_bias_.yaw = draw(model.accel_bias, stream_);
  range_bias_ = draw(model.range_bias, stream_);
  closing_speed_bias_ = draw(model.closing_speed_bias, stream_);
}

// Glint is a Gauss-Markov process with unit variance; without a correlation time, it is white noise.
Planes<double> ErroneousSeeker::glint(double dt) {
  const bool continues = glinting_ && model_.glint_correlation > 0;
  const GaussMarkov process = continues ? GaussMarkov(dt / model_.glint_correlation) : GaussMarkov::white();
  const Planes<double> n = normals(stream_);
  glint_ = {.pitch = process.next(glint_.pitch, n.pitch), .yaw = process.next(glint_.yaw, n.yaw)};
  glinting_ = true;
  return glint_;
}

SeekerMeasurement ErroneousSeeker::measure(const SeekerTruth& truth) {
  const double dt = 1e-6 * static_cast<double>(truth.interval_us);
  const double thermal_sigma = model_.thermal * truth.range * truth.range;
  const Planes<double> thermal = normals(stream_);
  const Planes<double> scintillation = glint(dt);
  const Planes<double> constant = normals(stream_);
  const Vector3 gyro = stream_.normal3();
  const Planes<double> accel = normals(stream_);
  const double scale = std::min(1.0, truth.range / model_.full_errors_beyond);
  const auto noise = [&](double of_thermal, double of_glint, double of_constant) {
    return thermal_sigma * of_thermal + model_.glint / truth.range * of_glint + model_.constant * of_constant;
  };

  SeekerMeasurement measured{.t_us = truth.t_us, .interval_us = truth.interval_us};
  measured.in_view = std::max(std::abs(truth.error.pitch), std::abs(truth.error.yaw)) <= model_.field_of_view;
  measured.error = {.pitch = truth.error.pitch + noise(thermal.pitch, scintillation.pitch, constant.pitch),
                    .yaw = truth.error.yaw + noise(thermal.yaw, scintillation.yaw, constant.yaw)};
  measured.antenna = truth.delta_theta + dt * (gyro_bias_ + model_.gyro_noise * gyro);
  measured.missile_acceleration = {
      .pitch = truth.mean_acceleration.z() + accel_bias_.pitch + model_.accel_noise * accel.pitch,
      .yaw = truth.mean_acceleration.y() + accel_bias_.yaw + model_.accel_noise * accel.yaw};
  measured.range = truth.range + scale * (range_bias_ + model_.range_noise * stream_.normal());
  measured.closing_speed =
      truth.closing_speed + closing_speed_bias_ + model_.closing_speed_noise * stream_.normal();
  return measured;
}

}  // namespace canhil::sensors
