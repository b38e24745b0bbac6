// Formats the results of a campaign: as text and as a page for people, as JSON, CSV and JUnit XML for
// programs.
#pragma once

#include <filesystem>
#include <string>

#include "bench/campaign/evaluate.hpp"

namespace canhil::campaign {

/// What a report tells of a campaign's results.
struct Reported {
  const Campaign& campaign;
  const Evaluation& evaluation;
  std::filesystem::path folder{};  ///< of the scenarios that show violations
};

/// A text report: how the runs ended, then every answer with its limit; with faults, also the matrix.
std::string text(const Reported& all);

/// One JSON object (docs/campaign.schema.json), which also contains the curves. If a value has a unit, the
/// key of the value ends with the name of the unit.
std::string json(const Reported& all);

/// A table with a line for each answer: metric or check, kind, requirement, variant, outcome, value, lower,
/// upper, unit, margin, measured, expected.
std::string csv(const Reported& all);

/// JUnit XML: a test suite for each variant, with a test case for each answer that has a limit and for each
/// response to a fault.
std::string junit(const Reported& all);

/// A self-contained HTML page, with the curves.
std::string page(const Reported& all);

}  // namespace canhil::campaign
