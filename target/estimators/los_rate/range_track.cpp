#include "target/estimators/los_rate/range_track.hpp"

#include <algorithm>
#include <cmath>

namespace canhil::los_rate {
namespace {

bool positive(double value) { return std::isfinite(value) && value > 0; }

Geometry reckoned(Geometry from, double dt) {
  return {std::max(from.range - from.closing_speed * dt, 0.0), from.closing_speed};
}

bool agrees(Geometry measured, Geometry expected, const Settings& settings) {
  return std::abs(measured.range - expected.range) <= settings.range_gate &&
         std::abs(measured.closing_speed - expected.closing_speed) <= settings.closing_speed_gate;
}

Fault judge(RangeTrack& track, const RangeSample& sample, double dt, const Settings& settings) {
  if (!sample.range_valid || !positive(sample.range)) return Fault::range_invalid;
  if (!sample.closing_speed_valid || !positive(sample.closing_speed)) return Fault::closing_speed_invalid;
  const Geometry measured{sample.range, sample.closing_speed};
  track.unchanged_s = sample.range == track.raw.range ? track.unchanged_s + dt : 0;
  const bool consistent = agrees(measured, reckoned(track.raw, dt), settings);
  track.agreeing = consistent ? std::min(track.agreeing + 1, settings.relock_samples) : 0;
  track.raw = measured;
  if (track.unchanged_s > settings.range_unchanged_limit) return Fault::range_stale;
  // A sensor that is slower than this filter repeats its range. So the measured range is extrapolated over
  // the time since this range last changed.
  const Geometry current = reckoned(measured, track.unchanged_s);
  if (track.known && !agrees(current, track.now, settings) && track.agreeing < settings.relock_samples)
    return Fault::range_jump;
  track.now = current;
  track.known = true;
  return Fault::none;
}

}  // namespace

Fault follow(RangeTrack& track, const RangeSample& sample, double dt, const Settings& settings) {
  track.now = reckoned(track.now, dt);
  const Fault fault = judge(track, sample, dt, settings);
  if (fault == Fault::range_invalid || fault == Fault::closing_speed_invalid) track.agreeing = 0;
  return fault;
}

}  // namespace canhil::los_rate
