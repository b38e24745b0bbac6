// Values of a report on its page.
#pragma once

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/report/markup.hpp"

namespace canhil::report {

/// A number that is not there: null in the report.
inline constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

/// A value of the report for an element.
inline std::string text_in(const nlohmann::ordered_json& value) {
  return escaped(value.is_string() ? value.get<std::string>() : value.dump());
}

/// A time of a distribution in ms.
inline std::string ms(const nlohmann::ordered_json& distribution, const char* key) {
  return fmt::format("{:.3f}", distribution.at(key).get<double>() * 1e3);
}

}  // namespace canhil::report
