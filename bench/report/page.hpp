// A run's report as one HTML page that needs nothing outside itself.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "dbc/wire/result.hpp"

namespace canhil::report {

/// The page of a report as document() makes it, drawn from nothing else. Error: one line, what the report
/// lacks.
Result<std::string> html(const nlohmann::ordered_json& document);

/// Reads a report that hil-bench wrote as JSON. Error: one line with the file and what was expected.
Result<nlohmann::ordered_json> read_document(const std::string& path);

}  // namespace canhil::report
