// The motion of a vessel in waves: deep water, long-crested, from one direction. The waves are a sum of
// sinusoids of equal energy from a spectrum of Pierson and Moskowitz or JONSWAP, at drawn frequencies and
// with drawn phases.
//
// With lambda the length of a wave, k = omega^2 / g its wave number and a its amplitude:
//   heave, and the horizontal motion along the waves: a / (1 + (L / lambda)^2), L the vessel's length
//   roll, pitch: the slope k a across and along the vessel, times 1 / (1 - r^2 + 2 i zeta r), r = omega T / 2
//   pi, T the vessel's natural period and zeta its damping ratio.
// The present heading counts for roll and pitch. The change of the frequencies by the vessel's speed is
// neglected.
#pragma once

#include <vector>

#include "bench/world/kinematics.hpp"
#include "bench/world/stream.hpp"

namespace canhil::world {

struct SeaModel {
  double significant_height = 0;  ///< four standard deviations of the surface's elevation [m]
  double peak_period = 8;         ///< period of the spectrum's peak [s]
  double peakedness = 1;          ///< of JONSWAP; 1: Pierson-Moskowitz
  double from = 0;                ///< direction from which the waves come [rad]
  double length = 1;              ///< of the vessel [m]
  double roll_period = 10, roll_damping = 0.1;
  double pitch_period = 6, pitch_damping = 0.3;
};

/// The spectral density of the elevation at omega [rad/s], up to a constant factor: Hasselmann et al. (1973);
/// with peakedness 1, Pierson and Moskowitz (1964).
double wave_spectrum(const SeaModel& model, double omega);

class Sea {
 public:
  Sea(const SeaModel& model, Stream& stream);

  /// Adds the vessel's motion at time t [s] to that of its course.
  void add_to(Kinematics& kinematics, double t) const;
  /// The velocity that add_to() adds, NED [m/s].
  [[nodiscard]] Vector3 velocity(double t) const;
  /// Displacement of the vessel, NED [m].
  [[nodiscard]] Vector3 displacement(double t) const;
  /// The highest frequency [rad/s].
  [[nodiscard]] double highest() const;

 private:
  /// A wave, and the responses to it as multiples of the sine and the cosine of omega t + phase: of roll to a
  /// wave from abeam, of pitch to a wave from ahead or astern.
  struct Wave {
    double omega = 0, phase = 0;
    double displacement = 0;                  ///< [m]
    double roll_sine = 0, roll_cosine = 0;    ///< [rad]
    double pitch_sine = 0, pitch_cosine = 0;  ///< [rad]
  };
  [[nodiscard]] Vector3 in_ned(double along, double up) const;
  double towards_;  // direction of travel [rad]
  std::vector<Wave> waves_;
};

}  // namespace canhil::world
