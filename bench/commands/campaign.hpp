// The subcommands that are separate programs, with their summaries in hil-bench's help.
#pragma once

#include <string_view>

#include "dbc/command_line/command_line.hpp"

namespace canhil::commands {

inline constexpr std::string_view campaign_name = "campaign";
inline constexpr std::string_view campaign_summary = "fly variants of scenarios many times, and compare them";
inline constexpr std::string_view accept_name = "accept";
inline constexpr std::string_view accept_summary = "what a target must do, requirement by requirement";

inline constexpr std::string_view faults_name = "faults";
inline constexpr std::string_view faults_summary =
    "what a target does when something goes wrong, fault by fault";

inline constexpr std::string_view reference_name = "reference";
inline constexpr std::string_view reference_summary =
    "every key of scenario and campaign files: unit, range, default, meaning";

/// `hil-bench reference`: the page docs/scenario-reference.md.
void add_reference(command_line::Command app, int& code);

/// `hil-bench faults` and its subcommand merge: one flight for each fault, and the target's response. Exit
/// code 1 if the target violates a requirement that holds in spite of the faults.
void add_faults(command_line::Command app, int& code);

/// `hil-bench accept`: the suites of bench/acceptance against a target. Exit code 1 if a requirement is not
/// met.
void add_accept(command_line::Command app, int& code);

/// `hil-bench campaign FILE` and its subcommands merge, report, export, replay: many runs, in process or
/// against a program in lockstep, and their statistics.
void add_campaign(command_line::Command app, int& code);

}  // namespace canhil::commands
