#include "bench/checks/judge.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "bench/checks/answer_faults.hpp"
#include "bench/checks/answered.hpp"
#include "bench/checks/condition.hpp"
#include "bench/checks/events.hpp"
#include "bench/checks/finding.hpp"
#include "bench/checks/kinds/bus_errors.hpp"
#include "bench/checks/kinds/of_tracks.hpp"
#include "bench/checks/kinds/protection.hpp"
#include "bench/checks/other_senders.hpp"
#include "bench/checks/rule.hpp"
#include "bench/checks/target_state.hpp"
#include "bench/checks/timing.hpp"
#include "bench/world/plant_record.hpp"

namespace canhil::checks {
namespace {

// The implied check that is not measured if the bench could not send what the scenario defines.
constexpr std::string_view stimuli_kind = "stimuli";

// Returns a bus_errors check if the bus failed and the scenario itself contains no such check. This implied
// check makes the run fail.
std::optional<scenario::Check> bus_check(const scenario::Scenario& scenario, const Evidence& evidence) {
  const bool said = std::ranges::find(scenario.checks, BusErrorLimits::kind, &scenario::Check::kind) !=
                    scenario.checks.end();
  const BusErrorLimits rule;
  if (said || rule.judge(evidence).outcome != Outcome::fail) return std::nullopt;
  return scenario::Check{.name = std::string(BusErrorLimits::kind),
                         .requirement = "",
                         .kind = std::string(BusErrorLimits::kind),
                         .rule = std::make_shared<RuleOf<BusErrorLimits>>(rule)};
}

// The implied check that fails if the target never commanded an input of the plant: the loop was open.
constexpr std::string_view commands_kind = "commands";

std::optional<CheckResult> open_loop(const world::PlantRecords& plants) {
  const world::PlantRecord* plant = world::steered(plants);
  if (plant == nullptr) return std::nullopt;
  std::vector<std::string_view> silent;
  for (const world::CommandRecord& one : plant->commands) {
    if (one.given.empty()) silent.push_back(one.input);
  }
  if (silent.empty()) return std::nullopt;
  return CheckResult{.name = std::string(commands_kind),
                     .kind = std::string(commands_kind),
                     .requirement = "",
                     .outcome = Outcome::fail,
                     .measured = fmt::format("no command of {} came", fmt::join(silent, ", ")),
                     .expected = "commands of each input of the plant"};
}

// Returns only the tracks that the checks use: a run has many more tracks, and each may be long.
std::vector<estimators::OwnTrack> tracks_for(const std::vector<scenario::Check>& checks,
                                             const Evidence& evidence) {
  std::vector<Subject> wanted;
  for (const scenario::Check& check : checks) {
    std::vector<Subject> subjects = check.rule->subjects();
    if (const Condition* condition = check.rule->condition())
      std::ranges::move(condition->subjects(), std::back_inserter(subjects));
    for (const Subject& subject : subjects) {
      for (const quantities::Quantity* part : parts_of(*subject.quantity))
        wanted.push_back({.estimator = subject.estimator, .quantity = part});
    }
  }
  std::vector<estimators::OwnTrack> tracks;
  for (const estimators::Estimator* one : evidence.estimators) {
    const auto looks_at = [&](const quantities::Quantity* quantity) {
      return std::ranges::any_of(wanted, [&](const Subject& subject) {
        return subject.estimator == one->name && (quantity == nullptr || subject.quantity == quantity);
      });
    };
    if (!looks_at(nullptr)) continue;
    estimators::give_tracks(*one, evidence.seen, evidence.truth, [&](quantities::Track track) {
      if (looks_at(track.quantity)) tracks.push_back({one->name, std::move(track)});
    });
  }
  return tracks;
}

// If a rule cannot be judged because causes of answers are not certain, returns the reason. Empty: the rule
// can be judged.
std::string why_ambiguous(const checks::Rule& rule, const Evidence& evidence) {
  const TimingRecord& timing = evidence.seen.timing;
  for (const Timed& timed : rule.timed()) {
    const auto info = std::ranges::find(timing.messages, timed.message, &MessageInfo::name);
    if (info == timing.messages.end()) continue;
    const auto index = static_cast<std::size_t>(info - timing.messages.begin());
    if (!timing.answers[index].ambiguous.empty()) return timing.answers[index].ambiguous;
  }
  for (const Subject& subject : rule.paired()) {
    if (std::string why = why_uncertain(evidence, subject.estimator, *subject.quantity); !why.empty())
      return why;
  }
  return "";
}

// If a rule cannot be judged because the truth is missing, returns the reason. Empty: the rule can be judged.
std::string why_no_truth(const scenario::Scenario& scenario, const checks::Rule& rule,
                         const Evidence& evidence) {
  const std::vector<std::string> held = rule.held_against_truth();
  const std::vector<Subject> subjects = rule.subjects();
  for (const estimators::Estimator* one : evidence.estimators) {
    for (const Subject& subject : subjects) {
      if (one->why_no_truth == nullptr || subject.estimator != one->name) continue;
      if (std::string why = one->why_no_truth(scenario, *subject.quantity); !why.empty()) return why;
    }
    std::string why = scenario::why_no_truth(scenario, one->facts);
    // Even a quantity that is not an error may need the truth, for example to sort samples by time to go.
    const auto has_no_track = [&](const Subject& subject) {
      return subject.estimator == one->name && tracks_of(evidence, one->name, *subject.quantity).empty();
    };
    if (!why.empty() &&
        (std::ranges::find(held, one->name) != held.end() || std::ranges::any_of(subjects, has_no_track)))
      return why;
  }
  return "";
}

// Why it cannot be known when a condition holds; empty: it can, or there is none.
std::string why_unknown(const scenario::Scenario& scenario, const Condition* condition,
                        const Evidence& evidence) {
  if (condition == nullptr) return "";
  for (const world::TruthValue* value : condition->truths()) {
    if (std::string why = scenario::why_no_truth(scenario, *value); !why.empty()) return why;
  }
  for (const Subject& subject : condition->subjects(true)) {
    const estimators::Estimator* one = estimators::find(evidence.estimators, subject.estimator);
    if (one == nullptr) continue;
    std::string why = one->why_no_truth == nullptr ? "" : one->why_no_truth(scenario, *subject.quantity);
    if (why.empty()) why = scenario::why_no_truth(scenario, one->facts);
    if (!why.empty()) return why;
  }
  return condition->why_unknown(evidence);
}

// The window that contains a stretch; to_us < from_us: the flight has no sample in the stretch.
scenario::Window window_of(const Stretch& stretch, const Evidence& evidence, std::string_view estimator) {
  if (!stretch.to_go_s) return stretch.window;
  scenario::Window window{.from_us = evidence.truth.duration_us, .to_us = 0};
  for (const auto& [name, track] : evidence.tracks) {
    if (name != estimator) continue;
    for (const quantities::Track::ToGo& epoch : track.to_go) {
      if (epoch.to_go_s < stretch.to_go_s->first || epoch.to_go_s >= stretch.to_go_s->second) continue;
      window = {std::min(window.from_us, epoch.t_us), std::max(window.to_us, epoch.t_us)};
    }
    if (!track.to_go.empty()) break;  // the same for all tracks
  }
  return window;
}

// The last messages of the answer groups that a rule judges: those with its quantities, otherwise all.
std::vector<std::string_view> judged_by(const checks::Rule& rule, const estimators::Estimator& of) {
  std::vector<std::string_view> judged;
  for (const Subject& subject : rule.subjects()) {
    if (of.closing_with == nullptr || subject.estimator != of.name) continue;
    for (const quantities::Quantity* part : parts_of(*subject.quantity))
      std::ranges::copy(of.closing_with(*part), std::back_inserter(judged));
  }
  if (judged.empty()) judged.assign(of.closing.begin(), of.closing.end());
  return judged;
}

// Why a rule that passes cannot pass, because answers are missing that it should judge; none: it can pass.
std::optional<Finding> missing_answers(const checks::Rule& rule, const Evidence& evidence) {
  std::optional<Finding> found;
  const std::vector<std::string> needed = rule.needs_answers_of();
  for (const estimators::Estimator* one : evidence.estimators) {
    if (std::ranges::find(needed, one->name) == needed.end()) continue;
    const scenario::Window window = window_of(rule.span(), evidence, one->name);
    for (const std::string_view message : judged_by(rule, *one)) {
      auto missing = missing_answers(evidence.seen, message, window);
      if (missing && (!found || missing->outcome == Outcome::fail)) found = std::move(missing);
    }
  }
  return found;
}

}  // namespace

bool is_implied(std::string_view kind) {
  return kind == BusErrorLimits::kind || kind == Protection::kind || kind == causes_kind ||
         kind == groups_kind || kind == state_kind || kind == stimuli_kind || kind == senders_kind ||
         kind == commands_kind;
}

std::vector<const quantities::Track*> tracks_of(const Evidence& evidence, std::string_view estimator,
                                                const quantities::Quantity& quantity) {
  std::vector<const quantities::Track*> found;
  for (const quantities::Quantity* part : parts_of(quantity)) {
    for (const auto& [name, track] : evidence.tracks) {
      if (name == estimator && track.quantity == part) found.push_back(&track);
    }
  }
  return found;
}

std::string why_uncertain(const Evidence& evidence, std::string_view estimator,
                          const quantities::Quantity& quantity) {
  const estimators::Estimator* one = estimators::find(evidence.estimators, estimator);
  return one == nullptr || one->ambiguous == nullptr ? "" : one->ambiguous(evidence.seen, quantity);
}

Finding no_values(const quantities::Quantity& quantity, Expected expected) {
  return {Outcome::fail, fmt::format("no value of {} came", quantity.name), std::move(expected)};
}

std::vector<TimedWindow> timed_windows(const std::vector<scenario::Check>& checks,
                                       std::span<const MessageInfo> messages) {
  TimingRecord timing(messages);
  for (const scenario::Check& check : checks) {
    for (const Timed& asked : check.rule->timed()) {
      const auto info = std::ranges::find(messages, asked.message, &MessageInfo::name);
      if (info == messages.end() || find_window(timing, asked.message, asked.window) != nullptr) continue;
      timing.windows.push_back(
          {.message = static_cast<std::size_t>(info - messages.begin()), .window = asked.window});
    }
  }
  return std::move(timing.windows);
}

Verdict judge(const scenario::Scenario& scenario, Evidence evidence) {
  Verdict verdict;
  std::vector<scenario::Check> all = scenario.checks;
  if (auto implied = bus_check(scenario, evidence)) all.push_back(std::move(*implied));
  if (evidence.ended_early.empty()) evidence.tracks = tracks_for(all, evidence);
  for (const scenario::Check& check : all) {
    Finding finding = check.rule->judge(evidence);
    // A value that is not judged is not reported: it is of too few answers, or of another run than the
    // scenario describes.
    const auto replace = [&finding](Outcome outcome, std::string why) {
      finding.outcome = outcome;
      finding.measured = std::move(why);
      finding.measurement = {};
    };
    if (finding.outcome == Outcome::pass) {
      if (auto missing = missing_answers(*check.rule, evidence))
        replace(missing->outcome, std::move(missing->measured));
    }
    std::string why = why_no_truth(scenario, *check.rule, evidence);
    if (why.empty()) why = why_ambiguous(*check.rule, evidence);
    if (why.empty()) why = why_unknown(scenario, check.rule->condition(), evidence);
    // The target did not get the stimuli that belong to the truth.
    if (why.empty() && !evidence.seen.clipped.empty() && !check.rule->subjects().empty())
      why = evidence.seen.clipped.front();
    if (!why.empty()) replace(Outcome::not_measured, std::move(why));
    if (const std::string late = late_loop(evidence); finding.outcome == Outcome::fail && !late.empty()) {
      finding.outcome = Outcome::not_measured;
      finding.measured += "; " + late;
    }
    // An incomplete run neither passes nor fails a check.
    if (!evidence.ended_early.empty()) replace(Outcome::not_measured, "the run ended early");
    verdict.checks.push_back(result_of(check.name, check.kind, check.requirement, std::move(finding)));
  }
  std::ranges::move(judge_events(scenario.events, evidence), std::back_inserter(verdict.checks));
  const bool completed = evidence.ended_early.empty();  // otherwise a command may still have come
  std::ranges::move(
      of_every_run(scenario, evidence.seen, completed ? evidence.truth.plants : world::PlantRecords()),
      std::back_inserter(verdict.checks));
  conclude(verdict, evidence.ended_early);
  return verdict;
}

std::vector<CheckResult> of_every_run(const scenario::Scenario& scenario, const Observations& seen,
                                      const world::PlantRecords& plants) {
  std::vector<CheckResult> failed;
  const auto imply = [&](std::string_view kind, Outcome outcome, std::string found,
                         std::string_view expected) {
    if (found.empty()) return;
    failed.push_back({.name = std::string(kind),
                      .kind = std::string(kind),
                      .requirement = "",
                      .outcome = outcome,
                      .measured = std::move(found),
                      .expected = std::string(expected)});
  };
  std::vector<std::int64_t> events_us;
  for (const scenario::Check& check : scenario.checks) {
    if (const auto event_us = check.rule->event_us()) events_us.push_back(*event_us);
  }
  // If another node sent frames with the bench's ids, the answers may be wrong because of these frames. So
  // wrong answers then lead to 'not measured' instead of 'fail'.
  const Outcome fault = seen.bus.intruded.empty() ? Outcome::fail : Outcome::not_measured;
  imply(causes_kind, fault, wrong_causes(seen), "each answer with time and counter of its cause");
  imply(groups_kind, fault, broken_groups(seen), "all messages of an answer, with one counter");
  imply(state_kind, fault, unexplained_state(seen, events_us),
        "running throughout, no error that nothing explains");
  // A second target sends the same counters.
  imply(Protection::kind, other_senders(seen).empty() ? Outcome::fail : Outcome::not_measured,
        protection_faults(scenario, seen),
        "right checksums and sizes, each counter one more than the one before");
  imply(stimuli_kind, Outcome::not_measured, fmt::format("{}", fmt::join(seen.clipped, "; ")),
        "values that their signals hold");
  imply(senders_kind, Outcome::not_measured, other_senders(seen), "each message from its own sender alone");
  if (auto open = open_loop(plants)) failed.push_back(std::move(*open));
  return failed;
}

}  // namespace canhil::checks
