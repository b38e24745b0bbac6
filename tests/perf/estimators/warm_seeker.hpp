#pragma once
// A LOS-rate filter in mid-flight, past its start-up, ready for one more sample.
#include "target/estimators/los_rate/filter.hpp"
#include "tests/unit/target/estimators/los_rate/engagement.hpp"

namespace canhil::los_rate {

struct WarmSeeker {
  Design design;
  State state;
  Measurement measurement;
};

/// The filter processes samples until the range has decreased to `range` [m]. Above 1710 m, thermal noise is
/// larger than glint; below 1710 m, glint is larger. If `equal` is false, the noise differs in the two
/// planes, so the filter needs two sets of gains.
inline WarmSeeker warm_seeker(Algorithm algorithm, double range = 2000, bool equal = true) {
  EngagementSetup setup;
  setup.settings.algorithm = algorithm;
  if (!equal) setup.settings.noise.yaw.glint *= 1.5;
  setup.noisy = true;
  setup.roll_rate = 0.5;
  WarmSeeker seeker{make_design(setup.settings), initial(), {}};
  Engagement engagement(setup);
  do {
    seeker.measurement = engagement.next();
    if (engagement.truth().range > range) step(seeker.state, seeker.measurement, seeker.design);
  } while (engagement.truth().range > range);
  return seeker;
}

}  // namespace canhil::los_rate
