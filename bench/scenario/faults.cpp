#include "bench/scenario/faults.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/scenario/contract.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::scenario {
namespace {

// "lost SlaveImuDeltaV", "lost SlaveImuDeltaV 2", ...
std::string name_by_default(const std::string& subject, const std::vector<Fault>& before) {
  std::string name = subject;
  for (int i = 2; std::ranges::find(before, name, &Fault::name) != before.end(); ++i)
    name = fmt::format("{} {}", subject, i);
  return name;
}

Fault read_fault(Section& section, const FaultContext& context, const std::vector<Fault>& before) {
  const auto& kinds = context.contract.fault_kinds;
  std::vector<std::string> names;
  for (const FaultKind& one : kinds) names.emplace_back(one.name);
  Fault fault;
  fault.kind = section.one_of({"kind", "Kind of the fault."}, names);
  fault.where = fmt::format("{}: key '{}'", section.where("kind"), section.path("kind"));
  const auto kind = std::ranges::find(kinds, std::string_view(fault.kind), &FaultKind::name);
  FaultRead read;
  if (kind != kinds.end()) read = kind->read(section, context);
  fault.rule = std::move(read.rule);
  fault.from_us = read.from_us;
  fault.to_us = read.to_us;
  fault.begins_in_run = read.begins_in_run;
  fault.name =
      section.text({"name", "Unique name; by default the kind and what the fault affects."},
                   name_by_default(fault.kind + (read.subject.empty() ? "" : " " + read.subject), before));
  if (const auto same = std::ranges::find(before, fault.name, &Fault::name); same != before.end())
    section.reject("name",
                   fmt::format("'{}' is the name of fault[{}] too", fault.name, same - before.begin() + 1),
                   "another name");
  section.finish();
  return fault;
}

}  // namespace

void read_faults(Section& root, const FaultContext& context, std::vector<Fault>& faults,
                 const FaultPlaces* some) {
  if (!root.has("fault")) {
    root.optional("fault");
    return;
  }
  std::vector<Section> sections = root.tables("fault");
  for (std::size_t index = 0; index < sections.size(); ++index) {
    if (some != nullptr && std::ranges::find(*some, index) == some->end()) continue;
    if (some != nullptr) sections[index].optional("together");
    faults.push_back(read_fault(sections[index], context, faults));
  }
}

}  // namespace canhil::scenario
