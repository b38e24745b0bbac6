// The evidence that a rule may use.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/checks/estimator.hpp"
#include "bench/checks/finding.hpp"
#include "bench/checks/histogram.hpp"
#include "bench/checks/host.hpp"
#include "bench/checks/observations.hpp"

namespace canhil::checks {

/// Evidence::timing_unfit of a run in virtual time.
inline constexpr std::string_view virtual_time = "virtual time";

struct Evidence {
  const Observations& seen;
  estimators::Truth truth;
  std::span<const estimators::Estimator* const> estimators{};  ///< the estimators whose answers may be judged
  std::string ended_early{};   ///< why the run ended early; empty: it was completed
  std::string timing_unfit{};  ///< why timing cannot be judged; empty: it can be judged
  TargetDelays delays{};
  std::vector<estimators::OwnTrack>
      tracks{};  ///< tracks of the quantities that the rules use; judge() adds these tracks
};

/// An estimator's tracks of a quantity or, if the quantity has parts, of each part. Empty: there is no truth
/// to compare the quantity with.
std::vector<const quantities::Track*> tracks_of(const Evidence& evidence, std::string_view estimator,
                                                const quantities::Quantity& quantity);

/// Why the causes of the answers with a quantity are not certain; empty: they are.
std::string why_uncertain(const Evidence& evidence, std::string_view estimator,
                          const quantities::Quantity& quantity);

/// Why a closed loop of the run is not that of the scenario: the bench was late as a rule, for example
/// because of a slow plant, or lockstep does not wait for the commands; empty: it is, or no loop was closed.
std::string late_loop(const Evidence& evidence);

/// The finding if an estimator has no track of a quantity although there is a truth: the target told no value
/// of the quantity, or not all the values that it is made of.
Finding no_values(const quantities::Quantity& quantity, Expected expected);

/// Returns why a quantile of the timing cannot be compared with the limit `bar_s`; empty: it can be compared.
/// The bench can judge the target's deadlines only if the bench keeps its own deadlines.
std::string unfit(const Evidence& evidence, double quantile, double bar_s);
/// The largest permitted lateness of the bench, as a fraction of the check's limit; the lateness is taken at
/// the quantile of the check. If the lateness was larger, the host may have delayed the target by the same
/// amount. The same fraction holds for the target's wait for a CPU.
inline constexpr double lateness_share = 0.5;

/// If a quantile of the timing exceeds its limit `bar_s`, the reason may be that other programs kept the
/// target waiting for a CPU, or that the host took the CPU away. Returns the finding, unless it is a failure
/// with this excuse: then it is not measured.
Finding unless_target_delayed(const Evidence& evidence, double quantile, double bar_s, Finding finding);

/// The values of a check of a quantile of times.
struct Times {
  double nominal_s = 0;        ///< time from one value to the next; 0: it varies
  std::uint64_t count = 0;     ///< number of values that are due
  std::uint64_t missing = 0;   ///< number of values that did not come; the host does not explain them
  std::uint64_t outside = 0;   ///< number of values that came and are beyond the limit
  const Histogram& bench_off;  ///< how far the bench itself was off, for each stimulus in the window
};
/// Like unless_target_delayed(), for the disturbances of the host together, counted one by one. If the values
/// beyond the limit would be few enough without those that the host can have spoiled, a failure is not
/// measured. If they are too many even so, it stands.
Finding unless_host_disturbed(const Evidence& evidence, double quantile, double bar_s, const Times& times,
                              Finding finding);

/// "max", "99 % quantile".
std::string quantile_name(double quantile);

}  // namespace canhil::checks
