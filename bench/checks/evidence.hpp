// The evidence that a rule may use.
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
  std::string ended_early{};   ///< why the run did not come to its end; empty: it did
  std::string timing_unfit{};  ///< why timing cannot be judged; empty: it can
  std::vector<estimators::OwnTrack>
      tracks{};  ///< of the quantities that the rules ask for; judge() fills them in
};

/// The tracks of a quantity, or of each of its parts, of an estimator; empty: there is no truth to compare
/// with.
std::vector<const quantities::Track*> tracks_of(const Evidence& evidence, std::string_view estimator,
                                                const quantities::Quantity& quantity);

/// Why timing with a bar [s] at a quantile cannot be judged; empty: it can. The bench must keep its own
/// deadlines to judge those of the target.
std::string unfit(const Evidence& evidence, double quantile, double bar_s);
/// The largest permitted lateness of the bench, as a fraction of the bar and at the bar's quantile. Beyond
/// it, the host may have delayed the target as much.
inline constexpr double lateness_share = 0.5;

/// "max", "99 % quantile".
std::string quantile_name(double quantile);

}  // namespace canhil::checks
