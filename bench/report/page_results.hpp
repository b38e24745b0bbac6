// The figures of the estimators on the page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace canhil::report {

/// True if the report has figures of an estimator: of an alignment, an engagement or a wind.
bool has_results(const nlohmann::ordered_json& report);
/// What the run made of each estimator as a whole, and the course of its estimates against the truth.
std::string results_section(const nlohmann::ordered_json& report);
std::string estimates_section(const nlohmann::ordered_json& report);

}  // namespace canhil::report
