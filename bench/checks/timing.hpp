// Timing of the target's messages.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "bench/checks/observations.hpp"
#include "bench/scenario/checks.hpp"

namespace canhil::checks {

/// Order statistics of a sample. If the sample is empty, `count` is 0.
struct Distribution {
  std::size_t count = 0;
  double min = 0;
  double p50 = 0;
  double p90 = 0;
  double p99 = 0;
  double p999 = 0;
  double max = 0;
};

/// Nearest-rank quantiles; the maximum is exact.
Distribution distribution(std::vector<double> sample);
/// Like distribution(), for a histogram; the result is in s.
Distribution distribution_s(const Histogram& histogram);

/// Nearest-rank quantile, 0 < q <= 1, of a non-empty sample.
double quantile(std::vector<double> sample, double q);

/// Nearest-rank quantile [s] of the recorded values and `missing` more, which count as larger than all
/// limits. None: the quantile is one of these.
std::optional<double> quantile_s(const Histogram& recorded, double q, std::uint64_t missing);

/// The timing of a message within a window; null: this timing was not recorded.
const TimedWindow* find_window(const TimingRecord& timing, std::string_view message,
                               const scenario::Window& window);

/// True if the controller stamped every answer and every stimulus.
bool stamped_by_hardware(const TimingRecord& timing);

/// The number of missing answers of a message. One answer is due for each stimulus of the groups that the
/// message answers, or one answer in each period if the message keeps its own period.
std::size_t unanswered(const Observations& seen, std::string_view message);
/// How many frames of a message the target owed in a run of `duration_s` with `estimators` estimators: one
/// for each stimulus or, for a message that answers nothing, one for each cycle and estimator. Nullopt: the
/// message has no period.
std::optional<std::uint64_t> due(const Observations& seen, std::string_view message, double duration_s,
                                 std::size_t estimators);

/// `off_s` is the quantile of |period - nominal period| [s], `count` is the number of nominal periods, and
/// `outside` is the number of those that deviate by more than `permitted_s`. A gap of n nominal periods
/// counts n times, because a quantile would ignore a long gap that counts once. `begin_s`, `end_s`: the time
/// from the begin to the first message, and from the last message to the end; each counts as a period if it
/// exceeds the nominal period.
struct PeriodDeviation {
  double off_s = 0;
  std::uint64_t count = 0;
  std::uint64_t outside = 0;
};
PeriodDeviation period_deviation(const Histogram& periods, double nominal_s, double begin_s, double end_s,
                                 double quantile, double permitted_s);

/// The longest time without the given message. The times before the first arrival and after the last arrival
/// count too.
struct Silence {
  std::int64_t from_ns = 0;  ///< when it began, by the stamp clock
  std::int64_t length_ns = 0;
};
Silence longest_silence(const Observations& seen, std::string_view message);

/// The period [s] that a message should have. For an answer, this is the period at which its stimuli were
/// sent or, if that is longer, the minimum interval of its answer group. 0: the answer has stimuli of more
/// than one group. For a message that answers nothing, and for an answer with fewer than two stimuli, this is
/// the cycle time in the DBC.
double nominal_period_s(const Observations& seen, std::string_view message);

/// The time [s] from a message's last arrival in the window to the last stimulus in the window. For a message
/// that answers nothing: the time from the last arrival to the bench's last transmission. 0 or less if the
/// message continued to the end. Requires at least one arrival of the message.
double ended_before_s(const Observations& seen, const TimedWindow& window);

/// The time [s] from the first stimulus in the window to the message's first arrival in the window. For a
/// message that answers nothing: the time from the bench's first transmission. Requires at least one arrival.
double began_after_s(const Observations& seen, const TimedWindow& window);

}  // namespace canhil::checks
