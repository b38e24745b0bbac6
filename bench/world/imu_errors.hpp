// Errors of a strapdown IMU. A measured increment is
//   (I + M) x + (b + b(T) + d) dt + n sqrt(dt),
// limited to the range of the IMU and rounded to its steps. x is the exact increment along the IMU's own axes
// after its low pass; for the gyros, it has the part G f dt of the g-sensitivity. The matrix M contains scale
// factors and misalignments; b is a constant bias, b(T) the part of it that depends on the temperature, d the
// correlated error and the random walk of the error stack, and n white noise.
#pragma once

#include <optional>
#include <string>

#include "bench/world/error_stack.hpp"
#include "bench/world/flight_record.hpp"

namespace canhil::world {

/// The errors of three gyros or of three accelerometers, in the IMU's axes. The unit is rad/s for gyros and
/// m/s^2 for accelerometers.
struct TriadErrorModel {
  RandomConstant bias;  ///< [unit]
  Vector3 noise =
      Vector3::Zero();  ///< density of white noise [unit/sqrt(Hz)]; random walk of its integral per sqrt(s)
  RandomConstant scale_factor;    ///< [-]
  double misalignment_sigma = 0;  ///< of each of the six off-diagonal terms of M [rad]
  /// Given off-diagonal terms of M [rad]: the y axis leans towards x; the z axis towards x; the z axis
  /// towards y. The other three are a rotation of all axes, so they are the IMU's mounting.
  Vector3 nonorthogonality = Vector3::Zero();
  Vector3 bias_per_k = Vector3::Zero();   ///< [unit/K], from the reference temperature on
  Vector3 bias_per_k2 = Vector3::Zero();  ///< [unit/K^2]
  Vector3 scale_per_k = Vector3::Zero();  ///< [1/K]
  TriadErrors::Stacks stacks{};
};

/// The temperature of the IMU: it warms up from the start of the run on.
struct WarmUp {
  static constexpr double room = 25;  ///< [degC]

  double start = room;      ///< [degC]
  double rise = 0;          ///< by which it is warmer in the end [K]
  double time_s = 600;      ///< after which it has risen by 63 %
  double reference = room;  ///< at which the errors are those without temperature [degC]

  /// At the time t [s] of the run [degC].
  [[nodiscard]] double at(double t) const;
};

struct ImuErrorModel {
  TriadErrorModel gyro;
  TriadErrorModel accel;
  /// Rate that the gyros report per specific force along the same axis [rad/s per m/s^2].
  Vector3 g_sensitivity = Vector3::Zero();
  double g_sensitivity_sigma = 0;  ///< of each of the nine terms of G [rad/s per m/s^2]
  RandomConstant mounting;         ///< roll, pitch and yaw of the IMU's axes in the body [rad]
  WarmUp temperature;
};

/// The streams of an IMU's random numbers. Errors of later versions have streams of their own, so that they
/// do not change the numbers of the others.
struct ImuStreams {
  Stream errors;  ///< the constants of both triads, then white noise
  Stream constants;
  Stream gyro_drift, accel_drift;

  /// `make`: makes the stream with a name.
  template <class Make>
  static ImuStreams of(const std::string& name, Make make) {
    return {make(name), make(name + ".constants"), make(name + ".gyro_drift"), make(name + ".accel_drift")};
  }
};

/// The IMU of one run: its constants are drawn on construction.
class ErroneousImu {
 public:
  ErroneousImu(const ImuErrorModel& model, const ImuStreams& streams);

  /// The measurement of one sample, from the increments in body axes. Call once for each sample, in order:
  /// each call takes six numbers from the stream `errors`. All samples have the same interval.
  ImuIncrement measure(const ImuIncrement& exact);

  /// The true biases of this run: [rad/s] and [m/s^2], in the IMU's axes.
  [[nodiscard]] const Vector3& gyro_bias() const { return gyro_.bias; }
  [[nodiscard]] const Vector3& accel_bias() const { return accel_.bias; }
  /// Whether an axis was beyond its range in the latest sample.
  [[nodiscard]] bool gyro_saturated() const { return gyro_.further && gyro_.further->is_saturated(); }
  [[nodiscard]] bool accel_saturated() const { return accel_.further && accel_.further->is_saturated(); }

 private:
  struct Triad {
    Matrix3 M;
    Vector3 bias;
    std::optional<TriadErrors> further{};  // from the first sample on
  };
  static Triad draw_triad(const TriadErrorModel& model, Stream& stream);
  Vector3 measure(Triad& triad, const TriadErrorModel& model, const Vector3& exact, double warmer, double dt);

  ImuErrorModel model_;
  ImuStreams streams_;
  Triad gyro_;
  Triad accel_;
  Matrix3 C_bs_;  // from body axes to the IMU's axes
  Matrix3 G_;     // g-sensitivity
};

}  // namespace canhil::world
