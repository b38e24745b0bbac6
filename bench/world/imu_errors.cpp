#include "bench/world/imu_errors.hpp"

#include <cmath>

#include "bench/world/mounting.hpp"

namespace canhil::world {

double WarmUp::at(double t) const { return rise == 0 ? start : start + rise * (1 - std::exp(-t / time_s)); }

ErroneousImu::ErroneousImu(const ImuErrorModel& model, const ImuStreams& streams)
    : model_(model),
      streams_(streams),
      gyro_(draw_triad(model.gyro, streams_.errors)),
      accel_(draw_triad(model.accel, streams_.errors)),
      C_bs_(mounted(draw(model.mounting, streams_.constants))) {
  for (int axis = 0; axis < 3; ++axis)
    G_.col(axis) = model.g_sensitivity_sigma * streams_.constants.normal3();
  G_ += Matrix3(model.g_sensitivity.asDiagonal());
}

ImuIncrement ErroneousImu::measure(const ImuIncrement& exact) {
  const double dt = 1e-6 * static_cast<double>(exact.interval_us);
  if (!gyro_.further) {
    gyro_.further.emplace(model_.gyro.stacks, dt, streams_.gyro_drift);
    accel_.further.emplace(model_.accel.stacks, dt, streams_.accel_drift);
  }
  ImuIncrement measured = exact;
  measured.delta_theta = C_bs_ * exact.delta_theta;
  measured.delta_v = C_bs_ * exact.delta_v;
  const double warmer =
      model_.temperature.at(1e-6 * static_cast<double>(exact.t_us)) - model_.temperature.reference;
  measured.delta_theta += G_ * measured.delta_v;
  measured.delta_theta = measure(gyro_, model_.gyro, measured.delta_theta, warmer, dt);
  measured.delta_v = measure(accel_, model_.accel, measured.delta_v, warmer, dt);
  return measured;
}

ErroneousImu::Triad ErroneousImu::draw_triad(const TriadErrorModel& model, Stream& stream) {
  Triad triad;
  triad.bias = draw(model.bias, stream);
  triad.M = draw(model.scale_factor, stream).asDiagonal();
  const Vector3 upper = model.misalignment_sigma * stream.normal3();
  const Vector3 lower = model.misalignment_sigma * stream.normal3() + model.nonorthogonality;
  triad.M(0, 1) = upper(0);
  triad.M(0, 2) = upper(1);
  triad.M(1, 2) = upper(2);
  triad.M(1, 0) = lower(0);
  triad.M(2, 0) = lower(1);
  triad.M(2, 1) = lower(2);
  return triad;
}

Vector3 ErroneousImu::measure(Triad& triad, const TriadErrorModel& model, const Vector3& exact, double warmer,
                              double dt) {
  TriadErrors& further = *triad.further;
  const Vector3 passed = further.is_ideal() ? exact : Vector3(further.lag(exact / dt) * dt);
  Vector3 measured = passed + triad.M * passed + triad.bias * dt +
                     std::sqrt(dt) * model.noise.cwiseProduct(streams_.errors.normal3());
  if (warmer != 0)
    measured += (warmer * model.bias_per_k + warmer * warmer * model.bias_per_k2) * dt +
                warmer * model.scale_per_k.cwiseProduct(passed);
  if (further.is_ideal()) return measured;
  measured += further.wander() * dt;
  return further.given(measured / dt) * dt;
}

}  // namespace canhil::world
