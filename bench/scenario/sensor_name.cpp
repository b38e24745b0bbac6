#include "bench/scenario/sensor_name.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/scenario/section.hpp"

namespace canhil::scenario {

bool is_name(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
}

std::string why_no_name(std::string_view name, std::span<const std::string> kinds) {
  if (std::ranges::find(kinds, name) != kinds.end()) return "is a kind";
  return is_name(name) ? "" : "is no name";
}

const NodeTable* read_sensor_name(Section& section, const DbcVocabulary& contract,
                                  std::span<const NodeSettings> others) {
  std::vector<std::string> kinds;
  for (const NodeTable* node : contract.nodes) kinds.emplace_back(node->key);
  const std::string name =
      section.text({"name", "Name of the sensor, by which the mapping and the faults know it."});
  const std::string kind = section.one_of({"kind", "What it is: the name of a node's table."}, kinds);
  std::string why = why_no_name(name, kinds);
  if (std::ranges::any_of(others, [&](const NodeSettings& other) { return other.table().key == name; }) &&
      why.empty())
    why = "is the name of another sensor";
  if (!why.empty()) section.reject("name", fmt::format("'{}' {}", name, why), own_name);
  if (section.error()) return nullptr;
  const NodeTable* table =
      contract.named(**std::ranges::find(contract.nodes, kind, &NodeTable::key), name, *contract.binding);
  if (table == nullptr)
    section.reject("name", fmt::format("'{}' is no {} sensor of the mapping", name, kind),
                   fmt::format("[sensors] there with {} = {{ VALUE = \"UNIT\" }}", name));
  return table;
}

}  // namespace canhil::scenario
