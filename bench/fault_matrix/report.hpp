// Formats the report of a fault matrix for people and programs, from the results alone.
#pragma once

#include <string>

#include "bench/checks/verdict.hpp"
#include "bench/fault_matrix/results.hpp"

namespace canhil::fault_matrix {

/// The outcome is `fail` if there is a violation. Without a violation, the outcome is `not_measured` if a
/// cell is missing or could not be judged, and `pass` if all cells were judged.
checks::Outcome outcome_of(const Results& results);

/// The matrix, followed by the cells that were not measured and by the violations, each with the command that
/// repeats the violation. `folder`: the folder of the saved scenarios.
std::string text(const Results& results, const std::string& folder);
/// The matrix as Markdown tables.
std::string markdown(const Results& results);
std::string json(const Results& results);
std::string html(const Results& results, const std::string& folder);

}  // namespace canhil::fault_matrix
