// The subcommand of hil-bench that is a program of its own, and what hil-bench itself says of it.
#pragma once

#include <string_view>

#include "dbc/command_line/command_line.hpp"

namespace canhil::commands {

inline constexpr std::string_view campaign_name = "campaign";
inline constexpr std::string_view campaign_summary = "fly variants of scenarios many times, and compare them";

/// `hil-bench campaign FILE` and its subcommands merge, report, replay: many runs in process, and statistics.
void add_campaign(command_line::Command app, int& code);

}  // namespace canhil::commands
