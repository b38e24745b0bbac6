// The answers of a mapped target in a run.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string_view>

#include "bench/mapping/mapping.hpp"
#include "bench/spool/spool.hpp"

namespace canhil::mapping {

/// One value of a quantity, in SI.
struct TimedValue {
  std::int64_t t_us = 0;  ///< time of validity of the cause, or the arrival time if there is no cause
  double value = 0;
  std::optional<double> sigma{};
};

/// The reported values of each quantity, in order of time.
struct Answers {
  const Mapping* mapping = nullptr;
  std::map<const quantities::Quantity*, Spool<TimedValue>> values;
  std::map<std::string_view, Spool<std::int64_t>> messages;  ///< arrival times by message name
};

}  // namespace canhil::mapping
