#include "bench/scenario/commands.hpp"

#include "bench/scenario/section.hpp"

namespace canhil::scenario {
namespace {

bool forbidden = false;

}  // namespace

void forbid_commands() { forbidden = true; }

bool may_execute(Section& section, std::string_view key, const std::string& what) {
  if (forbidden) section.reject(key, what, "none with --no-commands");
  return !forbidden;
}

}  // namespace canhil::scenario
