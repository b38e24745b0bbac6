// What the sections of a page are put together from.
#pragma once

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "bench/report/markup.hpp"

namespace canhil::report {

/// A number that is not there: null in the report.
inline constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

/// A value of the report for an element.
inline std::string text_in(const nlohmann::ordered_json& value) {
  return escaped(value.is_string() ? value.get<std::string>() : value.dump());
}

/// Rows of cells that are HTML already; on a phone each cell says which column it is of.
std::string table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows,
                  std::string_view style = "");

/// A drawing with its plain title and note.
std::string figure(const std::string& title, const std::string& drawing, const std::string& note);

/// A time of a distribution in ms.
std::string ms(const nlohmann::ordered_json& distribution, const char* key);

}  // namespace canhil::report
