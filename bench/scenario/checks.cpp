#include "bench/scenario/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "bench/scenario/contract.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::scenario {

Check read_check(Section& section, const CheckContext& context) {
  const auto& kinds = context.contract.check_kinds;
  std::vector<std::string> names;
  for (const CheckKind& one : kinds) names.emplace_back(one.name);
  Check check;
  check.line = section.line();
  if (section.has("kind")) {
    const std::string given = section.text({"kind", "Kind of the check."});
    const auto& former = context.contract.former_check_kinds;
    const auto found = std::ranges::find(former, std::string_view(given), &FormerCheckKind::name);
    if (found != former.end())
      section.reject("kind", fmt::format("'{}' is a former kind", given), found->now);
  }
  check.kind = section.one_of({"kind", "Kind of the check."}, names);
  check.requirement = section.text({"requirement", "Id of the requirement, shown in the reports."}, "");
  const auto kind = std::ranges::find(kinds, std::string_view(check.kind), &CheckKind::name);
  RuleRead read;
  if (kind != kinds.end()) read = kind->read(section, context);
  check.rule = std::move(read.rule);
  check.name = section.text({"name", "Unique name; by default the kind and what is judged."},
                            check.kind + (read.subject.empty() ? "" : " " + read.subject));
  section.finish();
  return check;
}

}  // namespace canhil::scenario
