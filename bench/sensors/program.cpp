#include "bench/sensors/program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "bench/scenario/program.hpp"
#include "bench/sensors/sampler.hpp"

namespace canhil::sensors {
namespace {

using processes::Conversation;
using processes::Variable;

processes::program_protocol::Opening opening(const NodeTable& table, std::uint64_t seed = 0,
                                             std::uint64_t run_index = 0) {
  return {.role = "sensor", .name = table.key, .seed = seed, .run_index = run_index};
}

// The unit as a program declares it: a plain number has none.
std::string_view declared_unit(std::string_view si) { return si == plain_number ? "" : si; }
std::string_view shown_unit(std::string_view si) { return si.empty() ? plain_number : si; }

std::string other_unit(const Variable& one, std::string_view si) {
  return fmt::format("'{}' is declared in '{}', expected '{}'", one.name, shown_unit(one.si),
                     shown_unit(declared_unit(si)));
}

// Error, one phrase: an input is no true value of this unit.
Result<std::vector<const world::TruthValue*>> inputs_of(const std::vector<Variable>& declared) {
  std::vector<const world::TruthValue*> inputs;
  for (const Variable& one : declared) {
    const world::TruthValue* value = world::find_truth_value(one.name);
    if (value == nullptr)
      return failure(
          fmt::format("input '{}' is no true value, expected one of docs/quantities.md", one.name));
    if (value->in != world::TruthIn::plant && declared_unit(value->si) != one.si)
      return failure("input " + other_unit(one, value->si));
    inputs.push_back(value);
  }
  return inputs;
}

// Error, one phrase: the outputs are not the values of the sensor.
Result<std::vector<Place>> outputs_of(const Outputs& sensor, const std::vector<Variable>& declared) {
  std::vector<Place> outputs;
  for (const Variable& one : declared) {
    const auto place = place_of(sensor, one.name);
    if (!place) {
      std::vector<std::string_view> names;
      for (const Output& value : sensor.values) names.push_back(value.name);
      return failure(fmt::format("output '{}' is no value of the sensor, expected {}", one.name,
                                 fmt::join(names, ", ")));
    }
    const std::string_view si =
        place->role == Role::value ? sensor.values[place->index].si : std::string_view{};
    if (declared_unit(si) != one.si) return failure("output " + other_unit(one, si));
    outputs.push_back(*place);
  }
  for (const Output& value : sensor.values) {
    if (!value.assumed && std::ranges::find(declared, value.name, &Variable::name) == declared.end())
      return failure(fmt::format("output '{}' is missing, expected 'output {} {}'", value.name, value.name,
                                 shown_unit(declared_unit(value.si))));
  }
  return outputs;
}

class ProgramSensor final : public LossySampler<ProgramSettings> {
 public:
  ProgramSensor(const NodeSettings& node, const Run& run)
      : LossySampler(node, run, std::string(node.table().key) + ".loss"),
        truths_{.flight = run.flight, .plants = run.plants},
        period_us_(static_cast<double>(node.period_us())),
        known_ahead_(!run.flight.grows() && run.plants.empty()),
        inputs_(config_.inputs.size()) {
    for (const Output& value : node.table().sensor->outputs.values) {
      adds_up_ = adds_up_ || !value.rate.empty();
      assumed_.push_back(value.assumed.value_or(0));
    }
    auto started = Conversation::start(config_.program, opening(node.table(), run.scenario.seed, run.index));
    if (!started) {
      fail(started.error().message);
      return;
    }
    conversation_ = *std::move(started);
    if (!(conversation_->declared() == config_.declared))
      fail(
          fmt::format("program '{}' at its start: declares other inputs or outputs than when the scenario "
                      "was read, expected the same",
                      config_.program.command));
  }

 private:
  void fill(std::int64_t t_us, Sample& sample) override {
    if (asked_us_ != t_us) ask(t_us);
    if (conversation_ != nullptr) {
      if (auto done = conversation_->answer(); !done) fail(done.error().message);
    }
    if (conversation_ == nullptr) {
      sample.fate = Sample::Fate::none;
      return;
    }
    std::ranges::copy(assumed_, sample.values.begin());
    if (adds_up_) sample.interval_us = period_us_;
    const auto answered = conversation_->outputs();
    for (std::size_t i = 0; i < answered.size(); ++i) {
      const auto [role, index] = config_.outputs[i];
      if (role == Role::value)
        sample.values[index] = answered[i];
      else if (answered[i] == 0)
        sample.invalid |= 1U << index;
    }
  }
  // The program computes the next sample while the bench sends the last one.
  void next_is(std::int64_t t_us) override {
    if (known_ahead_ && t_us <= run_.flight.end_us()) ask(t_us);
  }

  void ask(std::int64_t t_us) {
    if (conversation_ == nullptr) return;
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      const auto value = config_.inputs[i]->at(truths_, t_us);
      if (!value)
        return fail(fmt::format("program '{}' at {} s: the run has no truth of its input '{}'",
                                config_.program.command, 1e-6 * static_cast<double>(t_us),
                                conversation_->declared().inputs[i].name));
      inputs_[i] = *value;
    }
    conversation_->ask(std::exchange(asked_us_, t_us), t_us, inputs_);
  }
  void fail(std::string why) {
    conversation_.reset();
    if (run_.fail) run_.fail(std::move(why));
  }

  world::Truths truths_;
  double period_us_;
  bool known_ahead_;  // nothing that the target does changes the truth of the next sample
  bool adds_up_ = false;
  std::vector<double> inputs_, assumed_;
  std::int64_t asked_us_ = 0;
  std::unique_ptr<Conversation> conversation_;  // null: it failed
};

}  // namespace

NodeSettings read_program(const NodeTable& table, Section& section) {
  ProgramSettings node;
  node.schedule = read_schedule(section);
  node.loss = read_sample_loss(section);
  auto program = scenario::read_program(section);
  if (!program || section.error()) return {table, node};
  node.program = *std::move(program);
  const auto started = Conversation::start(node.program, opening(table));
  if (!started) {
    section.reject("command", started.error());
    return {table, node};
  }
  const auto wrong = [&](const std::string& what) {
    section.reject("command", Error{fmt::format("program '{}': {}", node.program.command, what)});
  };
  node.declared = (*started)->declared();
  auto inputs = inputs_of((*started)->declared().inputs);
  auto outputs = outputs_of(table.sensor->outputs, (*started)->declared().outputs);
  if (!inputs)
    wrong(inputs.error().message);
  else if (!outputs)
    wrong(outputs.error().message);
  else {
    node.inputs = *std::move(inputs);
    node.outputs = *std::move(outputs);
  }
  return {table, node};
}

std::unique_ptr<Sensor> make_program(const NodeSettings& node, const Run& run) {
  return std::make_unique<ProgramSensor>(node, run);
}

std::string why_no_truth(const NodeSettings& node, const scenario::Scenario& scenario) {
  if (const auto* program = node.own<ProgramSettings>()) {
    for (const world::TruthValue* value : program->inputs) {
      if (std::string why = scenario::why_no_truth(scenario, *value); !why.empty()) return why;
    }
    return {};
  }
  const Kind& kind = *node.table().sensor;
  return kind.why_no_truth == nullptr || node.is_recorded() ? "" : kind.why_no_truth(node, scenario);
}

}  // namespace canhil::sensors
