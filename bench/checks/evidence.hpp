// What a rule may look at.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/checks/estimator.hpp"
#include "bench/checks/observations.hpp"

namespace canhil::checks {

struct Evidence {
  const Observations& seen;
  estimators::Truth truth;
  std::span<const estimators::Estimator* const> estimators{};  ///< whose answers may be judged
  std::string ended_early{};                   ///< why the run did not come to its end; empty: it did
  std::string timing_unfit{};                  ///< why timing cannot be judged; empty: it can
  std::vector<estimators::OwnTrack> tracks{};  ///< of what the rules look at; judge() puts them in
};

/// Tracks of a quantity, or of each of its parts, as an estimator told it; empty: it has no truth to be held
/// against.
std::vector<const quantities::Track*> tracks_of(const Evidence& evidence, std::string_view estimator,
                                                const quantities::Quantity& quantity);

/// Why timing with a bar [s] that is judged at a quantile cannot be judged; empty: it can. The bench must
/// keep its own deadlines to judge those of the target.
std::string unfit(const Evidence& evidence, double quantile, double bar_s);
/// A host that keeps the bench waiting for more than this share of a bar, as often as the bar is judged for,
/// may keep the target waiting just as long.
inline constexpr double lateness_share = 0.5;

/// "max", "99 % quantile".
std::string quantile_name(double quantile);

}  // namespace canhil::checks
