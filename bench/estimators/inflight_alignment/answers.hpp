// Answers of an in-flight alignment: its navigation, and the outcome of each fix.
#pragma once

#include <memory>
#include <string>

#include "bench/estimators/navigation.hpp"

namespace canhil::estimators {

/// The message group FixFilter: the outcome of an SSBL or GPS fix, and the state of the filter after this
/// fix. Units: SI, angles in rad.
struct FixAnswer {
  std::int64_t cause_us = 0;
  std::int64_t navigation_us = -1;  ///< latest cause of the navigation answers before this one; -1: none
  messages::FixSource source = messages::FixSource::ssbl;
  messages::FixOutcome outcome = messages::FixOutcome::accepted;
  double nis = 0;
  world::Vector3 innovation = world::Vector3::Zero();      ///< NED [m]
  world::Position position{};                              ///< at the time of validity of the fix
  world::Vector3 attitude_sigma = world::Vector3::Zero();  ///< sigmas of the misalignment, NED
  world::Vector3 velocity_sigma = world::Vector3::Zero();  ///< NED
  world::Vector3 position_sigma = world::Vector3::Zero();  ///< NED [m]
  world::Vector3 gyro_bias = world::Vector3::Zero();       ///< body
  world::Vector3 accel_bias = world::Vector3::Zero();      ///< body
  world::Vector3 fix_bias = world::Vector3::Zero();        ///< NED [m]
  world::Vector3 fix_bias_sigma = world::Vector3::Zero();  ///< NED [m]
  bool degraded = false;      ///< the target reports that its sigmas are not valid
  bool handed_over = false;   ///< the heading is resolved and fed back to the INS
  std::uint32_t repairs = 0;  ///< number of covariance repairs since start
  bool repaired = false;      ///< `repairs` differs from that of the answer that arrived before
  std::uint32_t gated = 0;    ///< fixes rejected by the gate, since start
  std::uint32_t refused = 0;  ///< fixes not used for another reason, since start
};

/// True if the filter used the fix.
constexpr bool used(messages::FixOutcome outcome) {
  return outcome == messages::FixOutcome::accepted || outcome == messages::FixOutcome::recovered;
}

/// A fix that the bench sent and that must be answered.
struct SentFix {
  messages::FixSource source = messages::FixSource::ssbl;
  std::int64_t valid_us = 0;
};

struct InflightAnswers {
  NavigationAnswers navigation;
  InOrderOfCause<FixAnswer> fixes;
  Spool<SentFix> sent;
};

/// Describes the first place in a window where more than two successive fixes of a source (tolerated_fixes)
/// were not answered; empty: none.
std::string unanswered_fixes(const InflightAnswers& answers, const scenario::Window& window);

/// Whether the position in an answer has a known time, and a truth at that time. It has both if the filter
/// used or gated the fix, and if the fix's time of validity lies within the record.
bool has_time_and_truth(const FixAnswer& answer, const world::FlightRecord& truth);
/// The position error, NED [m].
world::Vector3 position_error(const FixAnswer& answer, const world::FlightRecord& truth);
std::unique_ptr<Reception> inflight_reception();

}  // namespace canhil::estimators
