// What the bench knows of an estimator. All of it stands in the estimator's folder; the rest of the bench
// asks the registry and knows quantities.
#pragma once

#include <span>
#include <string_view>

#include "bench/checks/observations.hpp"
#include "bench/quantities/freshness.hpp"
#include "bench/quantities/samples.hpp"
#include "bench/quantities/track.hpp"
#include "bench/world/engagement/engagement.hpp"
#include "bench/world/flight_record.hpp"
#include "bench/world/glide/glide.hpp"

namespace canhil::scenario {
struct Scenario;
}

namespace canhil::estimators {

/// What answers are held against.
struct Truth {
  const world::FlightRecord& flight;
  std::int64_t duration_us = 0;                         ///< of the run
  const world::EngagementRecord* engagement = nullptr;  ///< null: not flown
  const world::GlideRecord* glide = nullptr;            ///< null: not flown
};

struct Estimator {
  std::string_view name;                                       ///< as in the DBC's value table Estimator
  const quantities::Layout& layout;                            ///< of its samples
  std::span<const quantities::Quantity* const> of_runs_alone;  ///< what tracks tell and samples do not
  /// The samples that a run leaves behind; none where it has no truth to be held against.
  quantities::Samples (*samples)(const checks::Observations& seen, const Truth& truth) = nullptr;
  /// Gives each quantity over a run that has a truth to hold the answers against.
  void (*tracks)(const checks::Observations& seen, const Truth& truth,
                 const quantities::TrackSink& give) = nullptr;
  /// How long they hold, by the rule of the checks (bench/checks/silence.hpp), in runs of a scenario.
  quantities::Freshness (*freshness)(const scenario::Scenario& scenario) = nullptr;
};

/// All of them. Of several in one scenario a campaign keeps the samples of the last.
std::span<const Estimator* const> all();
/// None: null.
const Estimator* find(std::string_view name);
/// Whose samples have these columns (quantities::names); none: null.
const Estimator* telling(std::string_view columns);
/// Whose samples a campaign keeps of a scenario.
const Estimator& of(const scenario::Scenario& scenario);
/// Every quantity that any of them tells, each once, in the order of the registry.
std::span<const quantities::Quantity* const> every_quantity();

}  // namespace canhil::estimators
