#include "bench/checks/events.hpp"

#include <fmt/format.h>

#include <optional>

#include "dbc/transport/uds.hpp"

namespace canhil::checks {
namespace {

using scenario::Event;

std::string shown(const Exchange& one) {
  std::string text = scenario::to_text(*one.answer);
  const auto code = transport::negative_code(one.request, *one.answer);
  const std::string_view name = code ? transport::name_of_negative_code(*code) : std::string_view();
  return name.empty() ? text : fmt::format("{} ({})", text, name);
}

std::string why_not_sent(const Event& event, std::span<const Event> events) {
  switch (event.when) {
    case Event::When::truth:
      return "not sent: its condition held at no time";
    case Event::When::flag:
      return fmt::format("not sent: no answer had the flag {} {}", event.flag,
                         event.flag_set ? "set" : "clear");
    case Event::When::answered:
      return fmt::format("not sent: '{}' had no answer", events[event.after].name);
    default:
      return "its request did not reach the bus";
  }
}

Expected expected_of(const Event& event) {
  Expected expected{.text = event.expected ? event.expected->to_text() : "a request"};
  if (!event.within_us) return expected;
  const double within_ms = 1e-3 * static_cast<double>(*event.within_us);
  expected.text += fmt::format(" within {:g} ms", within_ms);
  expected.criterion = {.quantity = event.name, .upper = Limit{.value = within_ms}, .unit = "ms"};
  return expected;
}

Finding judge_exchange(const Event& event, bool in_run, const Exchange& one, const Evidence& evidence) {
  const Expected expected = expected_of(event);
  if (!one.answer) {
    const std::int64_t left_us = (evidence.seen.last_ns - one.sent_ns) / 1000;
    if (in_run && left_us < event.patience_us())
      return {Outcome::not_measured, "no answer before the end of the run", expected};
    if (!one.broken.empty()) return {Outcome::fail, "the answer is broken: " + one.broken, expected};
    return {Outcome::fail,
            fmt::format("no answer within {:g} s", 1e-6 * static_cast<double>(event.patience_us())),
            expected};
  }
  if (!event.expected->matches(*one.answer)) return {Outcome::fail, shown(one), expected};
  if (!evidence.timing_unfit.empty()) {
    if (event.within_us)
      return {Outcome::not_measured, fmt::format("{}, its time: {}", shown(one), evidence.timing_unfit),
              expected};
    return {Outcome::pass, shown(one), expected};
  }
  const std::int64_t after_ns = one.answered_ns - one.sent_ns;
  const double after_ms = 1e-6 * static_cast<double>(after_ns);
  Finding finding{Outcome::pass, fmt::format("{} after {:.3g} ms", shown(one), after_ms), expected};
  if (!event.within_us) return finding;
  finding.measurement = {.value = after_ms, .worst_at_us = (one.sent_ns - evidence.seen.first_ns) / 1000};
  if (after_ns <= *event.within_us * 1000) return finding;
  finding.outcome = Outcome::fail;
  return unless_target_delayed(evidence, 1, 1e-6 * static_cast<double>(*event.within_us), finding);
}

// The worst of an event's exchanges.
Finding judge_event(const Event& event, bool in_run, const std::vector<const Exchange*>& own,
                    const Evidence& evidence) {
  std::optional<Finding> worst;
  for (const Exchange* one : own) {
    Finding finding = judge_exchange(event, in_run, *one, evidence);
    const bool worse = !worst || (finding.outcome == Outcome::fail && worst->outcome != Outcome::fail) ||
                       (finding.outcome == Outcome::not_measured && worst->outcome == Outcome::pass);
    if (worse) worst = std::move(finding);
  }
  return *worst;
}

}  // namespace

std::vector<CheckResult> judge_events(std::span<const Event> events, const Evidence& evidence) {
  std::vector<CheckResult> results;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const Event& event = events[i];
    std::vector<const Exchange*> own;
    for (const Exchange& one : evidence.seen.exchanges) {
      if (one.event == i) own.push_back(&one);
    }
    if (!own.empty() && !event.expected) continue;
    Finding finding =
        own.empty()
            ? Finding{Outcome::not_measured, why_not_sent(event, events), expected_of(event)}
            : judge_event(event, scenario::phase_of(events, event) == scenario::Phase::during, own, evidence);
    if (!evidence.ended_early.empty())
      finding = {Outcome::not_measured, "the run ended early", std::move(finding.expected)};
    results.push_back(result_of(event.name, event_kind, event.requirement, std::move(finding)));
  }
  return results;
}

}  // namespace canhil::checks
