// hil-bench: emulates every node except the target, and judges the target.
#include <array>
#include <string>
#include <string_view>

#include "bench/commands/campaign.hpp"
#include "bench/commands/program.hpp"
#include "bench/commands/subcommands.hpp"

namespace {

using namespace canhil::commands;

// Adds names and summaries for the help text only; the subcommands themselves belong to hil-bench-campaign.
void name_campaign(canhil::command_line::Command program, int& /*code*/) {
  program.add_subcommand(std::string(accept_name), std::string(accept_summary));
  program.add_subcommand(std::string(campaign_name), std::string(campaign_summary));
  program.add_subcommand(std::string(faults_name), std::string(faults_summary));
  program.add_subcommand(std::string(reference_name), std::string(reference_summary));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && (argv[1] == campaign_name || argv[1] == accept_name || argv[1] == faults_name ||
                   argv[1] == reference_name))
    return become("hil-bench-campaign", {argv + 1, argv + argc});
  constexpr std::array<AddCommand, 12> commands{
      add_run,    add_new,    add_report,         add_bus,         name_campaign, add_diverge,
      add_golden, add_doctor, add_schedulability, add_conformance, add_log,       add_dbc};
  return run_program(argc, argv, commands);
}
