// The subcommands of the separate program hil-bench-campaign, with their summaries for the help of hil-bench.
#pragma once

#include <cstdint>
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

inline constexpr std::uint64_t most_threads = 1024;  ///< of --threads

/// `hil-bench reference`: prints the page docs/scenario-reference.md.
void add_reference(command_line::Command app, int& code);

/// `hil-bench faults` and its subcommand merge: flies each fault of a matrix and classifies the target's
/// response. Exit code 1 if the target violates a requirement that it must meet in spite of the faults.
void add_faults(command_line::Command app, int& code);

/// `hil-bench accept`: tests a target with the suites of bench/acceptance. Exit code 1 if a requirement is
/// not met.
void add_accept(command_line::Command app, int& code);

/// `hil-bench campaign FILE` and its subcommands merge, report, export, replay: flies many runs, in this
/// process or against a program in lockstep, and computes their statistics.
void add_campaign(command_line::Command app, int& code);

}  // namespace canhil::commands
