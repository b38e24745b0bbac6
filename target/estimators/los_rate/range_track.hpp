#pragma once
// Judges range and closing speed sample by sample and reckons on where they cannot be believed.
#include <cstdint>

#include "target/estimators/los_rate/covariance.hpp"
#include "target/estimators/los_rate/settings.hpp"

namespace canhil::los_rate {

/// What was wrong with a sample.
enum class Fault : std::uint8_t {
  none,
  error_angle,           // invalid or not finite
  field_of_view,         // error angle beyond the field of view
  antenna,               // antenna or roll increment missing, or bridged over lost samples
  acceleration,          // missile acceleration missing
  range_invalid,         // flagged, not finite, zero or negative
  range_stale,           // unchanged for too long
  range_jump,            // off what the last range and closing speed lead to
  closing_speed_invalid  // flagged, not finite, zero or negative
};

/// Range [m] and closing speed [m/s] as a sensor gave them.
struct RangeSample {
  double range = 0, closing_speed = 0;
  bool range_valid = false, closing_speed_valid = false;
};

struct RangeTrack {
  Geometry now;            // believed
  Geometry raw;            // the last sample that was finite and positive
  double unchanged_s = 0;  // for how long the raw range has been the same
  int agreeing = 0;        // raw samples in a row that agree with one another
  bool known = false;
};

/// One sample, dt [s] after the last: believed, or the track reckons on with range -= vc dt and the fault is
/// named. Samples that contradict the track but agree with one another are believed in the end
/// (relock_samples).
Fault follow(RangeTrack& track, const RangeSample& sample, double dt, const Settings& settings);

}  // namespace canhil::los_rate
