// A recorded flight, from samples of velocity and attitude, and of position if available.
//
// Velocity and the attitude quaternion are natural cubic splines through the samples. So acceleration and
// angular rate are continuous, and they integrate back to the recorded velocity and attitude at every sample.
// Position is the integral of velocity. A spline through recorded positions would be worse: at 50 Hz,
// positions rounded to a centimetre cause acceleration errors of 25 m/s^2, but velocities rounded to a
// millimetre per second cause acceleration errors of only 0.05 m/s^2. Over a long flight, the integrated
// positions would drift away from the recorded positions. Therefore the differences between the two are
// averaged over stretches of about `averaged_s`, and the rate of change of the averages is added to the
// velocity. The additional acceleration is negligible.
//
// The components of the quaternion are interpolated by splines, and the result is normalised. The
// interpolation error is of fourth order in the rotation angle between two samples. Unlike Euler angles, the
// quaternion has no singularity and no wrap.
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

/// The recorded state at one instant.
struct RecordedState {
  std::int64_t t_us = 0;
  std::optional<Position> position{};  ///< given for all samples or for none
  Vector3 v_eb_n = Vector3::Zero();    ///< [m/s]
  Matrix3 C_bn = Matrix3::Identity();
};

class RecordedPath {
 public:
  static constexpr double averaged_s = 10;

  /// There must be at least two states, in ascending order of time. If the states have no positions, `start`
  /// is the position of the first state.
  RecordedPath(std::span<const RecordedState> states, const Position& start);

  [[nodiscard]] Movement movement(double t) const;
  [[nodiscard]] Vector3 velocity(double t) const;
  /// The position at a time [s] within the recording, integrated from the last sample before this time.
  [[nodiscard]] Position position(double t) const;
  /// Times of samples between two times, ends excluded [us].
  [[nodiscard]] std::vector<std::int64_t> samples_between(std::int64_t from_us, std::int64_t to_us) const;
  [[nodiscard]] std::span<const std::int64_t> sample_times_us() const { return t_us_; }

  /// The largest contradictions between recorded positions and velocities.
  struct Contradiction {
    double position = 0;          ///< integral of the corrected velocity minus recorded position [m]
    std::size_t position_at = 0;  ///< the sample where it occurs
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
  CubicSpline<3> correction_;        // position correction, NED [m]; its rate corrects the velocity
  std::vector<Position> positions_;  // at the samples
  Contradiction contradiction_;
};

struct Recorded {
  std::shared_ptr<const RecordedPath> path;
};

inline Movement movement(const Recorded& motion, double t) { return motion.path->movement(t); }
inline Vector3 velocity(const Recorded& motion, double t) { return motion.path->velocity(t); }

}  // namespace canhil::world
