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

/// The filter stops at `range` [m], above or below 1710 m, where thermal noise and glint are equal. Unequal
/// noises in the planes require two gain sets.
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
