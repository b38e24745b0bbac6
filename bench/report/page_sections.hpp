// The sections of a report's page, each as HTML from the report's JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace canhil::report {

std::string checks_section(const nlohmann::ordered_json& report);
/// Latency, jitter and lateness; what is missing. Nothing in virtual time but the reason.
std::string timing_section(const nlohmann::ordered_json& report);
/// Load, drops and errors.
std::string bus_section(const nlohmann::ordered_json& report);
std::string provenance_section(const nlohmann::ordered_json& report);

}  // namespace canhil::report
