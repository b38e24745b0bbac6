// The truth of a scenario, shared by all its runs. It is computed once; then several threads may read it. A
// motion that grows (motion/grown.hpp) has a record for each run, which grows with it.
//
// Velocity and attitude are exactly those of the motion (for a recorded motion see motion/recorded.hpp).
// Position is integrated. Rate and specific force follow by inverting the navigation equations in NED, Groves
// (2013), section 5.4:
//   omega_ib_b = omega_nb_b + C_nb (omega_ie_n + omega_en_n)
//   f_ib_b     = C_nb (d(v_eb_n)/dt + (2 omega_ie_n + omega_en_n) x v_eb_n - g_n)
// IMU increments are the integrals of omega_ib_b and f_ib_b over a sample, by Gauss-Legendre quadrature.
#pragma once

#include <cstdint>

#include "bench/world/motion.hpp"
#include "dbc/spool/spool.hpp"

namespace canhil::world {

/// The true state at one instant.
struct Truth {
  std::int64_t t_us = 0;
  Position position;
  Vector3 v_eb_n = Vector3::Zero();  ///< [m/s]
  Matrix3 C_bn = Matrix3::Identity();
  Vector3 omega_ib_b = Vector3::Zero();  ///< [rad/s]
  Vector3 f_ib_b = Vector3::Zero();      ///< [m/s^2]
};

/// One sample of an error-free IMU.
struct ImuIncrement {
  std::int64_t t_us = 0;  ///< end of the interval: the time of validity
  std::int64_t interval_us = 0;
  Vector3 delta_theta = Vector3::Zero();  ///< integral of omega_ib_b [rad]
  Vector3 delta_v = Vector3::Zero();      ///< integral of f_ib_b [m/s]
};

/// The truth on the grid of the IMU, and exact increments between its epochs. Immutable.
class FlightRecord {
 public:
  /// Flies from 0 to the last epoch at or before duration_us. There is an epoch every interval_us.
  /// interval_us must be positive; duration_us may be 0. If the motion grows, the record has its start only.
  FlightRecord(const Flight& flight, std::int64_t duration_us, std::int64_t interval_us);
  /// Flies on to the last epoch at or before the end of the motion; for a motion that grows.
  void follow();

  /// If false, only the initial state is known, so errors cannot be computed.
  [[nodiscard]] bool is_known() const { return !std::holds_alternative<Unknown>(flight_.motion); }

  /// Truth at epochs 0, 1, ...: epoch k is at k * interval_us().
  [[nodiscard]] const Spool<Truth>& epochs() const { return epochs_; }
  /// Increment k covers epoch k to epoch k + 1.
  [[nodiscard]] const Spool<ImuIncrement>& increments() const { return increments_; }
  [[nodiscard]] std::int64_t interval_us() const { return interval_us_; }
  /// Time of the last epoch of the run.
  [[nodiscard]] std::int64_t end_us() const { return end_us_; }
  /// The time up to which the truth is known: end_us(), unless the motion still grows.
  [[nodiscard]] std::int64_t known_until_us() const;
  /// Whether the motion grows during the run.
  [[nodiscard]] bool grows() const { return std::holds_alternative<Grown>(flight_.motion); }

  /// Truth at any time in [0, known_until_us()]. At an epoch, the stored truth is returned; between two
  /// epochs, the truth is integrated from the earlier epoch.
  [[nodiscard]] Truth at(std::int64_t t_us) const;

 private:
  void fly_to(std::int64_t end_us);

  Flight flight_;
  std::int64_t interval_us_, end_us_;
  Position position_;  // at the last epoch
  Spool<Truth> epochs_;
  Spool<ImuIncrement> increments_;
};

}  // namespace canhil::world
