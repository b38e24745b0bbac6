#include "bench/report/summary.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/estimators/registry.hpp"
#include "bench/nodes/registry.hpp"

namespace canhil::report {
namespace {

std::string_view name(drive::ClockKind clock) {
  switch (clock) {
    case drive::ClockKind::real_time:
      return "real time";
    case drive::ClockKind::lockstep:
      return "lockstep";
    case drive::ClockKind::simulated_wire:
      return "virtual, simulated wire";
  }
  return "?";
}

EstimatorResults results_of(const estimators::Estimator& estimator, const scenario::Scenario& scenario,
                            const drive::Run& run) {
  const auto target = std::ranges::find(scenario.targets, estimator.name, &scenario::TargetSetup::estimator);
  const estimators::Truth truth = drive::truth_of(run.truth, run.own_truth, scenario.duration_us);
  EstimatorResults results{estimator.name, estimator.results(run.seen, truth, target->algorithm)};
  estimators::ResultLine answers{.name = "answers", .what = "answers by what they say"};
  for (const estimators::Mark& mark : estimator.marks(run.seen)) {
    const bool told = !mark.t_us.empty() || mark.name == "answers";  // programs are told of none, too
    answers.figures.push_back({.name = std::string(mark.name),
                               .value = static_cast<double>(mark.t_us.size()),
                               .words = told ? fmt::format("{} {}", mark.name, mark.t_us.size()) : ""});
  }
  results.lines.push_back(std::move(answers));
  return results;
}

}  // namespace

std::vector<std::string_view> closing_answers(const scenario::Scenario& scenario) {
  std::vector<std::string_view> closing;
  for (const estimators::Estimator* one : estimators::all()) {
    if (scenario.runs(one->name)) closing.insert(closing.end(), one->closing.begin(), one->closing.end());
  }
  return closing;
}

bool is_due(const scenario::Scenario& scenario, const MessageInfo& message) {
  const estimators::Estimator* sender = estimators::sending(message);
  return sender != nullptr && scenario.runs(sender->name);
}

Summary summarise(const scenario::Scenario& scenario, const drive::Run& run) {
  Summary summary;
  for (const estimators::Estimator* one : estimators::all()) {
    if (scenario.runs(one->name)) summary.results.push_back(results_of(*one, scenario, run));
  }
  for (const std::string_view message : closing_answers(scenario)) {
    const auto place = std::ranges::find(messages::all_messages, message, &MessageInfo::name);
    const checks::AnswerTiming& timing =
        run.seen.timing.answers[static_cast<std::size_t>(place - messages::all_messages.begin())];
    summary.latencies.push_back({.message = std::string(message),
                                 .latency_s = checks::distribution_s(timing.latency),
                                 .jitter_s = checks::distribution_s(timing.jitter),
                                 .unanswered = checks::unanswered(run.seen, message)});
  }
  summary.lateness_s = checks::distribution_s(run.seen.timing.lateness);
  summary.clock = name(run.clock);
  summary.stamp_source =
      run.clock == drive::ClockKind::lockstep         ? "virtual time"
      : run.clock == drive::ClockKind::simulated_wire ? "the simulated wire's stamps in virtual time"
      : checks::stamped_by_hardware(run.seen.timing)
          ? "the controller's hardware stamps of stimulus and answer"
      : run.seen.transmit_stamps_echoed ? "bus stamps of stimulus and answer"
                                        : "bench's stamp of the stimulus, bus stamp of the answer";
  return summary;
}

std::vector<wire::BitRates> load_rates(const drive::Run& run) {
  const bool fd = run.options.format == BusFormat::fd;
  wire::BitRates known = run.seen.bit_rates;
  if (known.nominal > 0) {
    if (!fd) known.data = 0;
    return {known};
  }
  return {{.nominal = 500'000, .data = fd ? 2'000'000 : 0},
          {.nominal = 1'000'000, .data = fd ? 5'000'000 : 0}};
}

std::vector<std::string> period_overrides(const scenario::Scenario& scenario) {
  std::vector<std::string> lines;
  const auto add = [&](const nodes::Kind* kind) {
    const MessageInfo& closes = kind->table.closes;
    const scenario::NodeSettings* node = scenario.node(kind->table.key);
    if (node == nullptr || node->period_us() == closes.cycle_time_us) return;
    lines.push_back(fmt::format("{} every {:g} ms (DBC: {:g} ms)", closes.sample_group,
                                static_cast<double>(node->period_us()) * 1e-3,
                                static_cast<double>(closes.cycle_time_us) * 1e-3));
  };
  for (const bool at_every_epoch : {true, false}) {  // first the period that is the truth's interval too
    for (const nodes::Kind* kind : nodes::all()) {
      if (kind->at_every_epoch == at_every_epoch) add(kind);
    }
  }
  return lines;
}

}  // namespace canhil::report
