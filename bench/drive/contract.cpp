#include "bench/drive/contract.hpp"

#include <fmt/format.h>

#include "bench/bindings/canhil.hpp"
#include "bench/checks/judge.hpp"
#include "bench/estimators/registry.hpp"
#include "bench/estimators/vocabulary.hpp"
#include "bench/faults/kinds.hpp"
#include "bench/mapping/mapping.hpp"
#include "bench/nodes/registry.hpp"
#include "bench/plant/registry.hpp"
#include "bench/plant/setup.hpp"
#include "bench/scenario/binding.hpp"
#include "bench/sensors/program.hpp"
#include "bench/world/hash.hpp"
#include "dbc/files/text_file.hpp"
#include "messages/canhil.hpp"

namespace canhil::drive {
namespace {

template <class E>
std::vector<std::string> names() {
  std::vector<std::string> all;
  all.reserve(messages::enumerators<E>.size());
  for (const E value : messages::enumerators<E>) all.emplace_back(name_of(value));
  return all;
}

scenario::DbcVocabulary make_contract() {
  scenario::DbcVocabulary contract{.algorithms = names<messages::Algorithm>(),
                                   .parameters = names<messages::Parameter>(),
                                   .check_kinds = checks::kinds(estimators::all()),
                                   .nodes = nodes::tables(),
                                   .fault_kinds = faults::kinds(),
                                   .read_recorded = nodes::read_recorded,
                                   .read_program = sensors::read_program,
                                   .plants = plant::tables(),
                                   .read_plant = plant::read_setup,
                                   .named = nodes::named};
  return estimators::bound_to(std::move(contract), bindings::canhil());
}

}  // namespace

scenario::DbcVocabulary contract() {
  static const scenario::DbcVocabulary built_in = make_contract();
  return built_in;
}

Result<scenario::Scenario> parse_scenario(std::string_view text, const std::string& name,
                                          std::span<const scenario::Setting> settings,
                                          std::optional<std::string> folder, const mapping::ReadText& read) {
  const auto by = mapping::contract_of(text, name, contract(), read, settings);
  if (!by) return tl::unexpected(by.error());
  auto scenario = scenario::parse(text, name, *by, settings, std::move(folder));
  if (scenario && by->binding->hash != 0)
    scenario->hash = world::fnv1a_64(fmt::format("{:x} {:x}", scenario->hash, by->binding->hash));
  return scenario;
}

Result<void> add_faults(scenario::Scenario& scenario, const std::string& file) {
  const auto text = read_text_file(file, "a file of faults", scenario::most_toml_bytes);
  if (!text) return tl::unexpected(text.error());
  return add_faults(scenario, *text, file);
}

Result<void> add_faults(scenario::Scenario& scenario, std::string_view text, const std::string& name,
                        const scenario::FaultPlaces* some) {
  return scenario::add_faults(scenario, text, name, estimators::bound_to(contract(), scenario.binding), some);
}

Result<scenario::Scenario> read_scenario(const std::string& file,
                                         std::span<const scenario::Setting> settings) {
  const auto text = read_text_file(file, "a scenario file", scenario::most_toml_bytes);
  if (!text) return tl::unexpected(text.error());
  return parse_scenario(*text, file, settings);
}

}  // namespace canhil::drive
