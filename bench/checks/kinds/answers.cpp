#include "bench/checks/kinds/answers.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/checks/evidence.hpp"
#include "bench/checks/kinds/of_tracks.hpp"
#include "bench/scenario/contract.hpp"
#include "bench/scenario/rule.hpp"

namespace canhil::checks {

using scenario::Limits;

Answers Answers::read(scenario::Section& section, const scenario::CheckContext& context) {
  Answers rule;
  const std::vector<std::string> running(context.estimators.begin(), context.estimators.end());
  rule.estimator = read_estimator(
      section, running, "Estimator to judge. By default, each estimator is judged, by a check of its own.",
      context);
  rule.one_of_several = running.size() > 1;
  rule.window = scenario::read_window(section, context.duration_us);
  const estimators::Estimator* estimator = estimators::find(context.contract.known, rule.estimator);
  if (estimator == nullptr) return rule;
  for (const estimators::Mark& mark : estimator->marks(Observations{})) {
    const auto key = [&](std::string_view ending) { return fmt::format("{}_{}", mark.name, ending); };
    const std::string at_least = key("at_least"), at_most = key("at_most"), before = key("before_s");
    Count count{
        .mark = std::string(mark.name),
        .at_least = section.optional_integer(
            {at_least, "Minimum number of answers in the window that have the mark.", "MARK_at_least"}, 0),
        .at_most = section.optional_integer(
            {at_most, "Maximum number of answers in the window that have the mark.", "MARK_at_most"}, 0),
        .before_us = section.optional_time_us(
            {before, "The first answer of the run that has the mark must come before this time.",
             "MARK_before_s"},
            Limits::above(0))};
    scenario::expect_ordered(section, at_least, count.at_least, at_most, count.at_most);
    if (count.before_us) scenario::expect_within_run(section, before, *count.before_us, context.duration_us);
    if (count.at_least || count.at_most || count.before_us) rule.counts.push_back(std::move(count));
  }
  if (rule.counts.empty())
    section.reject("answers_at_least", "is missing, as are all other limits", "at least one limit");
  return rule;
}

std::string Answers::subject() const {
  std::string marks;
  for (const Count& count : counts) marks += (marks.empty() ? "" : " ") + count.mark;
  return one_of_several ? marks + " of " + estimator : marks;
}

// A missing answer may be one that would have had a mark of which only some may come.
std::vector<std::string> Answers::needs_answers_of() const {
  if (std::ranges::none_of(counts, [](const Count& count) { return count.at_most.has_value(); })) return {};
  return {estimator};
}

Finding Answers::judge(const Evidence& evidence) const {
  Finding finding{.outcome = Outcome::pass, .measured = "", .expected = {}};
  std::vector<Judgement> judgements;
  const auto judged = [&](const Count& wanted) -> Judgement& {
    return judgements.emplace_back(Judgement{.criterion = {.quantity = wanted.mark, .estimator = estimator}});
  };
  const auto add = [](std::string& text, const std::string& more) {
    text += (text.empty() ? "" : ", ") + more;
  };
  const auto expect = [&](const std::string& what, bool holds) {
    add(finding.expected.text, what);
    if (!holds) finding.outcome = Outcome::fail;
  };
  const estimators::Estimator* reported_by = estimators::find(evidence.estimators, estimator);
  const auto marks =
      reported_by == nullptr ? std::vector<estimators::Mark>() : reported_by->marks(evidence.seen);
  for (const Count& wanted : counts) {
    const auto mark = std::ranges::find(marks, std::string_view(wanted.mark), &estimators::Mark::name);
    static const Spool<std::int64_t> none;
    const Spool<std::int64_t>& times = mark == marks.end() ? none : mark->t_us;
    if (wanted.at_least || wanted.at_most) {
      const auto count =
          std::ranges::count_if(times, [&](std::int64_t t_us) { return within(window, t_us); });
      add(finding.measured, fmt::format("{} {}", wanted.mark, count));
      auto& [criterion, measurement] = judged(wanted);
      if (wanted.at_least) criterion.lower = Limit{.value = static_cast<double>(*wanted.at_least)};
      if (wanted.at_most) criterion.upper = Limit{.value = static_cast<double>(*wanted.at_most)};
      criterion.stretch = Stretch{.window = window};
      measurement.value = static_cast<double>(count);
      if (wanted.at_least)
        expect(fmt::format("{} >= {}", wanted.mark, *wanted.at_least), count >= *wanted.at_least);
      if (wanted.at_most)
        expect(fmt::format("{} <= {}", wanted.mark, *wanted.at_most), count <= *wanted.at_most);
    }
    if (!wanted.before_us) continue;
    const auto at_s = [](std::int64_t t_us) { return static_cast<double>(t_us) * 1e-6; };
    add(finding.measured, times.empty() ? fmt::format("never {}", wanted.mark)
                                        : fmt::format("{} at {:g} s", wanted.mark, at_s(times.front())));
    auto& [criterion, measurement] = judged(wanted);
    criterion.upper = exclusive(at_s(*wanted.before_us));
    criterion.unit = "s";
    if (!times.empty()) measurement = {.value = at_s(times.front()), .worst_at_us = times.front()};
    expect(fmt::format("{} before {:g} s", wanted.mark, at_s(*wanted.before_us)),
           !times.empty() && times.front() < *wanted.before_us);
  }
  finding.expected.text += fmt::format(" {}", seconds(window));
  take_nearest_to_limit(finding, std::move(judgements));
  if (marks.empty() || marks.front().t_us.empty()) return {Outcome::fail, "no answers", finding.expected};
  return finding;
}

}  // namespace canhil::checks
