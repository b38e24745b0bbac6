// hil-bench-campaign: what `hil-bench campaign` becomes.
#include <array>

#include "bench/commands/campaign.hpp"
#include "bench/commands/program.hpp"

int main(int argc, char** argv) {
  constexpr std::array<canhil::commands::AddCommand, 1> commands{canhil::commands::add_campaign};
  return canhil::commands::run_program(argc, argv, commands);
}
