// Errors of a strapdown IMU. A measured increment is (I + M) exact + bias dt + n sqrt(dt), where the matrix M
// contains scale factors and misalignments, and n is white noise.
#pragma once

#include "bench/world/flight_record.hpp"
#include "bench/world/stream.hpp"

namespace canhil::world {

/// The errors of three gyros or of three accelerometers, in body axes. The unit is rad/s for gyros and m/s^2
/// for accelerometers.
struct TriadErrorModel {
  RandomConstant bias;  ///< [unit]
  Vector3 noise =
      Vector3::Zero();  ///< density of white noise [unit/sqrt(Hz)]; random walk of its integral per sqrt(s)
  RandomConstant scale_factor;    ///< [-]
  double misalignment_sigma = 0;  ///< of each of the six off-diagonal terms of M [rad]
};

struct ImuErrorModel {
  TriadErrorModel gyro;
  TriadErrorModel accel;
};

/// The IMU of one run: its constants are drawn on construction.
class ErroneousImu {
 public:
  ErroneousImu(const ImuErrorModel& model, Stream stream);

  /// The measurement of one sample. Call once for each sample, in order: each call takes six numbers from the
  /// stream.
  ImuIncrement measure(const ImuIncrement& exact);

  /// The true biases of this run: [rad/s] and [m/s^2], body axes.
  [[nodiscard]] const Vector3& gyro_bias() const { return gyro_.bias; }
  [[nodiscard]] const Vector3& accel_bias() const { return accel_.bias; }

 private:
  struct Triad {
    Matrix3 M;
    Vector3 bias;
    Vector3 noise;
  };
  static Triad draw_triad(const TriadErrorModel& model, Stream& stream);
  Vector3 measure(const Triad& triad, const Vector3& exact, double dt);

  Stream stream_;
  Triad gyro_;
  Triad accel_;
};

}  // namespace canhil::world
