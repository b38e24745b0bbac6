#include "bench/scenario/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "bench/scenario/contract.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::scenario {
namespace {

Check read_one(Section& section, const CheckContext& context) {
  const auto& kinds = context.contract.check_kinds;
  std::vector<std::string> names;
  for (const CheckKind& one : kinds) names.emplace_back(one.name);
  Check check;
  check.line = section.line();
  check.kind = section.one_of({"kind", "Kind of the check."}, names);
  check.requirement = section.text({"requirement", "Id of the requirement, shown in the reports."}, "");
  const auto kind = std::ranges::find(kinds, std::string_view(check.kind), &CheckKind::name);
  RuleRead read;
  if (kind != kinds.end()) read = kind->read(section, context);
  check.rule = std::move(read.rule);
  check.name = section.text({"name", "Unique name; by default the kind and what is judged."},
                            check.kind + (read.subject.empty() ? "" : " " + read.subject));
  if (section.has("name") && !context.each->estimator.empty()) check.name += " of " + context.each->estimator;
  section.finish();
  return check;
}

}  // namespace

std::vector<Check> read_check(Section& section, CheckContext context) {
  EachEstimator each;
  context.each = &each;
  std::vector<Check> checks;
  for (; each.index < each.number; ++each.index) checks.push_back(read_one(section, context));
  return checks;
}

}  // namespace canhil::scenario
