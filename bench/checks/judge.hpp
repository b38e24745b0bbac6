// The checks of a scenario against what was seen.
#pragma once

#include <string>

#include "bench/checks/errors.hpp"
#include "bench/checks/observations.hpp"
#include "bench/checks/verdict.hpp"
#include "bench/scenario/scenario.hpp"
#include "bench/world/engagement/engagement.hpp"
#include "bench/world/glide/glide.hpp"

namespace canhil::checks {

/// What the judge may look at.
struct Evidence {
  const Observations& seen;
  const world::FlightRecord& truth;
  const world::GlideRecord* glide = nullptr;            ///< null: not in the scenario
  const world::EngagementRecord* engagement = nullptr;  ///< null: not in the scenario
  std::int64_t duration_us = 0;
  std::string ended_early;   ///< why the run did not come to its end; empty: it did
  std::string timing_unfit;  ///< why timing cannot be judged; empty: it can
};

/// Judges every check of the scenario. A run that ended early fails, whatever its checks say.
Verdict judge(const scenario::Scenario& scenario, const Evidence& evidence);

/// Why no timing of this run can be judged: frames of the target were lost on the way. Empty: it can, as far
/// as the bench kept its own deadlines, which each check asks by its bar.
std::string unfit_for_timing(const Observations& seen);

}  // namespace canhil::checks
