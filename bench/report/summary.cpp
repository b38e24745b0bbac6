#include "bench/report/summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "bench/checks/timing.hpp"
#include "bench/estimators/registry.hpp"
#include "bench/nodes/registry.hpp"
#include "bench/scenario/binding.hpp"

namespace canhil::report {
namespace {

// What became of the commands, and how quick the plant was.
EstimatorResults results_of_plant(const world::PlantRecord& plant) {
  EstimatorResults own{"plant", {}};
  for (const world::CommandRecord& one : plant.commands) {
    estimators::ResultLine line{.name = one.input, .what = fmt::format("commands of '{}'", one.input)};
    const auto given = static_cast<double>(one.given.size()),
               missing = static_cast<double>(one.missing_us.size());
    line.add("commands", given, fmt::format("{} commands", one.given.size()));
    line.add("without_value", static_cast<double>(one.invalid),
             fmt::format("{} without a value", one.invalid));
    line.add("steps_without", missing, fmt::format("{} steps without one in time", one.missing_us.size()));
    own.lines.push_back(std::move(line));
  }
  estimators::ResultLine steps{.name = "steps", .what = "longest step of the plant"};
  steps.add("longest_step_s", plant.longest_step_s,
            fmt::format("{:.3f} ms by the wall clock", plant.longest_step_s * 1e3));
  own.lines.push_back(std::move(steps));
  return own;
}

}  // namespace

std::vector<std::string_view> closing_answers(const scenario::Scenario& scenario) {
  std::vector<std::string_view> closing;
  for (const estimators::Estimator* one : estimators::in(scenario)) {
    if (scenario.runs(one->name)) closing.insert(closing.end(), one->closing.begin(), one->closing.end());
  }
  return closing;
}

bool is_due(const scenario::Scenario& scenario, const MessageInfo& message) {
  return !message.answers.empty() && scenario.runs(scenario.binding->estimator_of(message));
}

bool is_cut_off(const drive::Run& run) {
  return run.ending.kind == drive::Ending::Kind::interrupted && !run.options.bus.text.starts_with("log:");
}

std::vector<EstimatorResults> results(const scenario::Scenario& scenario, const drive::Run& run) {
  if (is_cut_off(run)) return {};
  const estimators::Truth truth = drive::truth_of(run.truth, run.per_run_truth, scenario.duration_us);
  std::vector<EstimatorResults> all;
  for (const estimators::Estimator* one : estimators::in(scenario)) {
    if (!scenario.runs(one->name)) continue;
    const auto target = std::ranges::find(scenario.targets, one->name, &scenario::TargetSetup::estimator);
    EstimatorResults own{one->name, {}};
    if (const std::string why = scenario::why_no_truth(scenario, one->facts); why.empty()) {
      own.lines = one->results(run.seen, truth, target->algorithm);
    } else {
      own.lines.push_back({.name = "errors", .what = "errors"});
      own.lines.back().add("errors", std::nullopt, "not measured: " + why);
    }
    estimators::ResultLine answers{.name = "answers", .what = "answers by what they say"};
    for (const estimators::Mark& mark : one->marks(run.seen)) {
      const bool known =
          !mark.t_us.empty() || mark.name == "answers";  // the text omits marks without answers
      answers.figures.push_back({.name = std::string(mark.name),
                                 .value = static_cast<double>(mark.t_us.size()),
                                 .text = known ? fmt::format("{} {}", mark.name, mark.t_us.size()) : ""});
    }
    own.lines.push_back(std::move(answers));
    all.push_back(std::move(own));
  }
  if (run.per_run_truth.plant) all.push_back(results_of_plant(run.per_run_truth.plant->record()));
  return all;
}

std::string target_program(const drive::Run& run) {
  if (run.in_process) return "in hil-bench itself";
  if (run.options.targets.empty()) return "runs elsewhere";
  return fmt::format("{}", fmt::join(run.options.targets, ", "));
}

std::string_view clock_name(const drive::Run& run) {
  switch (run.clock) {
    case drive::ClockKind::real_time:
      return "real time";
    case drive::ClockKind::lockstep:
      return "lockstep";
    case drive::ClockKind::simulated_wire:
      return "virtual, simulated wire";
  }
  return "?";
}

std::string_view stamp_source(const drive::Run& run) {
  if (run.clock == drive::ClockKind::lockstep) return "virtual time";
  if (run.clock == drive::ClockKind::simulated_wire) return "the simulated wire's stamps in virtual time";
  if (checks::stamped_by_hardware(run.seen.timing))
    return "the controller's hardware stamps of stimulus and answer";
  return run.seen.transmit_stamps_echoed ? "bus stamps of stimulus and answer"
                                         : "bench's stamp of the stimulus, bus stamp of the answer";
}

std::vector<wire::BitRates> load_rates(const drive::Run& run) {
  return load_rates(run.seen.bit_rates, run.options.format);
}

std::vector<wire::BitRates> load_rates(wire::BitRates known, BusFormat format) {
  const bool fd = format != BusFormat::classic;
  if (known.nominal > 0) {
    if (!fd) known.data = 0;
    return {known};
  }
  return {{.nominal = 500'000, .data = fd ? 2'000'000 : 0},
          {.nominal = 1'000'000, .data = fd ? 5'000'000 : 0}};
}

std::vector<std::string> period_overrides(const scenario::Scenario& scenario) {
  std::vector<std::string> lines;
  for (const bool at_every_epoch :
       {true, false}) {  // the first pass is for the node whose period is the interval of the truth
    for (const nodes::Kind* kind : nodes::all()) {
      const MessageInfo* closes = scenario.binding->closing_of(kind->table);
      const scenario::NodeSettings* node = scenario.node(kind->table.key);
      if (kind->table.sensor->at_every_epoch != at_every_epoch || node == nullptr || closes == nullptr)
        continue;
      if (node->period_us() == closes->cycle_time_us) continue;
      lines.push_back(fmt::format("{} every {:g} ms (DBC: {:g} ms)", closes->sample_group,
                                  static_cast<double>(node->period_us()) * 1e-3,
                                  static_cast<double>(closes->cycle_time_us) * 1e-3));
    }
  }
  return lines;
}

}  // namespace canhil::report
