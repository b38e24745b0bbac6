// The answers of mapped targets in a run.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string_view>

#include "bench/mapping/mapping.hpp"
#include "dbc/spool/in_order.hpp"

namespace canhil::mapping {

/// One value of a quantity, in SI.
struct TimedValue {
  std::int64_t t_us = 0;  ///< time of validity of the cause, or the arrival time if there is no cause
  double value = 0;
  bool none = false;  ///< the target said that it has none (of a sigma or a correlation)
};

/// What the targets reported.
struct Answers {
  using Values = TimeOrdered<TimedValue, &TimedValue::t_us>;
  using Times = TimeOrdered<std::int64_t, std::identity{}>;

  std::map<const ReportedSignal*, Values> values;  ///< of quantities, sigmas and correlations
  std::map<const ReportedFlag*, Times> flags;      ///< times of the answers in which a flag is set
  /// The times of the values' causes, or the arrival times if there is no cause, by message name.
  std::map<std::string_view, Times> messages;
};

}  // namespace canhil::mapping
