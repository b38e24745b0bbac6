#include "bench/world/imu_errors.hpp"

#include <cmath>

namespace canhil::world {

ErroneousImu::ErroneousImu(const ImuErrorModel& model, Stream stream)
    : stream_(stream), gyro_(draw_triad(model.gyro, stream_)), accel_(draw_triad(model.accel, stream_)) {}

ImuIncrement ErroneousImu::measure(const ImuIncrement& exact) {
  const double dt = 1e-6 * static_cast<double>(exact.interval_us);
  ImuIncrement measured = exact;
  measured.delta_theta = measure(gyro_, exact.delta_theta, dt);
  measured.delta_v = measure(accel_, exact.delta_v, dt);
  return measured;
}

ErroneousImu::Triad ErroneousImu::draw_triad(const TriadErrorModel& model, Stream& stream) {
  Triad triad;
  triad.bias = draw(model.bias, stream);
  triad.noise = model.noise;
  triad.M = draw(model.scale_factor, stream).asDiagonal();
  const Vector3 upper = model.misalignment_sigma * stream.normal3();
  const Vector3 lower = model.misalignment_sigma * stream.normal3();
  triad.M(0, 1) = upper(0);
  triad.M(0, 2) = upper(1);
  triad.M(1, 2) = upper(2);
  triad.M(1, 0) = lower(0);
  triad.M(2, 0) = lower(1);
  triad.M(2, 1) = lower(2);
  return triad;
}

Vector3 ErroneousImu::measure(const Triad& triad, const Vector3& exact, double dt) {
  return exact + triad.M * exact + triad.bias * dt +
         std::sqrt(dt) * triad.noise.cwiseProduct(stream_.normal3());
}

}  // namespace canhil::world
