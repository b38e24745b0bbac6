// A judgement in numbers: what a check limits, and what was measured.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "bench/scenario/checks.hpp"

namespace canhil::checks {

class Condition;

struct Limit {
  double value = 0;
  bool inclusive = true;  ///< the limit itself is permitted
};
/// A limit that is not permitted itself.
constexpr Limit exclusive(double value) { return {.value = value, .inclusive = false}; }

/// Part of a run, by time of validity or, if the flight goes to a target, by time to go.
struct Stretch {
  scenario::Window window;
  std::optional<std::pair<double, double>> to_go_s{};  ///< [least, most)
  std::shared_ptr<const Condition> condition{};        ///< null: all of the stretch
};

/// What is judged, and its limits. An empty text or no value: the kind of check has none.
struct Criterion {
  std::string quantity{};            ///< or the message, flag, counter, input or fault
  std::string estimator{};           ///< whose answers are judged
  std::string statistic{};           ///< "rms", "99 % quantile"
  std::optional<Limit> lower{};      ///< [unit]
  std::optional<Limit> upper{};      ///< [unit]
  std::string unit{};                ///< of the limits, as in the scenario; empty: a count or a ratio
  std::optional<Stretch> stretch{};  ///< none: the whole run
};

struct Measurement {
  std::optional<double> value{};         ///< in the unit of the criterion
  std::optional<std::uint64_t> count{};  ///< how many values were judged
  /// When the worst of these values came: its time of validity in the run. For a mean or RMS: the largest
  /// value of those in it. For a silence: its begin.
  std::optional<std::int64_t> worst_at_us{};
};

struct Judgement {
  Criterion criterion{};
  Measurement measurement{};
};

/// The limits with their unit: "< 2 mrad/s", ">= 1.6 and <= 2.4"; empty: there are none.
std::string to_text(const Criterion& criterion);

/// The distance from the value to the nearest limit, as a share of this limit: 0.2 of a value that may become
/// 25 % larger; negative: beyond the limit. None: there is no value or no limit, or the only limit is 0.
std::optional<double> margin(const Judgement& judgement);

}  // namespace canhil::checks
