// The report files of a run, as options of a command.
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

/// Checks that the report files can be written and that none of them is in `others`. Error: one line.
Result<void> check_outputs(const Reports& reports, std::vector<std::string> others);

/// Removes reports of an earlier run, so that none can be mistaken for a report of this run, however it ends.
void remove_earlier(const Reports& reports);

/// A report on stdout replaces the text. If a report cannot be written, the others are still written. Error:
/// the first one.
Result<void> write_reports(const Reports& reports, const scenario::Scenario& scenario, const drive::Run& run);

}  // namespace canhil::commands
