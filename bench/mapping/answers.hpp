// What a mapped target told in a run.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string_view>

#include "bench/mapping/mapping.hpp"
#include "bench/spool/spool.hpp"

namespace canhil::mapping {

/// One quantity, told once. SI.
struct TimedValue {
  std::int64_t t_us = 0;  ///< of validity: of what it answers, or of its arrival
  double value = 0;
  std::optional<double> sigma{};
};

/// By quantity, in the order of time.
struct Answers {
  const Mapping* mapping = nullptr;
  std::map<const quantities::Quantity*, Spool<TimedValue>> values;
  std::map<std::string_view, Spool<std::int64_t>> messages;  ///< their times, by name
};

}  // namespace canhil::mapping
