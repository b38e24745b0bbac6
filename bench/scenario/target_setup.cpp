#include "bench/scenario/target_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bench/scenario/binding.hpp"
#include "bench/scenario/commands.hpp"
#include "bench/scenario/initial_error.hpp"
#include "bench/scenario/section.hpp"
#include "bench/world/units.hpp"

namespace canhil::scenario {
namespace {

InitialSigma read_initial_sigma(Section section, const TargetSetup& target) {
  const InitialSigma sigma{
      .velocity = section.number({"velocity_mps", "1-sigma of each component of the initial velocity."},
                                 Limits::above(0)),
      .tilt =
          section.number({"tilt_deg", "1-sigma of each of the initial misalignments about north and east."},
                         Limits::above(0, 90)),
      .heading = section.number({"heading_deg",
                                 "1-sigma of the initial heading. At most 180; with the algorithm `sin_cos` "
                                 "at most 600, for an unknown heading."},
                                Limits::above(0, 600)),
      .position = section.number({"position_m", "1-sigma of each component of the initial position."},
                                 Limits::above(0))};
  constexpr double half_turn = 180 * world::units::deg;
  if (sigma.heading > half_turn && target.algorithm != "sin_cos")
    section.reject("heading_deg", "is more than a heading can be wrong by",
                   "at most 180, or algorithm sin_cos");
  section.finish();
  return sigma;
}

std::vector<Parameter> read_parameters(Section section, const DbcVocabulary& contract,
                                       const std::string& estimator) {
  const auto own = facts_of(contract, estimator).parameters;
  const auto may_be_meant = [&](const std::string& name) {
    return own.empty() || std::ranges::find(own, name) != own.end();
  };
  constexpr double largest = 3.4e38;  // ParamSet carries an IEEE single
  std::vector<Parameter> parameters;
  for (const std::string& name : contract.parameters) {
    const bool given = section.has(name);  // the target rejects a parameter of another estimator
    if (!given && !may_be_meant(name)) continue;
    const double value = section.plain_number(name, Limits::between(-largest, largest), 0.0);
    if (!given) continue;
    parameters.push_back({.name = name,
                          .value = value,
                          .where = fmt::format("{}: key '{}'", section.where(name), section.path(name))});
  }
  section.finish();
  return parameters;
}

/// Without a handshake the target receives no parameters and no initial state, so a scenario cannot set them.
/// Its estimator is that of its mapping.
TargetSetup read_own_start(Section& section, const DbcVocabulary& contract, std::size_t number) {
  static const std::vector<std::string> none{"none"};
  section.one_of(
      {"handshake",
       "Only with `mapping`. The only value is `none`: the bench sends no commands to the target."},
      none, none.front());
  section.text({"mapping",
                "Mapping file of a target that has a DBC of its own, relative to the scenario file "
                "(mapping.md)."});  // this key was already
                                    // read, to choose the vocabulary
  TargetSetup target;
  if (number < contract.estimators.size()) target.estimator = contract.estimators[number];
  target.own_start = {
      .settle_us = section.time_us(
          {"settle_s", "With `mapping`: time that the bench waits before it sends the first sample."},
          Limits::between(0, 3600), 0.5),
      .silence_us = section.time_us({"silence_s",
                                     "With `mapping`, in real time: the run ends if the target sends nothing "
                                     "for longer than this time."},
                                    Limits::above(0, 3600), 1.0),
      .before = section.text(
          {"before", "With `mapping`: shell command that is run before the flight; it must exit with 0."},
          ""),
      .after = section.text({"after",
                             "With `mapping`: shell command that is run after the flight, also if the flight "
                             "failed or was interrupted; it must exit with 0."},
                            "")};
  for (const auto& [key, command] :
       {std::pair("before", target.own_start->before), std::pair("after", target.own_start->after)}) {
    if (!command.empty()) may_execute(section, key, fmt::format("is a shell command ('{}')", command));
  }
  section.finish();
  return target;
}

TargetSetup read_target(Section& section, const DbcVocabulary& contract) {
  for (const std::string_view key : {"handshake", "settle_s", "silence_s", "before", "after"})
    section.refuse(key, "is for a target with a mapping", "the key 'mapping' beside it");
  TargetSetup target;
  target.estimator = section.one_of(
      {"estimator", "Name of the estimator that the target runs, from the DBC's value table Estimator."},
      contract.estimators);
  target.algorithm = section.one_of({"algorithm",
                                     "Name of the estimator's algorithm, from the DBC's value table "
                                     "Algorithm. scenarios.md lists the algorithms of each estimator."},
                                    contract.algorithms);
  target.algorithm_where = fmt::format("{}: key '{}'", section.where("algorithm"), section.path("algorithm"));
  // Every target receives an initial state at the start; an estimator that does not navigate ignores this
  // state.
  const EstimatorFacts facts = facts_of(contract, target.estimator);
  if (facts.start != Start::nothing || section.has("initial_sigma"))
    target.initial_sigma = read_initial_sigma(section.table("initial_sigma"), target);
  section.optional("initial_sigma");
  if (auto parameters = section.optional_table("parameters")) {
    target.parameters = read_parameters(*std::move(parameters), contract, target.estimator);
  }
  static const std::vector<std::string> handling{"sent", "withheld"};
  target.data_sheets_withheld =
      section.one_of(
          {"data_sheets",
           "Whether the target is sent the parameters that the data sheets of the simulated sensors "
           "state. With `withheld` it has its defaults."},
          handling, handling.front()) == handling.back();
  if (facts.start != Start::navigation) {
    const auto own =
        std::ranges::find_if(contract.plants, [&](const PlantTable* one) { return one->has(facts.truth); });
    const bool has_own = facts.start == Start::per_run_truth && own != contract.plants.end();
    section.refuse("initial_error", fmt::format("has no effect on '{}'", target.estimator),
                   has_own ? fmt::format("[{}.initial_error]", (*own)->key) : "no such table");
  }
  if (auto initial_error = section.optional_table("initial_error"))
    target.initial_error = read_initial_error(*initial_error);
  section.finish();
  return target;
}

}  // namespace

void add_stated(std::vector<TargetSetup>& targets, std::span<const NodeSettings> nodes,
                const DbcVocabulary& contract) {
  for (TargetSetup& target : targets) {
    if (target.data_sheets_withheld) continue;
    const auto known = facts_of(contract, target.estimator).parameters;
    for (const NodeSettings& node : nodes) {
      if (!node.is_modelled() || node.table().data_sheet == nullptr) continue;
      for (const Stated& stated : node.table().data_sheet(node)) {
        const std::string name(stated.name);
        const bool set =
            std::ranges::find(target.parameters, name, &Parameter::name) != target.parameters.end();
        if (set || std::ranges::find(known, stated.name) == known.end()) continue;
        target.parameters.push_back({.name = name,
                                     .value = stated.value,
                                     .where = fmt::format("data sheet of {}", node.table().key),
                                     .stated = true});
      }
    }
  }
}

std::vector<TargetSetup> read_targets(Section& root, const DbcVocabulary& contract) {
  std::vector<TargetSetup> targets;
  for (Section& section : root.table_or_tables("target")) {
    const bool mapped = !contract.binding->handshake;
    TargetSetup target =
        mapped ? read_own_start(section, contract, targets.size()) : read_target(section, contract);
    if (!section.error() &&
        std::ranges::find(targets, target.estimator, &TargetSetup::estimator) != targets.end()) {
      section.reject(mapped ? "mapping" : "estimator",
                     fmt::format("'{}' is the name of another [[target]] too", target.estimator),
                     mapped ? "a mapping with another 'name'" : "each estimator once");
    }
    targets.push_back(std::move(target));
  }
  return targets;
}

}  // namespace canhil::scenario
