// A run's report as a self-contained HTML page.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "dbc/wire/result.hpp"

namespace canhil::report {

/// The page of a report that document() made. The page is drawn from the report alone. An error is one line
/// about what the report lacks.
Result<std::string> html(const nlohmann::ordered_json& document);

/// Reads a JSON report of hil-bench. An error is one line with the file and what was expected.
Result<nlohmann::ordered_json> read_document(const std::string& path);

}  // namespace canhil::report
