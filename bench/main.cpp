// hil-bench: plays every node but the target, and judges it.
#include <array>
#include <string_view>

#include "bench/commands/bus.hpp"
#include "bench/commands/campaign_program.hpp"
#include "bench/commands/diverge.hpp"
#include "bench/commands/doctor.hpp"
#include "bench/commands/program.hpp"
#include "bench/commands/report.hpp"
#include "bench/commands/run.hpp"
#include "bench/commands/schedulability.hpp"

int main(int argc, char** argv) {
  using namespace canhil::commands;
  if (argc > 1 && std::string_view(argv[1]) == campaign_name) return become_campaign_program(argv);
  constexpr std::array<AddCommand, 7> commands{add_run,     add_report, add_bus,           name_campaign,
                                               add_diverge, add_doctor, add_schedulability};
  return run_program(argc, argv, commands);
}
