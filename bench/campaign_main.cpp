// hil-bench-campaign: what `hil-bench campaign` and `hil-bench accept` become.
#include <array>

#include "bench/commands/campaign.hpp"
#include "bench/commands/program.hpp"

int main(int argc, char** argv) {
  constexpr std::array<canhil::commands::AddCommand, 2> commands{canhil::commands::add_campaign,
                                                                 canhil::commands::add_accept};
  return canhil::commands::run_program(argc, argv, commands);
}
