// A flight that was flown, from samples of its velocity and attitude, and of its position if they are there.
//
// Velocity and the quaternion of attitude follow natural cubic splines through the samples, so acceleration
// and angular rate are continuous, follow from the same curve, and integrate back to it: at every sample to
// the recorded velocity and attitude. Not a curve through the positions: a centimetre of their rounding
// would, at 50 Hz, be 25 m/s^2 of acceleration, where a millimetre per second of the velocity's is
// 0.05 m/s^2. So position is the integral of velocity; and lest it drift away from the recorded positions
// over a long flight, velocity is corrected by what the two differ in over times of `averaged_s`: little,
// and so slowly that it is no acceleration to speak of.
//
// The quaternion's components are splined, and the result normalised: of a turn by an angle between two
// samples the error is that of a cubic, in the fourth power of the angle; no Euler angle has a singularity
// or a wrap in it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bench/world/cubic_spline.hpp"
#include "bench/world/earth.hpp"
#include "bench/world/kinematics.hpp"

namespace canhil::world {

/// What was recorded of one instant.
struct RecordedState {
  std::int64_t t_us = 0;
  std::optional<Position> position{};  ///< of all samples or of none
  Vector3 v_eb_n = Vector3::Zero();    ///< [m/s]
  Matrix3 C_bn = Matrix3::Identity();
};

class RecordedPath {
 public:
  static constexpr double averaged_s = 10;

  /// At least two states, in ascending order of time. Without positions `start` is that of the first.
  RecordedPath(std::span<const RecordedState> states, const Position& start);

  [[nodiscard]] Movement movement(double t) const;
  [[nodiscard]] Vector3 velocity(double t) const;
  /// Position at a time [s] within the recording: integrated from the sample before.
  [[nodiscard]] Position position(double t) const;
  /// Times of samples between two times, ends excluded [us].
  [[nodiscard]] std::vector<std::int64_t> samples_between(std::int64_t from_us, std::int64_t to_us) const;
  [[nodiscard]] std::span<const std::int64_t> sample_times_us() const { return t_us_; }

  /// Where positions and velocities contradict each other most.
  struct Contradiction {
    double position = 0;          ///< from where velocity leads, corrected, to the recorded position [m]
    std::size_t position_at = 0;  ///< the sample
    double velocity = 0;          ///< correction of the velocity [m/s]
    std::size_t velocity_at = 0;
  };
  [[nodiscard]] const Contradiction& contradiction() const { return contradiction_; }

 private:
  [[nodiscard]] Position advanced_from(const Position& position, double from, double to) const;
  void integrate(const Position& start);
  void correct(std::span<const RecordedState> states);
  void find_contradiction(std::span<const RecordedState> states);

  std::vector<std::int64_t> t_us_;
  CubicSpline<3> velocity_;
  CubicSpline<4> quaternion_;        // x, y, z, w
  CubicSpline<3> correction_;        // of the position, NED [m]; its rate is that of the velocity
  std::vector<Position> positions_;  // at the samples
  Contradiction contradiction_;
};

struct Recorded {
  std::shared_ptr<const RecordedPath> path;
};

inline Movement movement(const Recorded& motion, double t) { return motion.path->movement(t); }
inline Vector3 velocity(const Recorded& motion, double t) { return motion.path->velocity(t); }

}  // namespace canhil::world
