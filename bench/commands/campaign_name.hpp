// What hil-bench says of the subcommand that is a program of its own.
#pragma once

#include <string_view>

namespace canhil::commands {

inline constexpr std::string_view campaign_name = "campaign";
inline constexpr std::string_view campaign_summary = "fly variants of scenarios many times, and compare them";

}  // namespace canhil::commands
