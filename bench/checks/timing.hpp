// When the target's messages came.
#pragma once

#include <string_view>
#include <vector>

#include "bench/checks/observations.hpp"
#include "bench/scenario/checks.hpp"

namespace canhil::checks {

/// What an answer of this cause answers; null: nothing that the bench sent.
const Stimulus* find_stimulus(const Observations& seen, std::string_view group, std::int64_t valid_us);

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

/// Time [s] from one stamp to a later one: by the controller's clock where it stamped both.
template <class From, class To>
double elapsed_s(const From& from, const To& to) {
  const bool hardware = from.hardware_ns != 0 && to.hardware_ns != 0;
  return static_cast<double>(hardware ? to.hardware_ns - from.hardware_ns : to.t_ns - from.t_ns) * 1e-9;
}

/// True if the controller stamped every answer and every stimulus.
bool stamped_by_hardware(const Observations& seen);

/// Latency [s] of every answer of a message within a window: its stamp less that of the last frame of its
/// stimulus.
std::vector<double> latencies_s(const Observations& seen, std::string_view message,
                                const scenario::Window& window);

/// How many answers of a message never came: one is due to each stimulus of its groups, or one in each
/// period where the message keeps a period of its own.
std::size_t unanswered(const Observations& seen, std::string_view message);

/// Time [s] between successive arrivals of a message: of answers, to causes within the window.
std::vector<double> periods_s(const Observations& seen, std::string_view message,
                              const scenario::Window& window);

/// How far [s] the bench was off the period of what a message answers: by stimulus within the window, the
/// time between two on the bus less that between their deadlines; one in whose place several were due counts
/// as many times.
std::vector<double> stimulus_deviations_s(const Observations& seen, std::string_view message,
                                          const scenario::Window& window);

/// The longest time [s] without a message, the beginning and the end of the run included.
double longest_silence_s(const Observations& seen, std::string_view message);

/// The period [s] a message should have: that of its stimulus as it was sent, or its cycle time in the DBC;
/// 0: none, as it answers groups of several rhythms.
double nominal_period_s(const Observations& seen, std::string_view message);

/// How much later [s] than its stimuli within the window a message ended: from its last arrival to the last
/// stimulus; infinite without any arrival, 0 or less for a message that went on to the end.
double ended_before_s(const Observations& seen, std::string_view message, const scenario::Window& window);

}  // namespace canhil::checks
