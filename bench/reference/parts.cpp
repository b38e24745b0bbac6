#include "bench/reference/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "bench/campaign/campaign.hpp"
#include "bench/campaign/metric.hpp"
#include "bench/campaign/variants.hpp"
#include "bench/drive/contract.hpp"
#include "bench/drive/target_parameters.hpp"
#include "bench/nodes/registry.hpp"
#include "bench/reference/tables.hpp"
#include "bench/scenario/events.hpp"
#include "bench/scenario/faults.hpp"
#include "bench/scenario/node.hpp"
#include "bench/scenario/program.hpp"
#include "bench/scenario/scenario.hpp"
#include "bench/scenario/section.hpp"
#include "bench/scenario/sensor_name.hpp"
#include "bench/sensors/registry.hpp"

namespace canhil::reference {
namespace {

std::vector<AskedKey> keys_of_file(const scenario::DbcVocabulary& contract) {
  const auto all =
      explore([&](std::string_view text) { std::ignore = scenario::parse(text, file, contract); }, "",
              Depth::as_it_is);
  const auto dbc =
      explore([&](std::string_view text) { std::ignore = scenario::parse(text, file, contract); },
              "dbc = \"canhil\"\n", Depth::as_it_is);
  std::vector<AskedKey> keys = in_table(all, "");
  for (AskedKey& one : in_table(dbc, "")) {
    if (one.key.name != "dbc") continue;
    one.key.required = false;
    keys.push_back(std::move(one));
  }
  return keys;
}

Part target_part(const scenario::DbcVocabulary& contract) {
  const auto keys = keys_of([&](Section& root) { scenario::read_targets(root, contract); });
  scenario::DbcVocabulary mapped = contract;
  mapped.binding = std::make_shared<const AnyBinding>();
  const auto own = keys_of([&](Section& root) { scenario::read_targets(root, mapped); });
  Part part{
      .title = "The target",
      .about =
          "There is one table `[target]`, or one table `[[target]]` for each estimator that the target runs.",
      .tables = {{.name = "[target]", .about = "", .keys = in_table(keys, "target")},
                 {.name = "[target.initial_sigma]",
                  .about = "At the start, the bench sends an initial state to the target, with the 1-sigmas "
                           "of this table. The estimator `los_rate` does not need the table.",
                  .keys = in_table(keys, "target.initial_sigma")},
                 {.name = "[target] with a mapping",
                  .about = "The keys for a target that has its own DBC (mapping.md).",
                  .keys = in_table(own, "target")}}};
  for (Table& table : part.tables)
    for (AskedKey& one : table.keys) one.only.clear();  // the conditions name values of another DBC
  return part;
}

Part parameters_part() {
  Part part{.title = "Parameters of the target",
            .about =
                "The bench sets each parameter of `[target.parameters]` over the bus and reads it back. The "
                "ranges and defaults are those of hil-target; a target of your own may have others. A target "
                "refuses a value that is out of its range. 'Set before the start' means that the target "
                "refuses a change of the parameter while the estimator runs. If a meaning begins with names "
                "of algorithms and a colon, the parameter has an effect only with these algorithms.",
            .tables = {}};
  for (const drive::ParametersOf& of : drive::target_parameters()) {
    Table table{.name = std::string(of.estimator), .about = "", .keys = {}};
    for (const drive::TargetParameter& one : of.parameters) {
      auto key = scenario::described_number(one.whole ? "whole number" : "number",
                                            scenario::Limits::between(one.minimum, one.maximum), one.initial);
      key.name = key.shown = one.name;
      key.meaning = one.meaning;
      key.table = "target.parameters";
      table.keys.push_back({.key = std::move(key), .only = one.while_running ? "" : "Set before the start."});
    }
    part.tables.push_back(std::move(table));
  }
  return part;
}

Part nodes_part(const scenario::DbcVocabulary& contract) {
  Part part{.title = "Nodes", .about = "Each table puts a node on the bus.", .tables = {}};
  const auto keys = [](const scenario::NodeTable& node) {
    return keys_of([&](Section& section) { std::ignore = node.read(node, section); });
  };
  for (const scenario::NodeTable* node : contract.nodes) {
    if (!node->only_named)
      part.tables.push_back({.name = fmt::format("[{}]", node->key), .about = "", .keys = keys(*node)});
  }
  part.tables.push_back(
      {.name = "Any node that sends recorded samples",
       .about =
           "A node that sends recorded samples has these keys in place of its usual keys (recorded-data.md).",
       .keys = keys_of(
           [&](Section& section) {
             std::ignore = contract.read_recorded(*contract.nodes.front(), section, longest_run_us);
           },
           "recorded = \"samples.csv\"\n")});
  part.tables.push_back(
      {.name = "Any sensor that a program computes",
       .about = "A sensor that a program of the user computes has these keys in place of its usual keys "
                "(programs.md).",
       .keys = keys_of([&](Section& section) {
         std::ignore = contract.read_program(*contract.nodes.front(), section);
       })});
  part.tables.push_back(
      {.name = "[[sensor]]",
       .about =
           "Any number of further sensors, for a target with a mapping that plays them (mapping.md). The "
           "other keys are those of the table of its kind.",
       .keys = keys_of(
           [&](Section& section) { std::ignore = scenario::read_sensor_name(section, contract, {}); })});
  part.tables.push_back(
      {.name = "[[node]]",
       .about = "A program of the user that is a node of the bus (programs.md).",
       .keys =
           in_table(keys_of([&](Section& section) { std::ignore = scenario::read_node_programs(section); },
                            "[[node]]\nname = \"NAME\"\n"),
                    "node[1]")});
  std::vector<AskedKey>& of_node = part.tables.back().keys;
  for (AskedKey& one : keys_of([&](Section& section) { std::ignore = scenario::read_program(section); })) {
    const auto is_it = [&](const AskedKey& other) { return other.key.name == one.key.name; };
    if (std::ranges::none_of(of_node, is_it)) of_node.push_back(std::move(one));
  }
  // Any sensor that a mapping could declare.
  const auto all = keys(nodes::bound(sensors::declared("sensor", {{.name = "VALUE", .si = "rad"}})).table);
  part.tables.push_back({.name = "[[sensor]] of kind `generic`",
                         .about = "Measures what expressions compute from the truth (mapping.md).",
                         .keys = in_table(all, "")});
  part.tables.push_back({.name = "[sensor.values.VALUE]",
                         .about = "A value that the mapping declares, in its SI unit.",
                         .keys = in_table(all, "values.VALUE")});
  return part;
}

/// The settings of every node, with the default of every key.
std::vector<scenario::NodeSettings> every_node(const scenario::DbcVocabulary& contract) {
  std::vector<scenario::NodeSettings> nodes;
  for (const scenario::NodeTable* node : contract.nodes) {
    Section section = Section::parse("", file);
    nodes.push_back(node->read(*node, section));
  }
  return nodes;
}

Part faults_part(const scenario::DbcVocabulary& contract) {
  const auto nodes = every_node(contract);
  const scenario::FaultContext context{.duration_us = longest_run_us, .contract = contract, .nodes = nodes};
  const auto of_all = explore(
      [&](std::string_view text) {
        Section root = Section::parse(text, file);
        std::vector<scenario::Fault> faults;
        scenario::read_faults(root, context, faults);
      },
      "[[fault]]\n", Depth::as_it_is);
  Part part{.title = "Faults",
            .about =
                "A scenario may have any number of `[[fault]]` tables (faults.md). If a key has two rows in "
                "the next table, it is required for some kinds of faults and optional for others.",
            .tables = {}};
  part.tables.push_back({.name = "[[fault]]", .about = "", .keys = in_table(of_all, "fault[1]")});
  for (const scenario::FaultKind& kind : contract.fault_kinds)
    part.tables.push_back({.name = std::string(kind.name),
                           .about = std::string(kind.meaning),
                           .keys = keys_of([&](Section& section) { kind.read(section, context); })});
  return part;
}

Part events_part() {
  const AnyBinding binding;
  const auto keys = explore(
      [&](std::string_view text) {
        Section root = Section::parse(text, file);
        scenario::read_events(root, binding, longest_run_us);
      },
      "[[event]]\nchannel = \"CHANNEL\"\n", Depth::as_it_is);
  return {
      .title = "Events",
      .about =
          "A scenario of a target with a mapping may have any number of `[[event]]` tables: what the bench "
          "says beside its samples (scenarios.md). An event has one of the keys `at`, `at_s`, `when`, "
          "`flag_set`, `flag_clear`, `after`.",
      .tables = {{.name = "[[event]]", .about = "", .keys = in_table(keys, "event[1]")}}};
}

Part checks_part(const scenario::DbcVocabulary& contract) {
  scenario::DbcVocabulary mapped = contract;
  mapped.binding = std::make_shared<const AnyBinding>();
  const std::vector<scenario::FaultWindow> faults{{.name = "NAME", .window = {.from_us = 0, .to_us = 1}}};
  const auto context_of = [&](const scenario::DbcVocabulary& by) {
    return scenario::CheckContext{
        .duration_us = longest_run_us, .contract = by, .estimators = contract.estimators, .faults = faults};
  };
  const auto own = context_of(contract), with_mapping = context_of(mapped);
  const auto of_all = explore(
      [&](std::string_view text) {
        Section section = Section::parse(text, file);
        scenario::read_check(section, own);
      },
      "", Depth::as_it_is);
  Part part{.title = "Checks",
            .about =
                "A scenario has at least one `[[check]]` table (scenarios.md). In virtual time the "
                "outcome of a timing check is 'not measured', except on a simulated wire.",
            .tables = {}};
  part.tables.push_back({.name = "[[check]]", .about = "", .keys = of_all});
  for (const scenario::CheckKind& kind : contract.check_kinds)
    part.tables.push_back({.name = std::string(kind.name),
                           .about = std::string(kind.meaning),
                           .keys = explore([&](std::string_view text) {
                             for (const auto* context : {&own, &with_mapping}) {
                               Section section = Section::parse(text, file);
                               kind.read(section, *context);
                             }
                           })});
  return part;
}

Part campaign_part() {
  const auto with = [](const std::string& given) {
    return explore(
        [](std::string_view text) {
          std::ignore = campaign::parse_campaign(
              text, file, [](const std::string& /*name*/) -> Result<std::string> { return failure("none"); });
        },
        given, Depth::as_it_is);
  };
  const std::vector<campaign::Given> variants{{.name = "NAME"}, {.name = "OTHER"}};
  const auto read_metric = [&](Section& section) {
    campaign::read_metric(section, variants, longest_run_us);
  };
  auto root = in_table(with("sweep = {}\n"), "");
  const auto of_all = explore(
      [&](std::string_view text) {
        Section section = Section::parse(text, file);
        read_metric(section);
      },
      "", Depth::as_it_is);
  Part part{.title = "Campaigns",
            .about = "The keys of a campaign file (campaigns.md).",
            .tables = {{.name = "Campaign", .about = "", .keys = std::move(root)},
                       {.name = "[[variant]]",
                        .about = "A campaign has at least one variant.",
                        .keys = in_table(with("[[variant]]\nset = {}\n"), "variant[1]")},
                       {.name = "[faults]",
                        .about = "Flies each variant with faults (campaigns.md).",
                        .keys = in_table(with("faults = {}\n"), "faults")},
                       {.name = "[[check]]",
                        .about = "A check of every run has the keys that it has in a scenario, and these.",
                        .keys = in_table(with("[[check]]\n"), "check[1]")},
                       {.name = "[[metric]]", .about = "", .keys = {}}}};
  for (const AskedKey& one : of_all) {
    if (one.key.name != "quantity") part.tables.back().keys.push_back(one);
  }
  for (const campaign::MetricKind& kind : campaign::metric_kinds()) {
    Table table{.name = std::string(kind.name), .about = std::string(kind.meaning), .keys = {}};
    const auto keys = keys_of(read_metric, fmt::format("kind = \"{}\"\n", kind.name));
    std::ranges::copy_if(keys, std::back_inserter(table.keys), [&](const AskedKey& one) {
      return one.key.shown == "quantity" || std::ranges::none_of(of_all, [&](const AskedKey& other) {
               return other.key.shown == one.key.shown;
             });
    });
    part.tables.push_back(std::move(table));
  }
  return part;
}

}  // namespace

std::vector<Part> parts() {
  const scenario::DbcVocabulary contract = drive::contract();
  return {{.title = "The file",
           .about = "",
           .tables = {{.name = "Scenario", .about = "", .keys = keys_of_file(contract)}}},
          target_part(contract),
          parameters_part(),
          truth_part(contract),
          plants_part(),
          nodes_part(contract),
          faults_part(contract),
          events_part(),
          checks_part(contract),
          campaign_part()};
}

}  // namespace canhil::reference
