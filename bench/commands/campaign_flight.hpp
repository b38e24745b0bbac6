// Flies a campaign and reports on its results, for `hil-bench campaign` and `hil-bench faults`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/campaign/campaign.hpp"
#include "bench/commands/exit_code.hpp"
#include "bench/commands/live.hpp"
#include "dbc/command_line/command_line.hpp"
#include "dbc/files/command_files.hpp"

namespace canhil::commands {

/// The reports of a campaign as given on the command line.
struct CampaignReports {
  std::string json, junit, html, csv;
  bool markdown = false;  ///< the matrix of faults, in place of the text
  [[nodiscard]] bool any() const {
    return markdown || !json.empty() || !junit.empty() || !html.empty() || !csv.empty();
  }
};
/// Adds and returns the options --json, --junit, --html, --csv and --markdown. `reports` must outlive
/// parsing.
std::vector<command_line::Option> add_reports(command_line::Command command, CampaignReports& reports);
/// Declares the report files as outputs.
void declare(const CampaignReports& reports, CommandFiles& files);

/// How a campaign is flown, as given on the command line.
struct CampaignFlight {
  std::string out;  ///< folder, or results file *.sqlite
  std::optional<std::uint64_t> threads;
  std::string shard;
  bool resume = false;
  std::string target;
  CampaignReports reports;
  Live live;
};
/// Adds the options --out, --threads, --shard, --resume and --target, reports and --live. `flight` must
/// outlive parsing. Returns --target, and all options that a paper's campaigns cannot have.
struct FlightOptions {
  command_line::Option target;
  std::vector<command_line::Option> own;
};
FlightOptions add_flight(command_line::Command command, CampaignFlight& flight);

/// Flies the campaign. `stem`: name of the results file in a folder, without its ending. Prints the report,
/// unless it is a shard.
ExitCode fly(const campaign::Campaign& campaign, const CampaignFlight& flight, const std::string& stem);

/// Prints the report on stored results: one file, or all shards.
ExitCode report_on(const std::vector<std::string>& files, const CampaignReports& reports);

}  // namespace canhil::commands
