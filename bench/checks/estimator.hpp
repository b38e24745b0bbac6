// The bench's interface to an estimator. The implementation is in the estimator's folder (bench/estimators);
// the rest of the bench uses this interface and handles only quantities.
#pragma once

#include <cstddef>
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
#include "bench/world/flight_record.hpp"
#include "bench/world/truth_values.hpp"
#include "dbc/spool/spool.hpp"

namespace canhil::scenario {
struct Scenario;
}

namespace canhil::estimators {

/// The truth that answers are compared with.
struct Truth {
  const world::FlightRecord& flight;
  std::int64_t duration_us = 0;  ///< duration of the run
  world::PlantRecords plants{};  ///< but for those whose sensors are recorded
};
/// The true values of a run.
world::Truths truths_of(const Truth& truth);

/// Answers that report the same outcome or flag.
struct Mark {
  std::string_view name;
  /// The mark that has the times of all answers which could report this one; empty: there is no such mark.
  std::string_view among = "answers";
  Spool<std::int64_t> t_us{};  ///< times of their causes, ascending
};

/// Passes on, for each answer that could report a mark, whether it did. `all`, `set`: their times, ascending;
/// each time in `set` is one in `all`.
template <class Give>
void each_state(const Spool<std::int64_t>& all, const Spool<std::int64_t>& set, const Give& give) {
  auto next = set.begin();
  for (const std::int64_t t_us : all) {
    const bool is_set = next != set.end() && *next == t_us;
    if (is_set) ++next;
    give(t_us, is_set);
  }
}

/// A track and its estimator.
struct OwnTrack {
  std::string_view estimator;
  quantities::Track track;
};

template <class Signature>
class OfEstimator;

/// A function of an estimator: a plain function, or one with a context, if many estimators share the
/// function. Constant-initialised, unlike std::function, so that the registry may be used before main().
template <class Returned, class... Arguments>
class OfEstimator<Returned(Arguments...)> {
 public:
  using Plain = Returned (*)(Arguments...);
  using WithContext = Returned (*)(const void* context, Arguments...);

  constexpr OfEstimator() = default;
  // NOLINTBEGIN(google-explicit-constructor): the tables of the estimators name plain functions
  constexpr OfEstimator(std::nullptr_t /*none*/) {}
  constexpr OfEstimator(Plain function) : plain_(function) {}
  // NOLINTEND(google-explicit-constructor)
  /// `context` must outlive this object.
  constexpr OfEstimator(WithContext function, const void* context)
      : with_context_(function), context_(context) {}

  Returned operator()(Arguments... arguments) const {
    return plain_ != nullptr ? plain_(arguments...) : with_context_(context_, arguments...);
  }
  friend constexpr bool operator==(const OfEstimator& of, std::nullptr_t /*none*/) {
    return of.plain_ == nullptr && of.with_context_ == nullptr;
  }

 private:
  Plain plain_ = nullptr;
  WithContext with_context_ = nullptr;
  const void* context_ = nullptr;
};

struct Estimator {
  std::string_view name;                                 ///< as in the DBC's value table Estimator
  scenario::EstimatorFacts facts;                        ///< facts that a scenario needs
  const quantities::Layout& layout;                      ///< layout of its campaign samples
  std::span<const quantities::Quantity* const> of_runs;  ///< quantities of its tracks in a run
  /// Creates the object that assembles the estimator's answers during a run.
  OfEstimator<std::unique_ptr<Reception>()> reception;
  /// The samples that a run contributes to a campaign; empty if there is no truth.
  OfEstimator<quantities::Samples(const checks::Observations& seen, const Truth& truth)> samples;
  /// Passes the tracks of the run to `give`. Passes none if the estimator observes a plant
  /// that is not in `truth`.
  OfEstimator<void(const checks::Observations& seen, const Truth& truth, const quantities::TrackSink& give)>
      tracks;
  /// All marks of the estimator, including marks that never occurred; these have no times. The first mark,
  /// "answers", has a time for each answer.
  OfEstimator<std::vector<Mark>(const checks::Observations& seen)> marks;
  /// Marks that report normal events, such as an update or the start of the estimator. "answers" is not
  /// listed.
  std::span<const std::string_view> plain_marks{};
  /// The results of a run, as lines for people. `algorithm`: the algorithm that the target runs.
  OfEstimator<std::vector<ResultLine>(const checks::Observations& seen, const Truth& truth,
                                      std::string_view algorithm)>
      results;
  /// Why a scenario has no truth of a quantity; empty: it has one. Null: the facts decide
  /// (scenario::why_no_truth()).
  OfEstimator<std::string(const scenario::Scenario& scenario, const quantities::Quantity& quantity)>
      why_no_truth{};
  /// Why the causes of the answers with a quantity are not certain; empty: they are. Null: each answer names
  /// its cause.
  OfEstimator<std::string(const checks::Observations& seen, const quantities::Quantity& quantity)>
      ambiguous{};
  std::span<const std::string_view> closing;  ///< the last message of each answer group of the estimator
  /// The messages of `closing` whose answers contain a quantity. Null: all answers contain it.
  OfEstimator<std::vector<std::string_view>(const quantities::Quantity& quantity)> closing_with{};
  /// The answer group for which the target keeps a minimum interval (output_interval_ms) if the stimuli come
  /// faster; empty: there is no such group.
  std::string_view of_own_interval{};
  std::span<const scenario::CheckKind> check_kinds{};  ///< checks that exist for this estimator only
  /// How long the estimator's answers stay valid in runs of a scenario, by the rule that the checks use
  /// (bench/checks/silence.hpp).
  OfEstimator<quantities::Freshness(const scenario::Scenario& scenario)> freshness;
};

/// Passes the tracks of an estimator over a run to `give`. If the truth of the flight is unknown, the tracks
/// contain no errors, and tracks that would contain only errors are left out.
void give_tracks(const Estimator& of, const checks::Observations& seen, const Truth& truth,
                 const quantities::TrackSink& give);

/// The estimator of this name, or null.
const Estimator* find(std::span<const Estimator* const> estimators, std::string_view name);
/// Every quantity that any of these estimators reports, without duplicates, in the order of the estimators.
std::vector<const quantities::Quantity*> quantities_of(std::span<const Estimator* const> estimators);

}  // namespace canhil::estimators
