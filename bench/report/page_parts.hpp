// What the parts of a report's page share.
#pragma once

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "bench/report/markup.hpp"

namespace canhil::report {

/// The style of the page, built into the program.
extern const EmbeddedFiles styles;

/// A value of the report for an element.
inline std::string text_in(const nlohmann::ordered_json& value) {
  return escaped(value.is_string() ? value.get<std::string>() : value.dump());
}

/// How an outcome of the report looks: not by its colour alone.
struct Look {
  const char* style;
  const char* sign;
};
inline Look look_of(std::string_view outcome) {
  return outcome == "pass"   ? Look{"yes", "&#10003;"}
         : outcome == "fail" ? Look{"no", "&#10007;"}
                             : Look{"unknown", "?"};
}

/// A time of a distribution in ms.
inline std::string ms(const nlohmann::ordered_json& distribution, const char* key) {
  return fmt::format("{:.3f}", distribution.at(key).get<double>() * 1e3);
}

}  // namespace canhil::report
