#include "bench/accept/dialogue.hpp"

#include "bench/conformance/conformance.hpp"

namespace canhil::accept {
namespace {

std::vector<conformance::Rule> rules_of(const Suite& suite) {
  return conformance::rules(!suite.parameters.empty(), suite.apply.has_value());
}

}  // namespace

std::vector<Requirement> protocol_requirements(const Suite& suite) {
  std::vector<Requirement> all;
  for (const conformance::Rule& rule : rules_of(suite))
    all.push_back({.id = rule.id, .family = rule.family, .text = rule.text});
  return all;
}

Result<std::vector<Item>> talk(const Suite& suite, const std::string& target, const std::atomic<bool>& stop) {
  auto items =
      conformance::ask(rules_of(suite), *suite.dialogue, target, suite.parameters, suite.apply, stop);
  if (!items) return items;
  for (Item& item : *items) item.name = "dialogue";
  return items;
}

}  // namespace canhil::accept
