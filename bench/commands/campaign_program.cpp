#include "bench/commands/campaign_program.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>

#include "bench/commands/exit_code.hpp"

namespace canhil::commands {

void name_campaign(command_line::Command program, int& /*code*/) {
  program.add_subcommand(std::string(campaign_name), std::string(campaign_summary));
}

int become_campaign_program(char** argv) {
  std::error_code unknown;
  const auto own = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const std::string program = (own.parent_path() / "hil-bench-campaign").string();
  ::execv(program.c_str(), argv);
  return static_cast<int>(
      complain({fmt::format("campaign: {}: {}, expected it beside hil-bench: cmake --build build/default",
                            program, std::strerror(errno))}));
}

}  // namespace canhil::commands
