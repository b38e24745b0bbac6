// A run's report for programs.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "bench/drive/session.hpp"
#include "bench/scenario/scenario.hpp"

namespace canhil::report {

/// The value of "schema" in a report.
inline constexpr std::string_view schema = "canhil-report-1";

/// One JSON object: verdict, checks, figures, provenance, and all that the page shows. Times in s, angles in
/// rad, unit in every key; docs/report.md describes it.
nlohmann::ordered_json document(const scenario::Scenario& scenario, const drive::Run& run);

/// The same as text: an object a line for each key, an array of numbers on one line.
std::string json(const scenario::Scenario& scenario, const drive::Run& run);

}  // namespace canhil::report
