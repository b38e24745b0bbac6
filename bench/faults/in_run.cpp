#include "bench/faults/in_run.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace canhil::faults {

Result<void> check(std::span<const scenario::Fault> faults, const Place& place) {
  for (const scenario::Fault& fault : faults) {
    if (const std::string why = fault.rule->cannot(place); !why.empty())
      return failure(fmt::format("{}: '{}' {}", fault.where, fault.kind, why));
  }
  return {};
}

Result<void> check_begins(const scenario::Scenario& scenario, bool has_partners) {
  for (const scenario::Fault& fault : scenario.faults) {
    const When& when = fault.rule->when();
    if (when.on_command && !has_partners)
      return failure(fmt::format("{}: '{}' waits for a command, expected a [[node]], or --control",
                                 fault.where, fault.name));
    if (!when.condition) continue;
    if (const std::string why = scenario::why_no_truth(scenario, *when.condition); !why.empty())
      return failure(fmt::format("{}: the condition of '{}' has {}", fault.where, fault.name, why));
  }
  return {};
}

Faults::Faults(const scenario::Scenario& scenario, std::uint64_t run_index,
               std::span<const MessageInfo> messages, Place place, RigControl* hands)
    : scenario_(scenario),
      run_index_(run_index),
      messages_(messages),
      place_(std::move(place)),
      rig_(hands),
      tallies_(scenario.faults.size()),
      triggers_(scenario.faults.size()),
      ended_(scenario.faults.size()),
      begin_in_run_(std::ranges::any_of(scenario.faults, &scenario::Fault::begins_in_run)) {
  for (std::size_t i = 0; i < tallies_.size(); ++i) {
    if (!scenario.faults[i].rule->cannot(place_).empty()) continue;  // check() rejects such a run
    if (auto injector = scenario.faults[i].rule->injector(in_run(i)))
      injectors_.push_back(std::move(injector));
  }
}

InRun Faults::in_run(std::size_t index) {
  return {.fault = scenario_.faults[index],
          .seed = scenario_.seed,
          .run_index = run_index_,
          .end_us = scenario_.duration_us,
          .messages = messages_,
          .place = place_,
          .hands = rig_,
          .tally = tallies_[index],
          .trigger = scenario_.faults[index].begins_in_run ? &triggers_[index] : nullptr};
}

void Faults::look(const world::Truths& truths, std::int64_t t_us) {
  for (std::size_t i = 0; i < triggers_.size(); ++i) {
    const When& when = scenario_.faults[i].rule->when();
    if (!when.condition || triggers_[i].from_us != Trigger::never_us) continue;
    if (when.condition->at(truths, t_us).value_or(0) == 0) continue;
    triggers_[i].from_us = t_us;
    if (when.lasts_us != Trigger::never_us) triggers_[i].to_us = t_us + when.lasts_us;
  }
}

Result<bool> Faults::command(std::string_view name, bool begins, std::int64_t t_us) {
  const auto found = std::ranges::find(scenario_.faults, name, &scenario::Fault::name);
  if (found == scenario_.faults.end() || !found->rule->when().on_command)
    return failure(fmt::format("there is no fault '{}' with when = \"command\"", name));
  Trigger& trigger = triggers_[static_cast<std::size_t>(found - scenario_.faults.begin())];
  const std::int64_t lasts_us = found->rule->when().lasts_us;
  const bool is_active = t_us >= trigger.from_us && t_us < trigger.to_us;
  if (is_active == begins || (begins && t_us == trigger.to_us)) return false;
  if (begins && trigger.from_us != Trigger::never_us)
    ended_[static_cast<std::size_t>(found - scenario_.faults.begin())].push_back(trigger);
  if (begins)
    trigger = {.from_us = t_us, .to_us = lasts_us == Trigger::never_us ? lasts_us : t_us + lasts_us};
  else
    trigger.to_us = t_us;
  return true;
}

bool Faults::act_on(const scenario::NodeSettings& node) const {
  return std::ranges::any_of(scenario_.faults,
                             [&](const scenario::Fault& fault) { return fault.rule->acts_on(node.table()); });
}

std::unique_ptr<sensors::Sensor> Faults::with_faults(std::unique_ptr<sensors::Sensor> sensor,
                                                     const scenario::NodeSettings& node) {
  for (std::size_t i = 0; i < tallies_.size(); ++i) {
    const auto& rule = scenario_.faults[i].rule;
    if (rule->acts_on(node.table())) sensor = rule->with_fault(std::move(sensor), node, in_run(i));
  }
  return sensor;
}

std::vector<FaultReport> Faults::reports() const {
  std::vector<FaultReport> all;
  for (std::size_t i = 0; i < tallies_.size(); ++i) {
    const scenario::Fault& fault = scenario_.faults[i];
    std::vector<Trigger> windows = ended_[i];
    if (!fault.begins_in_run)
      windows.push_back({.from_us = fault.from_us, .to_us = fault.to_us});
    else if (triggers_[i].from_us != Trigger::never_us)
      windows.push_back(triggers_[i]);
    for (Trigger& window : windows) window.to_us = std::min(window.to_us, scenario_.duration_us);
    all.push_back({.name = fault.name,
                   .kind = fault.kind,
                   .stage = fault.rule->stage(),
                   .count = tallies_[i].count,
                   .windows = std::move(windows)});
  }
  return all;
}

Tally Faults::tally() const {
  Tally sum;
  for (const Tally& one : tallies_) {
    sum.count += one.count;
    sum.changed += one.changed;
    sum.changed_times += one.changed_times;
    sum.overtaken += one.overtaken;
  }
  return sum;
}

}  // namespace canhil::faults
