#include "bench/scenario/sensor_name.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/scenario/section.hpp"

namespace canhil::scenario {
namespace {

bool is_name(std::string_view name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
}

}  // namespace

const NodeTable* read_sensor_name(Section& section, const DbcVocabulary& contract,
                                  std::span<const NodeSettings> others) {
  std::vector<std::string> kinds;
  for (const NodeTable* node : contract.nodes) kinds.emplace_back(node->key);
  const std::string name =
      section.text({"name", "Name of the sensor, by which the mapping and the faults know it."});
  const std::string kind = section.one_of({"kind", "What it is: the name of a node's table."}, kinds);
  const auto refuse = [&](std::string_view why) {
    section.reject("name", fmt::format("'{}' {}", name, why),
                   "a name of its own of a-z, 0-9 and _, such as imu_b");
  };
  if (std::ranges::find(kinds, name) != kinds.end()) refuse("is a kind");
  if (!is_name(name)) refuse("is no name");
  if (std::ranges::any_of(others, [&](const NodeSettings& other) { return other.table().key == name; }))
    refuse("is the name of another sensor");
  if (section.error()) return nullptr;
  return &contract.named(**std::ranges::find(contract.nodes, kind, &NodeTable::key), name);
}

}  // namespace canhil::scenario
