#include "bench/report/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/checks/errors.hpp"
#include "bench/checks/los.hpp"
#include "bench/checks/wind.hpp"
#include "bench/nodes/registry.hpp"
#include "bench/world/units.hpp"

namespace canhil::report {
namespace {

std::string_view name(run::ClockKind clock) {
  switch (clock) {
    case run::ClockKind::real_time:
      return "real time";
    case run::ClockKind::lockstep:
      return "lockstep";
    case run::ClockKind::simulated_wire:
      return "virtual, simulated wire";
  }
  return "?";
}

// Of the heading, in the unit of the alignment.
constexpr double bands_mrad[] = {10, 3, 2, 1};
constexpr double bands_deg[] = {30, 10, 3, 1};

FixSummary fix_summary(const std::vector<checks::FixAnswer>& fixes, std::string_view algorithm) {
  FixSummary summary{.outcomes = {},
                     .repairs = fixes.back().repairs,
                     .hands_over = algorithm == name_of(messages::Algorithm::sin_cos),
                     .resolved_s = {},
                     .heading_sigma_rad = fixes.back().heading_sigma};
  for (const messages::FixOutcome outcome : messages::enumerators<messages::FixOutcome>) {
    const auto count = std::ranges::count(fixes, outcome, &checks::FixAnswer::outcome);
    if (count > 0) summary.outcomes.emplace_back(name_of(outcome), count);
  }
  const auto resolved = std::ranges::find(fixes, true, &checks::FixAnswer::handed_over);
  summary.hands_over = summary.hands_over || resolved != fixes.end();
  if (resolved != fixes.end()) summary.resolved_s = static_cast<double>(resolved->cause_us) / 1e6;
  return summary;
}

EngagementSummary engagement_summary(const checks::Observations& seen,
                                     const world::EngagementRecord& engagement) {
  constexpr std::array<std::pair<double, double>, 6> windows{
      {{4.5, 3}, {3, 2}, {2, 1}, {1, 0.5}, {0.5, 0.2}, {0.2, 0.08}}};
  EngagementSummary summary{.miss_m = {},
                            .passage_s = static_cast<double>(engagement.passage_us) * 1e-6,
                            .late_commands = engagement.late_commands,
                            .rms = {},
                            .outcomes = {}};
  if (engagement.miss_n) summary.miss_m = engagement.miss_n->norm();
  const auto errors = checks::los_errors(seen, engagement);
  for (const auto& [most, least] : windows)
    summary.rms.push_back({most, least, checks::los_rms(errors, least, most)});
  for (const auto outcome : messages::enumerators<messages::LosRateOutcome>) {
    const auto count = std::ranges::count(seen.los, outcome, &checks::LosAnswer::outcome);
    if (count > 0) summary.outcomes.emplace_back(name_of(outcome), count);
  }
  return summary;
}

WindSummary wind_summary(const checks::Observations& seen, const world::GlideRecord& glide) {
  WindSummary summary;
  const scenario::Window everything{.from_us = 0, .to_us = glide.end_us()};
  const auto errors =
      checks::inside(checks::wind_errors(seen, glide),
                     {.from_us = static_cast<std::int64_t>(summary.from_s * 1e6), .to_us = glide.end_us()});
  const auto mean = [&](scenario::WindAxis axis) -> std::optional<double> {
    double sum = 0;
    for (const checks::WindError& error : errors) sum += std::abs(component(error, axis));
    return errors.empty() ? std::nullopt : std::optional(sum / static_cast<double>(errors.size()));
  };
  summary.along_mps = mean(scenario::WindAxis::along_track);
  summary.cross_mps = mean(scenario::WindAxis::cross_track);
  summary.down_mps = mean(scenario::WindAxis::down);
  summary.norm_mps = mean(scenario::WindAxis::norm);
  if (!seen.wind.empty()) summary.along_sigma_mps = seen.wind.back().along_track_sigma;
  const auto add = [&](std::string_view name, std::int64_t count) {
    if (count > 0) summary.outcomes.emplace_back(name, static_cast<std::size_t>(count));
  };
  for (const auto outcome : messages::enumerators<messages::WindOutcome>)
    add(name_of(outcome), std::ranges::count(seen.wind, outcome, &checks::WindAnswer::outcome));
  for (const std::string_view flag : scenario::wind_flags)
    add(flag, checks::count_flag(seen, everything, flag));
  return summary;
}

AlignmentSummary alignment_summary(const scenario::Scenario& scenario, scenario::Aligner aligner,
                                   const run::Run& run) {
  const bool by_fixes = aligner == scenario::Aligner::inflight_alignment;
  AlignmentSummary summary{.estimator = aligner, .heading_entries = {}, .final_error_rad = {}, .fixes = {}};
  const auto errors = checks::navigation_errors(checks::navigation_of(run.seen, aligner), run.truth);
  const scenario::AngleUnit unit = angle_unit(aligner);
  for (const double band : by_fixes ? bands_deg : bands_mrad) {
    const auto t_us = checks::convergence_us(errors, &world::Euler::heading, band * unit.factor);
    summary.heading_entries.push_back(
        {.within_rad = band * unit.factor,
         .unit = unit,
         .t_s = t_us ? std::optional(static_cast<double>(*t_us) * 1e-6) : std::nullopt});
  }
  if (!errors.empty()) {
    summary.final_error_rad = errors.back().angles;
    summary.final_velocity_error_mps = errors.back().v_eb_n.norm();
  }
  if (by_fixes && !run.seen.fixes.empty()) {
    const auto target = std::ranges::find(scenario.targets, name(aligner), &scenario::TargetSetup::estimator);
    summary.fixes = fix_summary(run.seen.fixes, target->algorithm);
  }
  return summary;
}

}  // namespace

scenario::AngleUnit angle_unit(scenario::Aligner aligner) {
  return aligner == scenario::Aligner::inflight_alignment ? scenario::degrees : scenario::mrad;
}

std::vector<std::string_view> closing_answers(const scenario::Scenario& scenario) {
  std::vector<std::string_view> closing;
  const auto add = [&](std::string_view estimator, std::initializer_list<std::string_view> messages) {
    if (scenario.runs(estimator)) closing.insert(closing.end(), messages);
  };
  add("transfer_alignment", {messages::AlignVelocityD::info.name, messages::AlignUpdate::info.name});
  add("inflight_alignment", {messages::FixVelocityD::info.name, messages::FixUpdate::info.name});
  add("los_rate", {messages::LosRateTarget::info.name});
  add("wind", {messages::WindUpdate::info.name});
  return closing;
}

bool is_due(const scenario::Scenario& scenario, const MessageInfo& message) {
  const auto of_its_group = [&](std::string_view closing) {
    const MessageInfo& last = *std::ranges::find(messages::all_messages, closing, &MessageInfo::name);
    return last.sample_group.empty() ? last.name == message.name : last.sample_group == message.sample_group;
  };
  return std::ranges::any_of(closing_answers(scenario), of_its_group);
}

Summary summarise(const scenario::Scenario& scenario, const run::Run& run) {
  Summary summary;
  for (const auto aligner : {scenario::Aligner::transfer_alignment, scenario::Aligner::inflight_alignment}) {
    if (scenario.runs(name(aligner))) summary.alignments.push_back(alignment_summary(scenario, aligner, run));
  }
  summary.navigation_answers = run.seen.navigation.size() + run.seen.fix_navigation.size();
  summary.filter_answers = run.seen.filter.size() + run.seen.fixes.size();

  summary.wind_answers = run.seen.wind.size();
  if (run.own_truth.glide) summary.wind = wind_summary(run.seen, *run.own_truth.glide);
  summary.los_answers = run.seen.los.size();
  if (run.own_truth.engagement) summary.engagement = engagement_summary(run.seen, *run.own_truth.engagement);

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
      run.clock == run::ClockKind::lockstep         ? "virtual time"
      : run.clock == run::ClockKind::simulated_wire ? "the simulated wire's stamps in virtual time"
      : checks::stamped_by_hardware(run.seen.timing)
          ? "the controller's hardware stamps of stimulus and answer"
      : run.seen.transmit_stamps_echoed ? "bus stamps of stimulus and answer"
                                        : "bench's stamp of the stimulus, bus stamp of the answer";
  return summary;
}

std::vector<wire::BitRates> load_rates(const run::Run& run) {
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
