// Oscillations on top of a built-in motion: sums of sinusoids, so that the truth contains their exact
// derivatives. The phases are drawn once for all runs, because the runs share the truth.
//
// Vibration is a velocity u(t) in the body axes of the motion below, whose derivative is the given specific
// force, and a rotation vector theta(t) that follows the attitude: v += C_bn u, C_bn *= exp([theta x]).
// The sea (sea.hpp) adds a velocity in NED, and roll and pitch.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "bench/world/motion.hpp"
#include "bench/world/motion/sea.hpp"

namespace canhil::world {

/// A vibration of one frequency.
struct Sinusoid {
  double frequency = 0;                    ///< [Hz]
  Vector3 acceleration = Vector3::Zero();  ///< amplitudes, body axes [m/s^2]
  Vector3 angle = Vector3::Zero();         ///< amplitudes about the body axes [rad]
  std::optional<Vector3> phase{};          ///< of acceleration and angle, for each axis [rad]; none: drawn
};

/// Random vibration of a constant power spectral density, as a sum of sinusoids: one in each of `lines` equal
/// bands, at a drawn frequency within its band and with drawn phases.
struct RandomVibration {
  double from = 0, to = 0;        ///< [Hz]
  Vector3 psd = Vector3::Zero();  ///< one-sided, body axes [(m/s^2)^2/Hz]
  std::int64_t lines = 1;
};

struct OscillationModel {
  std::vector<Sinusoid> sinusoids{};
  std::vector<RandomVibration> random{};
  std::optional<SeaModel> sea{};
};

/// Highest frequency of a vibration [Hz]: the truth of a sample is integrated in pieces of an eighth of its
/// period.
inline constexpr double highest_vibration = 2000;

/// The flight with its oscillations, drawn from the seed. With a sea, the given start is the mean position,
/// and the flight starts at the vessel's displaced position. The motion must be built in.
Flight drawn(const Flight& flight, std::uint64_t seed);

/// A built-in motion with drawn oscillations.
class Oscillation {
 public:
  Oscillation(BuiltInMotion base, const OscillationModel& model, std::uint64_t seed);

  [[nodiscard]] Movement movement(double t) const;
  [[nodiscard]] Vector3 velocity(double t) const;
  /// Displacement by the sea, NED [m].
  [[nodiscard]] Vector3 displacement(double t) const;
  /// The jumps of the motion below, and times that divide the interval into pieces of at most an eighth of
  /// the shortest period. The quadrature's relative error for a sinusoid is then 4e-14 of its amplitude.
  [[nodiscard]] std::vector<std::int64_t> jumps_us(std::int64_t from_us, std::int64_t to_us) const;

 private:
  /// One frequency of the vibration: u = sine sin(omega t) + cosine cos(omega t), theta likewise.
  struct Line {
    double omega = 0;  ///< [rad/s]
    Vector3 sine = Vector3::Zero(), cosine = Vector3::Zero();
    Vector3 angle_sine = Vector3::Zero(), angle_cosine = Vector3::Zero();
  };
  void add(double frequency, const Vector3& acceleration, const Vector3& angle, const Vector3& phase);
  /// The motion with the sea, without vibration.
  [[nodiscard]] Kinematics kinematics(double t) const;

  BuiltInMotion base_;
  std::vector<Line> lines_;
  std::optional<Sea> sea_;
  std::int64_t piece_us_ = 0;  // 0: an interval is not divided
};

}  // namespace canhil::world
