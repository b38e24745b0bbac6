// What got worse from some runs of a scenario to others.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "dbc/wire/result.hpp"

namespace canhil::report {

/// What must hold, all of it, for a latency to count as worse.
struct Bars {
  double p = 0.01;      ///< of a test, divided by the number of tests
  double least_us = 2;  ///< p50, or p99, later by more than two stamps differ
  // Of one run a side, which does not show how much runs differ:
  double effect = 0.64;    ///< at least: a 'medium' one of Vargha and Delaney (2000)
  double tail_times = 2;   ///< so many times as many beyond the 99 % quantile
  double least_share = 1;  ///< p50, or p99, later by more than this share of it
};

enum class Comparison : std::uint8_t { no_worse, worse, not_comparable };

struct Compared {
  Comparison outcome = Comparison::no_worse;
  std::string text;  ///< a line for each thing compared, the last one the outcome
};

using Reports = std::vector<nlohmann::ordered_json>;

/// Compares reports as document() makes them, `after` against `before`, one at least on each side. Error: one
/// line, what a report lacks or has that is not known.
Result<Compared> compare(const Reports& before, const Reports& after, const Bars& bars = {});

}  // namespace canhil::report
