#include "bench/plant/setup.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "bench/plant/registry.hpp"
#include "bench/scenario/binding.hpp"
#include "bench/scenario/nearest.hpp"
#include "bench/scenario/quantity.hpp"
#include "bench/scenario/section.hpp"
#include "bench/world/truth_values.hpp"

namespace canhil::plant {
namespace {

using scenario::Binding;
using scenario::Limits;
using scenario::Section;

std::vector<std::string> names_of(const std::vector<Variable>& variables) {
  std::vector<std::string> names;
  for (const Variable& one : variables) names.push_back(one.name);
  return names;
}

// What the targets report under a name: the SI unit of a quantity, or "" for a flag; none: nothing.
std::optional<std::string> reported(const Binding& binding, std::string_view name) {
  for (const Binding::Reported& one : binding.reported) {
    if (one.name == name) return one.si;
  }
  if (std::ranges::find(binding.flags, name) != binding.flags.end()) return "";
  return std::nullopt;
}

std::vector<std::string> all_reported(const Binding& binding) {
  std::vector<std::string> names;
  for (const Binding::Reported& one : binding.reported) names.push_back(one.name);
  names.insert(names.end(), binding.flags.begin(), binding.flags.end());
  return names;
}

class CommandReader {
 public:
  CommandReader(Section& plant, const Binding& binding, Setup& setup)
      : plant_(plant), binding_(binding), setup_(setup) {}

  void read() {
    std::optional<Section> commands = plant_.optional_table(
        {"commands", "For each input that a command steers or a constant sets: a table with its name."});
    const std::vector<Variable>& inputs = setup_.plan->inputs;
    for (std::size_t i = 0; i < inputs.size(); ++i) read(commands, i);
    if (!commands) return;
    for (const std::string& key : commands->keys()) {
      const auto names = names_of(inputs);
      if (std::ranges::find(names, key) == names.end())
        commands->reject(key, "is no input of the plant", scenario::expected_instead(key, names));
    }
    commands->finish();
  }

 private:
  void read(std::optional<Section>& commands, std::size_t index) {
    const Variable& input = setup_.plan->inputs[index];
    Command command{.input = index, .from = input.name + ".command"};
    std::optional<Section> own;
    if (commands) own = commands->optional_table(input.name);
    const std::string suffix(scenario::ending_for(input.si));
    const bool by_itself = reported(binding_, command.from).has_value();
    double start = input.start;
    if (own) {
      start =
          own->number({"start" + suffix, "Value before the first command, or always if no command steers it.",
                       "start_UNIT"},
                      Limits{}, start / scenario::factor_of(suffix));
      if (own->has("from") || by_itself || !own->has("start" + suffix))
        read_command(*own, command, suffix, by_itself);
      else
        command.from.clear();
      own->finish();
    } else if (!by_itself) {
      plant_.reject(
          "commands",
          fmt::format("has no '{}', and no signal of the target is '{}'", input.name, command.from),
          fmt::format("a command, or [plant.commands.{}] with 'from' or 'start{}'", input.name, suffix));
    }
    setup_.start.push_back(start);
    if (!command.from.empty()) setup_.commands.push_back(std::move(command));
  }

  void read_command(Section& own, Command& command, const std::string& suffix, bool by_itself) {
    const Variable& input = setup_.plan->inputs[command.input];
    command.from =
        own.given_name({"from",
                        "Quantity or flag of the target that is the command. Default: the "
                        "quantity INPUT.command."},
                       all_reported(binding_), by_itself ? std::optional(command.from) : std::nullopt);
    const auto si = reported(binding_, command.from);
    if (si && !si->empty() && !input.si.empty() && *si != input.si)
      own.reject("from", fmt::format("is in {}", *si), fmt::format("a command in {}", input.si));
    command.delay_us = own.time_us({"delay_ms", "Time from the arrival of a command to its effect."},
                                   Limits::between(0, 10'000), 0);
    command.timeout_us = own.optional_time_us(
        {"timeout_ms", "Time without a command after which the input changes to `after_timeout_UNIT`."},
        Limits::above(0, 60'000));
    const std::string after = "after_timeout" + suffix;
    if (!command.timeout_us) return own.refuse(after, "has no time", "timeout_ms beside it");
    command.after_timeout = own.number(
        {after, "Value of the input after `timeout_ms` without a command.", "after_timeout_UNIT"}, Limits{});
  }

  static double factor(const std::string& suffix) { return suffix.empty() ? 1 : scenario::factor_of(suffix); }

  Section& plant_;
  const Binding& binding_;
  Setup& setup_;
};

// An output with the name of a value of the motion is this value.
void read_motion(Section& plant, Setup& setup) {
  std::optional<Section> motion = plant.optional_table(
      {"motion", "Values of the carrier's motion, each an expression over outputs of the plant."});
  for (std::size_t i = 0; i < motion_values.size(); ++i) {
    const std::string name(motion_values[i]);
    const std::string output = std::string(world::plant_prefix) + name;
    if (motion && motion->has(name)) {
      setup.motion[i] = scenario::read_expression(*motion, name, "Expression in SI.");
      if (!setup.motion[i]) continue;
      for (const world::TruthValue* used : setup.motion[i]->uses()) {
        if (used->in != world::TruthIn::plant)
          motion->reject(name, fmt::format("uses {}, which follows from the motion", used->name),
                         "outputs of the plant, such as plant.psi");
        else if (!setup.shows(used->name))
          motion->reject(
              name, fmt::format("uses '{}', which is no output of the plant", used->name),
              fmt::format("plant. and one of: {}", fmt::join(names_of(setup.plan->outputs), ", ")));
      }
    } else if (setup.shows(output)) {
      setup.motion[i] = *scenario::Expression::parse(output);
    }
    if (motion) motion->optional(name);
  }
  if (motion) motion->finish();
}

}  // namespace

bool Setup::moves_the_carrier() const {
  return std::ranges::any_of(motion, [](const auto& value) { return value.has_value(); });
}

std::string Setup::shown(const Variable& output) const {
  const bool is_truth =
      shows_truths && std::ranges::find(world::truth_values(), output.name, &world::TruthValue::name) !=
                          world::truth_values().end();
  return is_truth ? output.name : std::string(world::plant_prefix) + output.name;
}

bool Setup::shows(std::string_view name) const {
  return std::ranges::any_of(plan->outputs, [&](const Variable& one) { return shown(one) == name; });
}

scenario::PlantFacts facts_of(Setup setup) {
  scenario::PlantFacts facts{.moves_the_carrier = setup.moves_the_carrier()};
  for (const Variable& one : setup.plan->outputs)
    facts.outputs.push_back({.name = setup.shown(one), .si = one.si, .turns = one.turns});
  for (const Command& one : setup.commands) facts.steered.push_back(setup.plan->inputs[one.input].name);
  facts.setup = std::make_shared<const Setup>(std::move(setup));
  return facts;
}

scenario::PlantFacts facts_of(const scenario::PlantTable& table, std::shared_ptr<const Plan> plan) {
  Setup setup;
  setup.kind = table.key;
  setup.plan = std::move(plan);
  setup.shows_truths = true;
  scenario::PlantFacts facts = facts_of(std::move(setup));
  facts.table = &table;
  return facts;
}

scenario::PlantFacts read_setup(Section& section, const Binding& binding) {
  std::vector<std::string> names;
  for (const Kind* kind : kinds()) names.emplace_back(kind->key);
  Setup setup;
  if (!section.has("kind"))  // without it, nothing is known of the other keys
    section.reject("kind", "is missing", fmt::format("one of: {}", fmt::join(names, ", ")));
  setup.kind = section.one_of({"kind", "What moves."}, names);
  std::unique_ptr<Plan> plan;
  for (const Kind* kind : kinds()) {
    if (kind->key == setup.kind) plan = kind->read(section);
  }
  if (plan == nullptr || section.error()) return {};
  plan->step_us = section.time_us({"step_ms", "Step of the plant. Commands act from the start of a step on."},
                                  Limits::between(0.1, 1000), 1e-3 * static_cast<double>(plan->step_us));
  setup.plan = std::move(plan);
  CommandReader(section, binding, setup).read();
  read_motion(section, setup);
  if (section.error()) return {};
  return facts_of(std::move(setup));
}

}  // namespace canhil::plant
