#pragma once
// Checks range and closing speed of each sample, and extrapolates the last accepted values while the samples
// are implausible.
#include <cstdint>

#include "target/estimators/los_rate/covariance.hpp"
#include "target/estimators/los_rate/settings.hpp"

namespace canhil::los_rate {

/// The reason why a sample, or a part of it, was not used.
enum class Fault : std::uint8_t {
  none,
  error_angle,           // invalid or not finite
  field_of_view,         // error angle beyond the field of view
  antenna,               // antenna or roll increment missing, or interpolated over lost samples
  acceleration,          // missile acceleration missing
  range_invalid,         // flagged, not finite, zero or negative
  range_stale,           // unchanged for too long
  range_jump,            // far from the extrapolation of the last range and closing speed
  closing_speed_invalid  // flagged, not finite, zero or negative
};

/// Range [m] and closing speed [m/s] from a sensor.
struct RangeSample {
  double range = 0, closing_speed = 0;
  bool range_valid = false, closing_speed_valid = false;
};

/// The accepted range and closing speed, and what the checks need to know about earlier samples.
struct RangeTrack {
  Geometry now;            // the current estimate
  Geometry raw;            // the last sample that was finite and positive
  double unchanged_s = 0;  // time since the raw range changed
  int agreeing = 0;        // raw samples in a row that agree with one another
  bool known = false;
};

/// Processes one sample, dt [s] after the last. Accepts a plausible sample; otherwise extrapolates by
/// range -= vc dt and returns the fault. Samples that contradict the track are also accepted, as soon as
/// enough of them (relock_samples) agree with one another.
Fault follow(RangeTrack& track, const RangeSample& sample, double dt, const Settings& settings);

}  // namespace canhil::los_rate
