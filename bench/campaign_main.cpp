// hil-bench-campaign: the program for `hil-bench campaign`, `accept` and `faults`.
#include <array>

#include "bench/commands/campaign.hpp"
#include "bench/commands/program.hpp"

int main(int argc, char** argv) {
  constexpr std::array<canhil::commands::AddCommand, 3> commands{
      canhil::commands::add_campaign, canhil::commands::add_accept, canhil::commands::add_faults};
  return canhil::commands::run_program(argc, argv, commands);
}
