// What the bench knows of an estimator. All of it stands in the estimator's folder (bench/estimators); the
// rest of the bench asks the registry, or is given what it may ask, and knows quantities.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "bench/checks/observations.hpp"
#include "bench/checks/reception.hpp"
#include "bench/checks/results.hpp"
#include "bench/quantities/freshness.hpp"
#include "bench/quantities/samples.hpp"
#include "bench/quantities/track.hpp"
#include "bench/scenario/checks.hpp"
#include "bench/scenario/estimator_facts.hpp"
#include "bench/spool/spool.hpp"
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

/// Answers that say the same of themselves: an outcome, a flag.
struct Mark {
  std::string_view name;
  Spool<std::int64_t> t_us{};  ///< times of their causes, ascending
};

/// A track, and whose it is.
struct OwnTrack {
  std::string_view estimator;
  quantities::Track track;
};

struct Estimator {
  std::string_view name;                                 ///< as in the DBC's value table Estimator
  scenario::EstimatorFacts facts;                        ///< what a scenario has to know
  const quantities::Layout& layout;                      ///< of its samples
  std::span<const quantities::Quantity* const> of_runs;  ///< what its tracks tell
  /// Puts its answers together, for a run.
  std::unique_ptr<Reception> (*reception)() = nullptr;
  /// The samples that a run leaves behind; none where it has no truth to be held against.
  quantities::Samples (*samples)(const checks::Observations& seen, const Truth& truth) = nullptr;
  /// Gives each quantity over a run that has a truth to hold the answers against.
  void (*tracks)(const checks::Observations& seen, const Truth& truth,
                 const quantities::TrackSink& give) = nullptr;
  /// All its marks, with no times where there are none. The first, "answers", is of all answers.
  std::vector<Mark> (*marks)(const checks::Observations& seen) = nullptr;
  /// Of these, beside "answers", those that say nothing of trouble: updates, how the estimator sets out.
  std::span<const std::string_view> plain_marks{};
  /// What people are told of a run. `algorithm`: that the target runs.
  std::vector<ResultLine> (*results)(const checks::Observations& seen, const Truth& truth,
                                     std::string_view algorithm) = nullptr;
  std::span<const std::string_view> closing;  ///< the last message of each group of its answers
  /// The group that keeps an interval of its own where its stimuli come faster: output_interval_ms.
  std::string_view of_own_interval{};
  std::span<const scenario::CheckKind> check_kinds{};               ///< that nobody else can have
  std::span<const scenario::FormerCheckKind> former_check_kinds{};  ///< that only it had
  /// How long they hold, by the rule of the checks (bench/checks/silence.hpp), in runs of a scenario.
  quantities::Freshness (*freshness)(const scenario::Scenario& scenario) = nullptr;
};

/// The tracks of an estimator over a run. Of a flight that is not known they tell no error and no truth, only
/// what was estimated; those that are errors alone are left out.
void give_tracks(const Estimator& of, const checks::Observations& seen, const Truth& truth,
                 const quantities::TrackSink& give);

/// The one of this name; none: null.
const Estimator* find(std::span<const Estimator* const> estimators, std::string_view name);
/// Every quantity that any of these tells, each once, in their order.
std::vector<const quantities::Quantity*> quantities_of(std::span<const Estimator* const> estimators);

}  // namespace canhil::estimators
