#include "bench/checks/kinds/of_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "bench/checks/evidence.hpp"
#include "bench/checks/kinds/of_tracks.hpp"
#include "bench/scenario/contract.hpp"
#include "bench/scenario/rule.hpp"

namespace canhil::checks {

std::string Disturbance::to_text() const {
  if (!fault.empty()) return fmt::format("fault '{}'", fault);
  return fmt::format("{:g} s", static_cast<double>(window.from_us) * 1e-6);
}

std::optional<Disturbance> read_fault(scenario::Section& section, const scenario::CheckContext& context) {
  section.optional("fault");
  if (!section.has("fault")) return std::nullopt;
  std::vector<std::string> names;
  for (const scenario::FaultWindow& fault : context.faults) names.push_back(fault.name);
  if (names.empty()) {
    section.reject("fault", "names a fault, but the scenario has none", "a [[fault]] beside it, or times");
    return Disturbance{};
  }
  const std::string name =
      section.given_name({"fault",
                          "Name of a `[[fault]]` of the scenario. The check uses the times of "
                          "this fault, so `from_s` and `to_s` must be absent."},
                         names);
  const auto found = std::ranges::find(context.faults, name, &scenario::FaultWindow::name);
  if (found == context.faults.end()) return Disturbance{};
  if (found->window.from_us == std::numeric_limits<std::int64_t>::max())
    section.reject("fault", fmt::format("'{}' begins in the run (its key 'when')", name),
                   "a fault with from_s, or a check with 'while'");
  else if (found->window.from_us >= context.duration_us)
    section.reject("fault", fmt::format("'{}' begins after the end of the run", name),
                   "one that begins before it");
  return Disturbance{.fault = name,
                     .window = found->window,
                     .valid_from_us = std::max<std::int64_t>(found->window.from_us - context.latency_us, 0)};
}

Disturbance read_disturbance(scenario::Section& section, const scenario::CheckContext& context) {
  if (auto fault = read_fault(section, context)) {
    section.refuse("from_s", "has no effect beside fault", "one of the two");
    return *fault;
  }
  const std::int64_t t_us =
      scenario::read_time(section,
                          {"from_s",
                           "Time of an event that is not a `[[fault]]`, in place of `fault`. This time is "
                           "both the onset and the end of the event."},
                          scenario::Limits::at_least(0), context.duration_us);
  return {.fault = {}, .window = {.from_us = t_us, .to_us = t_us}, .valid_from_us = t_us};
}

std::int64_t read_within(scenario::Section& section, const scenario::CheckContext& context,
                         std::int64_t after_us, std::string_view meaning) {
  const std::int64_t within_us = section.time_us({"within_s", meaning}, scenario::Limits::above(0));
  if (after_us + within_us > context.duration_us)
    section.reject(
        "within_s", fmt::format("after {:g} s ends after the run", static_cast<double>(after_us) * 1e-6),
        fmt::format("less than {:g}",
                    static_cast<double>(std::max<std::int64_t>(context.duration_us - after_us, 0)) * 1e-6));
  return within_us;
}

std::vector<std::string> read_signs(scenario::Section& section, const scenario::CheckContext& context) {
  section.optional("by");
  if (!section.has("by")) return {};
  return section.some_of({"by",
                          "Names of the signs that the check considers. Default: all signs. A sign that was "
                          "present in the 5 s before the onset never counts."},
                         sign_names(running(context)));
}

std::string SignsOf::why_hidden() const {
  std::vector<std::string> texts;
  for (const Sign& sign : there_before) texts.push_back(sign.to_text());
  return fmt::format("already present before it: {}", fmt::join(texts, ", "));
}

SignsOf signs_of(const Evidence& evidence, const Disturbance& of, const std::vector<std::string>& names) {
  SignsOf signs;
  for (Sign& sign : signs_in(evidence.seen, evidence.estimators)) {
    if (!names.empty() && std::ranges::find(names, sign.name) == names.end()) continue;
    (was_there_before(sign, of.valid_from_us) ? signs.there_before : signs.fresh).push_back(std::move(sign));
  }
  return signs;
}

std::string did_not_strike(const Evidence& evidence, std::string_view fault) {
  const auto found = std::ranges::find(evidence.seen.faults, fault, &FaultRecord::name);
  if (found == evidence.seen.faults.end() || found->count > 0) return "";
  return fmt::format("the fault '{}' did not strike", fault);
}

std::string not_measurable(const Evidence& evidence, const Disturbance& of) {
  if (!can_show_signs(evidence.seen, evidence.estimators)) return "this target has no signs";
  return did_not_strike(evidence, of.fault);
}

std::vector<const estimators::Estimator*> running(const scenario::CheckContext& context) {
  std::vector<const estimators::Estimator*> running;
  for (const estimators::Estimator* one : context.contract.known) {
    if (std::ranges::find(context.estimators, one->name) != context.estimators.end()) running.push_back(one);
  }
  return running;
}

std::vector<Subject> always_reported(const estimators::Estimator& estimator) {
  std::vector<Subject> subjects;
  for (const quantities::Quantity* quantity : estimator.of_runs) {
    if (quantity->degrees_of_freedom == 0 && !quantity->white && quantity->parts.empty())
      subjects.push_back({.estimator = std::string(estimator.name),
                          .quantity = quantity,
                          .text = std::string(quantity->name)});
  }
  return subjects;
}

std::string silence_of(const Evidence& evidence, const std::vector<Subject>& subjects,
                       const scenario::Window& window) {
  for (const Subject& subject : subjects) {
    for (const quantities::Track* track : tracks_of(evidence, subject.estimator, *subject.quantity)) {
      // The stretch ends no later than the flight, because no answers are expected after the flight.
      const Stretch stretch{.window = {window.from_us, std::min(window.to_us, track->answers_end_us)}};
      if (static_cast<double>(stretch.window.to_us - stretch.window.from_us) <= track->longest_wait_us)
        continue;
      if (std::string gap = silence(*track, stretch, inside(*track, stretch, evidence)); !gap.empty())
        return fmt::format("{}: {}", subject.text, gap);
    }
  }
  return {};
}

}  // namespace canhil::checks
