// The files in which a run is reported, as options of a command.
#pragma once

#include <string>
#include <vector>

#include "bench/drive/session.hpp"
#include "dbc/command_line/command_line.hpp"

namespace canhil::commands {

struct Reports {
  std::string json, junit, html, csv;
};

/// --json, --junit, --html, --csv. `reports` must outlive parsing.
void add_reports(command_line::Command command, Reports& reports);

/// Whether they can be written, and none is one of `others`. Error: one line.
Result<void> check_outputs(const Reports& reports, std::vector<std::string> others);

/// A run that has begun leaves no report of an earlier one that could be taken for its own, however it ends.
void remove_earlier(const Reports& reports);

/// A report on stdout stands in place of the text. One that cannot be written costs none of the others.
/// Error: of the first.
Result<void> write_reports(const Reports& reports, const scenario::Scenario& scenario, const drive::Run& run);

}  // namespace canhil::commands
