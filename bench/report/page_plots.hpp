// The pictures of a page, each as HTML from the report's JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace canhil::report {

/// A distribution of times.
std::string histogram(const std::string& title, const nlohmann::ordered_json& distribution);

/// The largest time of each stretch of the run.
std::string course(const std::string& title, const nlohmann::ordered_json& line);

/// The drawing alone of the largest value of each stretch of the run, from zero; `scale` makes the unit of
/// the numbers.
std::string from_zero(const std::string& title, const std::string& unit, double stretch_s,
                      const nlohmann::ordered_json& largest, double scale);

/// A quantity over the run; a second picture of its late course where the first instants hide that.
std::string estimate(const nlohmann::ordered_json& series);

}  // namespace canhil::report
