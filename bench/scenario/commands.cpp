#include "bench/scenario/commands.hpp"

#include <fmt/format.h>

#include <utility>

#include "bench/scenario/scenario.hpp"

namespace canhil::scenario {

Result<void> refuse_commands(const Scenario& scenario) {
  for (const TargetSetup& target : scenario.targets) {
    if (!target.own_start) continue;
    for (const auto& [key, command] :
         {std::pair("before", target.own_start->before), std::pair("after", target.own_start->after)}) {
      if (!command.empty())
        return failure(
            fmt::format("{}: key 'target.{}': is a shell command ('{}'), expected none with --no-commands",
                        scenario.file, key, command));
    }
  }
  return {};
}

}  // namespace canhil::scenario
