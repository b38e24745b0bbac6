// `hil-bench campaign` is a program of its own beside hil-bench: who flies single runs need not build the
// papers and their statistics.
#pragma once

#include <string_view>

#include "dbc/command_line/command_line.hpp"

namespace canhil::commands {

inline constexpr std::string_view campaign_name = "campaign";
inline constexpr std::string_view campaign_summary = "fly variants of scenarios many times, and compare them";

/// Adds the subcommand's name and summary, for help.
void name_campaign(command_line::Command program, int& code);

/// Goes on as hil-bench-campaign with the same words. Returns only where that cannot be started: the exit
/// code, after one line that says why.
int become_campaign_program(char** argv);

}  // namespace canhil::commands
