// The report files of a run, as options of a command.
#pragma once

#include <memory>
#include <string>

#include "bench/drive/session.hpp"
#include "dbc/command_line/command_line.hpp"
#include "dbc/files/command_files.hpp"

namespace canhil::commands {

struct Reports {
  std::string json, junit, html, csv;
};

/// Adds the options --json, --junit, --html, --csv. `reports` must outlive parsing.
void add_reports(command_line::Command command, Reports& reports);

/// Declares the report files as outputs.
void declare(const Reports& reports, CommandFiles& files);

/// Removes reports of an earlier run, so that none can be mistaken for a report of this run, however this run
/// ends.
void remove_earlier(const Reports& reports);

/// What keeps the frames of a run; null: no report shows them. Attach it to the run, then store it as
/// Run::frames.
std::shared_ptr<drive::KeptFrames> frames_for(const Reports& reports);

/// Writes the reports. Writes the text report to stdout, unless another report is written to stdout. If a
/// report cannot be written, the other reports are still written, and the first error is returned.
Result<void> write_reports(const Reports& reports, const scenario::Scenario& scenario, const drive::Run& run);

}  // namespace canhil::commands
