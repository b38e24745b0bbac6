// When the target's messages came.
#pragma once

#include <string_view>
#include <vector>

#include "bench/checks/observations.hpp"
#include "bench/scenario/checks.hpp"

namespace canhil::checks {

/// Order statistics of a sample. Empty sample: count 0.
struct Distribution {
  std::size_t count = 0;
  double min = 0;
  double p50 = 0;
  double p90 = 0;
  double p99 = 0;
  double p999 = 0;
  double max = 0;
};

/// Nearest-rank quantiles; the maximum is the true one.
Distribution distribution(std::vector<double> sample);
/// Of a histogram, in s.
Distribution distribution_s(const Histogram& histogram);

/// Nearest-rank quantile, 0 < q <= 1, of a non-empty sample.
double quantile(std::vector<double> sample, double q);

/// The timing of a message within a window; null: none was taken.
const TimedWindow* find_window(const TimingRecord& timing, std::string_view message,
                               const scenario::Window& window);

/// True if the controller stamped every answer and every stimulus.
bool stamped_by_hardware(const TimingRecord& timing);

/// How many answers of a message never came: one is due to each stimulus of its groups, or one in each
/// period where the message keeps a period of its own.
std::size_t unanswered(const Observations& seen, std::string_view message);

/// The quantile of |period - nominal| [s], and of how many periods. A gap in which n messages were missing
/// counts n times, or a quantile would pass over a long one; `end_s`, the time without a message up to the
/// end, counts where it is longer than the period.
struct PeriodDeviation {
  double off_s = 0;
  std::uint64_t count = 0;
};
PeriodDeviation period_deviation(const Histogram& periods, double nominal_s, double end_s, double quantile);

/// The longest time [s] without a message, the beginning and the end of the run included.
double longest_silence_s(const Observations& seen, std::string_view message);

/// The period [s] a message should have: that of its stimulus as it was sent, or the interval that its group
/// keeps if that is longer; its cycle time in the DBC if it answers nothing; 0: none, as it answers groups of
/// several rhythms.
double nominal_period_s(const Observations& seen, std::string_view message);

/// How much later [s] than its stimuli within the window a message ended: from its last arrival to the last
/// stimulus; 0 or less for a message that went on to the end. Of a message that came.
double ended_before_s(const Observations& seen, const TimedWindow& window);

}  // namespace canhil::checks
