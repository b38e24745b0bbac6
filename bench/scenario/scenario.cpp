#include "bench/scenario/scenario.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "bench/scenario/binding.hpp"
#include "bench/scenario/initial_error.hpp"
#include "bench/scenario/section.hpp"
#include "bench/scenario/sensor_name.hpp"
#include "bench/scenario/truth.hpp"
#include "bench/world/hash.hpp"
#include "bench/world/truth_values.hpp"
#include "dbc/files/text_file.hpp"

namespace canhil::scenario {
namespace {

/// Why errors of the initial state are refused beside a mapping.
constexpr std::string_view no_start =
    "has no effect: with a mapping, only the sensor [start] tells the target a start state";

/// Whether a node samples what moves: a plant, or without one the carrier.
bool samples(const NodeTable& node, const PlantTable* plant) {
  return plant == nullptr ? node.samples.empty() : plant->has(node.samples);
}

/// The keys of what moves, followed by the keys of the nodes that sample it.
std::vector<std::string_view> keys_of(const PlantTable* plant, const DbcVocabulary& contract,
                                      std::vector<std::string_view> keys) {
  for (const NodeTable* node : contract.nodes) {
    if (samples(*node, plant)) keys.push_back(node->key);
  }
  return keys;
}

/// Whether a condition holds for at least one estimator of the scenario.
template <class Holds>
bool any_runs(const Scenario& scenario, const DbcVocabulary& contract, Holds holds) {
  return std::ranges::any_of(scenario.targets, [&](const TargetSetup& target) {
    return holds(facts_of(contract, target.estimator));
  });
}

/// Reads the table of a node. Returns false if the node measures a truth that the scenario does not know.
bool read_node(Section& section, const NodeTable& node, Scenario& scenario, const DbcVocabulary& contract) {
  const bool recorded = contract.read_recorded != nullptr && section.has("recorded");
  const bool program = !recorded && contract.read_program != nullptr && section.has("command");
  scenario.nodes.push_back(recorded  ? contract.read_recorded(node, section, scenario.duration_us)
                           : program ? contract.read_program(node, section)
                                     : node.read(node, section));
  // The error models of the bench's sensors apply neither to recorded measurements nor to those of a program.
  section.finish(recorded  ? "has no effect beside 'recorded'"
                 : program ? "has no effect beside 'command'"
                           : "is unknown");
  const PlantFacts* plant = scenario.plant_with(node.samples);
  if (!recorded && plant != nullptr && plant->table != nullptr &&
      scenario.nodes.back().period_us() % plant->table->sampled_every_us != 0)
    section.reject(
        "period_ms", "is not a multiple of the truth's step",
        fmt::format("a multiple of {:g}", 1e-3 * static_cast<double>(plant->table->sampled_every_us)));
  return recorded || !node.samples.empty() || scenario.truth_is_known();
}

constexpr std::string_view no_truth = "has no truth to measure, as trajectory is \"unknown\"";
constexpr std::string_view what_was_measured = "'recorded', and what was measured";

/// Reads the nodes that sample a plant, or null: the carrier.
void read_nodes(Section& root, Scenario& scenario, const DbcVocabulary& contract, const PlantTable* plant) {
  for (const NodeTable* node : contract.nodes) {
    if (!samples(*node, plant)) continue;
    if (node->only_named) {
      if (root.has(node->key)) root.reject(node->key, "is no table", "a [[sensor]] of this kind");
      continue;
    }
    if (!contract.binding->any_sensor && contract.binding->closing_of(*node) == nullptr) {
      if (root.has(node->key))
        root.reject(node->key, "is given, but canhil's DBC has no message for its samples",
                    "a target with a mapping");
      continue;
    }
    const bool needed = plant != nullptr || any_runs(scenario, contract, [&](const EstimatorFacts& facts) {
                          return std::ranges::find(facts.nodes, node->key) != facts.nodes.end();
                        });
    std::optional<Section> section = needed ? root.table(node->key) : root.optional_table(node->key);
    if (section && !read_node(*section, *node, scenario, contract))
      root.reject(node->key, no_truth, what_was_measured);
  }
}

/// Reads the sensors that have names of their own.
void read_sensors(Section& root, Scenario& scenario, const DbcVocabulary& contract) {
  if (!contract.binding->any_sensor) {
    if (root.has("sensor"))
      root.reject("sensor", "is given, but canhil's DBC carries one sensor of each kind",
                  "the tables of its nodes, or a target with a mapping");
    return;
  }
  if (!root.has("sensor")) return root.optional("sensor");
  for (Section& section : root.tables("sensor")) {
    const NodeTable* node = read_sensor_name(section, contract, scenario.nodes);
    if (node == nullptr) continue;
    const auto plant =
        std::ranges::find_if(contract.plants, [&](const PlantTable* one) { return one->has(node->samples); });
    if (plant != contract.plants.end() && scenario.plant_with(node->samples) == nullptr)
      section.reject("kind", "has nothing to measure", fmt::format("a table [{}] beside it", (*plant)->key));
    if (!read_node(section, *node, scenario, contract)) section.reject("kind", no_truth, what_was_measured);
  }
}

/// The nodes of the plants with tables of their own that the scenario has.
void read_nodes_of_plants(Section& root, Scenario& scenario, const DbcVocabulary& contract, bool last) {
  for (const PlantTable* plant : contract.plants) {
    const bool moves =
        std::ranges::find(scenario.of_tables, plant, &PlantFacts::table) != scenario.of_tables.end();
    if (moves && plant->nodes_last == last) read_nodes(root, scenario, contract, plant);
  }
}

/// A plant with tables of its own.
void read_plant(Section& root, Scenario& scenario, const DbcVocabulary& contract, const PlantTable& plant) {
  std::vector<std::string_view> keys{plant.key};
  keys.insert(keys.end(), plant.further_tables.begin(), plant.further_tables.end());
  keys = keys_of(&plant, contract, std::move(keys));
  const bool wanted =
      any_runs(scenario, contract, [&](const EstimatorFacts& facts) { return plant.has(facts.truth); }) ||
      std::ranges::any_of(keys, [&](std::string_view key) { return root.has(key); });
  if (!wanted) {
    for (const std::string_view key : keys) root.optional(key);
    return;
  }
  Section table = root.table(plant.key);
  scenario.of_tables.push_back(plant.read(root, table, *contract.binding));
}

/// Whether the scenario selects the DBC of CAN FD; none: it selects no DBC.
std::optional<bool> read_fd(Section& root, const Binding& binding) {
  if (!binding.containers) root.refuse("dbc", "has no effect: the mapping names the DBC", "no such key");
  root.optional("dbc");
  if (!root.has("dbc")) return std::nullopt;
  static const std::vector<std::string> names{"canhil", "canhil-fd"};
  return root.one_of({"dbc",
                      "DBC of the bus. `canhil`: classic CAN; `canhil-fd`: CAN FD. If both this key and the "
                      "option `--dbc` are given, they must agree. If neither is given, the DBC is `canhil`."},
                     names) == "canhil-fd";
}

std::vector<std::string> estimators_of(const Scenario& scenario) {
  std::vector<std::string> estimators;
  for (const TargetSetup& target : scenario.targets) estimators.push_back(target.estimator);
  return estimators;
}

std::vector<Check> read_checks(Section& root, const Scenario& scenario, const DbcVocabulary& contract) {
  const std::vector<std::string> estimators = estimators_of(scenario);
  std::vector<std::string> events;
  for (const Event& event : scenario.events) events.push_back(event.name);
  std::vector<FaultWindow> faults;
  for (const Fault& fault : scenario.faults)
    faults.push_back({fault.name, {fault.from_us, std::min(fault.to_us, scenario.duration_us)}});
  std::int64_t latency_us = 0;
  for (const NodeSettings& node : scenario.nodes) latency_us = std::max(latency_us, node.latency_us());
  PlantFacts plant = scenario.plant;
  for (const PlantFacts& one : scenario.of_tables) {
    for (const PlantFacts::Output& output : one.outputs) {
      if (output.name.starts_with(world::plant_prefix)) plant.outputs.push_back(output);
    }
  }
  const CheckContext context{.duration_us = scenario.duration_us,
                             .contract = contract,
                             .estimators = estimators,
                             .plant = plant,
                             .faults = faults,
                             .events = events,
                             .latency_us = latency_us};
  std::vector<Check> checks;
  std::vector<int> numbers;  // of the checks' tables, as the user counts them
  int number = 0;
  for (Section& section : root.tables("check")) {
    ++number;
    for (Check& check : read_check(section, context)) {
      const auto same = std::ranges::find(checks, check.name, &Check::name);
      if (same != checks.end())
        section.reject("name",
                       fmt::format("'{}' is the name of check[{}] too", check.name,
                                   numbers[static_cast<std::size_t>(same - checks.begin())]),
                       "another name");
      checks.push_back(std::move(check));
      numbers.push_back(number);
    }
  }
  return checks;
}

/// Reads the carrier's flight. The table [truth] may be absent if a plant with tables of its own moves; then
/// no table that depends on [truth] is allowed.
void read_navigation(Section& root, Scenario& scenario, const DbcVocabulary& contract) {
  if (root.has("truth") || scenario.plant.moves_the_carrier || scenario.of_tables.empty()) {
    Section truth = root.table("truth");
    scenario.truth = read_truth(truth, scenario.duration_us, scenario.plant.moves_the_carrier);
    return;
  }
  root.optional("truth");
  for (const std::string_view key : keys_of(nullptr, contract, {"initial_error"})) {
    if (root.has(key)) root.reject(key, "depends on a truth", "a table [truth] beside it");
  }
}

/// With an unknown flight, the target receives the initial state exactly as the scenario gives it, without
/// errors.
void refuse_errors_of_start(Section& root, const Scenario& scenario) {
  const bool own = std::ranges::any_of(
      scenario.targets, [](const TargetSetup& target) { return target.initial_error.has_value(); });
  if (own || root.has("initial_error"))
    root.reject(own ? "target" : "initial_error",
                "has errors of a start whose truth is not known, as trajectory is \"unknown\"",
                "no 'initial_error'");
}

/// An aided estimator uses the fixes of one aid (a node that sends fixes): the aid that a parameter of the
/// estimator selects or, without this parameter, the first aid in the list of nodes. The estimator refuses
/// fixes of other aids. An estimator that is not aided uses no fixes.
void expect_aid(Section& root, const Scenario& scenario, const DbcVocabulary& contract) {
  const auto target = std::ranges::find_if(scenario.targets, [&](const TargetSetup& one) {
    return !facts_of(contract, one.estimator).aided_by.empty();
  });
  std::vector<std::string_view> who;
  for (const auto& [name, facts] : contract.facts) {
    if (!facts.aided_by.empty()) who.push_back(name);
  }
  std::vector<const NodeTable*> aids;
  for (const NodeTable* node : contract.nodes) {
    if (!node->aid) continue;
    aids.push_back(node);
    if (target == scenario.targets.end() && root.has(node->key))
      root.reject(node->key, "has fixes that no estimator takes",
                  fmt::format("estimator {} beside it", fmt::join(who, " or ")));
  }
  if (target == scenario.targets.end()) return;
  const std::string_view parameter = facts_of(contract, target->estimator).aided_by;
  const auto aiding = std::ranges::find(target->parameters, parameter, &Parameter::name);
  const auto chosen = std::ranges::find_if(aids, [&](const NodeTable* aid) {
    return aiding != target->parameters.end() && aiding->value == aid->aid->aiding;
  });
  const NodeTable* taken = chosen == aids.end() ? aids.front() : *chosen;
  std::vector<std::string> tables, others;
  for (const NodeTable* aid : aids) {
    if (aid != taken) others.push_back(fmt::format("{:g}", aid->aid->aiding));
    tables.push_back(fmt::format("[{}]", aid->key));
  }
  if (std::ranges::none_of(aids, [&](const NodeTable* aid) { return scenario.node(aid->key); })) {
    root.reject(aids.front()->key, "is missing",
                fmt::format("at least one of the tables {}", fmt::join(tables, " and ")));
  }
  const bool may_choose = std::ranges::find(contract.parameters, parameter) != contract.parameters.end();
  if (may_choose && scenario.node(taken->key) == nullptr) {
    root.reject(taken->key,
                fmt::format("is missing, and parameter {} = {:g} takes no other fixes", parameter,
                            taken->aid->aiding),
                fmt::format("a table, or {} = {}", parameter, fmt::join(others, " or ")));
  }
}

std::uint64_t hash_of(std::string_view text, std::span<const Setting> settings) {
  std::string all(text);
  for (const Setting& setting : settings) all += fmt::format("{} = {}\n", setting.key, setting.value);
  return world::fnv1a_64(all);
}

}  // namespace

std::string why_no_truth(const Scenario& scenario, const world::TruthValue& value) {
  using enum world::TruthIn;
  const PlantFacts* shown = scenario.plant_with(value.name);
  // A plant that shows the motion of its own replaces the flight of the carrier.
  if (value.in == motion && shown == nullptr) shown = scenario.plant_with("velocity.north");
  if (shown != nullptr)
    return shown->table == nullptr ? "" : why_no_truth(scenario, shown->table->shows.front());
  if (value.in != plant) return why_no_truth(scenario, "");
  if (!value.name.starts_with(world::plant_prefix))
    return fmt::format("no truth of {}: no plant of the scenario has it", value.name);
  if (scenario.plant.setup == nullptr)
    return fmt::format("no truth of {}: the scenario has no [plant]", value.name);
  std::vector<std::string> outputs;
  for (const PlantFacts::Output& one : scenario.plant.outputs) outputs.push_back(one.name);
  return fmt::format("no truth of {}: the plant has only {}", value.name, fmt::join(outputs, ", "));
}

// If a node of a plant is recorded, the plant that the bench simulates is unrelated to the recording.
std::string why_no_truth(const Scenario& scenario, std::string_view samples) {
  if (samples.empty()) return scenario.truth_is_known() ? "" : "no truth: trajectory is \"unknown\"";
  const PlantFacts* of = scenario.plant_with(samples);
  if (of == nullptr) return fmt::format("no truth: no plant of the scenario has {}", samples);
  const auto recorded = std::ranges::find_if(scenario.nodes, [&](const NodeSettings& node) {
    return scenario.plant_with(node.table().samples) == of && node.is_recorded();
  });
  return recorded == scenario.nodes.end() ? ""
                                          : fmt::format("no truth: [{}] is recorded", recorded->table().key);
}

// An estimator depends on the truth that its nodes sample.
std::string why_no_truth(const Scenario& scenario, const EstimatorFacts& facts) {
  for (const NodeSettings& node : scenario.nodes) {
    if (std::ranges::find(facts.nodes, node.table().key) == facts.nodes.end()) continue;
    if (std::string why = why_no_truth(scenario, node.table().samples); !why.empty()) return why;
    if (node.table().samples.empty()) break;
  }
  return "";
}

Result<Scenario> parse(std::string_view text, std::string_view name, const DbcVocabulary& contract,
                       std::span<const Setting> settings, std::optional<std::string> folder) {
  Section root = Section::parse(text, name, settings);
  if (folder) root.look_in(std::move(*folder));
  Scenario scenario;
  scenario.file = name;
  scenario.settings.assign(settings.begin(), settings.end());
  scenario.hash = hash_of(text, settings);
  scenario.title = root.text({"title", "One line, shown in every report."});
  constexpr double longest_s = 86'400;
  scenario.duration_us = root.time_us({"duration_s", "Length of the run."}, Limits::above(0, longest_s));
  // root.finish() reports that the key is missing. Until then, no time is after the end of the run.
  if (!root.has("duration_s")) scenario.duration_us = static_cast<std::int64_t>(1e6 * longest_s);
  scenario.fd = read_fd(root, *contract.binding);
  scenario.seed =
      static_cast<std::uint64_t>(root.integer({"seed",
                                               "Seed of all random numbers: the same seed gives the same "
                                               "frames. The option `--seed` overrides this key."},
                                              0));
  scenario.binding = contract.binding;
  scenario.targets = read_targets(root, contract);
  for (const PlantTable* plant : contract.plants) read_plant(root, scenario, contract, *plant);
  read_nodes_of_plants(root, scenario, contract, false);
  if (contract.read_plant != nullptr && root.has("plant")) {
    std::vector<std::string> recordings = std::exchange(root.files(), {});
    Section plant = root.table("plant");
    scenario.plant = contract.read_plant(plant, *contract.binding);
    plant.finish();
    for (const std::string& path : std::exchange(root.files(), std::move(recordings)))
      scenario.inputs.push_back({"plant", path});
  }
  root.optional("plant");
  read_navigation(root, scenario, contract);
  if (!contract.binding->handshake && !root.has("start"))
    root.refuse("initial_error", no_start, "a table [start] beside it");
  if (auto initial_error = root.optional_table("initial_error")) {
    scenario.initial_error = read_initial_error(*initial_error);
  }
  read_nodes(root, scenario, contract, nullptr);
  if (!contract.binding->any_sensor) expect_aid(root, scenario, contract);
  read_nodes_of_plants(root, scenario, contract, true);
  read_sensors(root, scenario, contract);
  scenario.programs = read_node_programs(root);
  if (contract.binding->handshake) add_stated(scenario.targets, scenario.nodes, contract);
  if (!scenario.truth_is_known()) refuse_errors_of_start(root, scenario);
  scenario.events = read_events(root, *contract.binding, scenario.duration_us);
  read_faults(root, {.duration_us = scenario.duration_us, .contract = contract, .nodes = scenario.nodes},
              scenario.faults);
  scenario.checks = read_checks(root, scenario, contract);
  root.finish();
  if (const std::optional<Error> error = root.error()) return tl::unexpected(*error);
  scenario.recordings_hash = root.files_hash();
  for (const std::string& path : root.files()) scenario.inputs.push_back({"recording", path});
  if (scenario.recordings_hash != 0)
    scenario.hash = world::fnv1a_64(fmt::format("{:016x}", scenario.recordings_hash), scenario.hash);
  return scenario;
}

Result<void> add_faults(Scenario& scenario, std::string_view text, std::string_view name,
                        const DbcVocabulary& contract, const FaultPlaces* some) {
  Section root = Section::parse(text, name);
  if (!root.has("fault")) root.tables("fault");  // reports the missing key: the file contains only faults
  read_faults(root, {.duration_us = scenario.duration_us, .contract = contract, .nodes = scenario.nodes},
              scenario.faults, some);
  root.finish();
  if (const std::optional<Error> error = root.error()) return tl::unexpected(*error);
  scenario.hash = world::fnv1a_64(text, scenario.hash);
  scenario.inputs.push_back({"faults", std::string(name)});
  return {};
}

Result<Scenario> read_file(const std::filesystem::path& path, const DbcVocabulary& contract) {
  const auto text = read_text_file(path, "a scenario file", most_toml_bytes);
  if (!text) return tl::unexpected(text.error());
  return parse(*text, path.string(), contract);
}

}  // namespace canhil::scenario
