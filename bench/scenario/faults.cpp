#include "bench/scenario/faults.hpp"

#include <array>
#include <string_view>
#include <utility>

#include "bench/scenario/contract.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::scenario {
namespace {

constexpr std::array<std::pair<std::string_view, FaultKind>, 6> kinds{{{"lost", FaultKind::lost},
                                                                       {"damaged", FaultKind::damaged},
                                                                       {"repeated", FaultKind::repeated},
                                                                       {"too_short", FaultKind::too_short},
                                                                       {"foreign", FaultKind::foreign},
                                                                       {"changed", FaultKind::changed}}};

FaultKind read_kind(Section& section) {
  std::vector<std::string> names;
  for (const auto& [name, kind] : kinds) names.emplace_back(name);
  const std::string given = section.one_of("kind", names);
  for (const auto& [name, kind] : kinds) {
    if (name == given) return kind;
  }
  return FaultKind::lost;
}

Fault read_fault(Section& section, const Contract& contract) {
  Fault fault;
  fault.where = section.path("messages");
  fault.kind = read_kind(section);
  fault.messages = section.some_of("messages", contract.messages);
  if (fault.messages.empty())
    section.reject("messages", "names none", "at least one message that a node of the bench sends");
  constexpr std::int64_t longest_s = 86'400;
  fault.from_us = section.time_us("from_s", Limits::between(0, longest_s), 0);
  fault.to_us = section.time_us("to_s", Limits::between(0, longest_s), longest_s);
  if (fault.to_us < fault.from_us) section.reject("to_s", "is before from_s", "a later time");
  fault.every = section.optional_integer("every", 1).value_or(1);
  if (fault.kind == FaultKind::changed) {
    fault.signal = section.text("signal");
    fault.value = section.plain_number("value", {});
  } else {
    section.refuse("signal", "has no effect", "kind = \"changed\" beside it");
    section.refuse("value", "has no effect", "kind = \"changed\" beside it");
  }
  section.finish();
  return fault;
}

}  // namespace

std::vector<Fault> read_faults(Section& root, const Contract& contract) {
  std::vector<Fault> faults;
  if (!root.has("fault")) {
    root.optional("fault");
    return faults;
  }
  for (Section& section : root.tables("fault")) faults.push_back(read_fault(section, contract));
  return faults;
}

}  // namespace canhil::scenario
