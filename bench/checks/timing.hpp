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
  double p99 = 0;
  double max = 0;
};

/// Nearest-rank quantiles; the maximum is the true one.
Distribution distribution(std::vector<double> sample);
/// Nearest-rank quantile, 0 < q <= 1, of a non-empty sample.
double quantile(std::vector<double> sample, double q);

/// Latency [s] of every answer of a message within a window: its stamp less that of the last frame of its
/// stimulus.
std::vector<double> latencies_s(const Observations& seen, std::string_view message,
                                const scenario::Window& window);

/// Time [s] between successive arrivals of a message. With a window: of answers to causes within it.
std::vector<double> periods_s(const Observations& seen, std::string_view message,
                              const scenario::Window& window);

/// The period [s] a message should have: that of its stimulus as it was sent, or its cycle time in the DBC.
double nominal_period_s(const Observations& seen, std::string_view message);

/// Whether a message answers a stimulus at all, and so has a latency.
bool answers_a_stimulus(std::string_view message);

}  // namespace canhil::checks
