#include "bench/checks/kinds/flag.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/checks/condition.hpp"
#include "bench/checks/evidence.hpp"
#include "bench/checks/kinds/of_tracks.hpp"
#include "bench/checks/silence.hpp"
#include "bench/checks/timing.hpp"
#include "bench/scenario/contract.hpp"
#include "bench/scenario/rule.hpp"

namespace canhil::checks {
namespace {

using estimators::Mark;
using scenario::Limits;

// The window, or the time during a fault.
void read_window_of(scenario::Section& section, const scenario::CheckContext& context, Flag& rule) {
  const scenario::Key key{"within_s",
                          "With `fault`: time after its onset until the flag must be in this state.", ""};
  const auto fault = read_fault(section, context);
  if (!fault) {
    section.refuse("within_s", "has no effect without fault", "fault beside it, or from_s");
    rule.window = scenario::read_window(section, context.duration_us);
    return;
  }
  for (const std::string_view other : {"from_s", "to_s"})
    section.refuse(other, "has no effect beside fault", "one of the two");
  rule.fault = fault->fault;
  const std::int64_t within_us = section.time_us(key, Limits::at_least(0), 0);
  rule.window = {.from_us = fault->window.from_us + within_us,
                 .to_us = std::min(fault->window.to_us, context.duration_us)};
  if (rule.window.from_us >= rule.window.to_us)
    section.reject("within_s", "is not shorter than the fault", "a time within which the fault still acts");
}

// Where the answers that could report a flag are missing; empty: nowhere.
std::string missing(const Observations& seen, const Mark& all, const Spool<std::int64_t>& times,
                    const scenario::Window& window) {
  if (times.empty()) return "no answers";
  const auto message = std::ranges::find(seen.timing.messages, all.name, &MessageInfo::name);
  if (message == seen.timing.messages.end()) return "";
  const double longest_us = longest_wait_us(1e6 * nominal_period_s(seen, all.name));
  const auto silent = silent_stretch(times, window, window.to_us, longest_us);
  return silent ? "no answers " + seconds(*silent) : "";
}

// What the answers of a window say about a flag.
struct Counted {
  Spool<std::int64_t> times{};  // of all answers
  std::int64_t set = 0;         // number of those in which it is set
  std::int64_t starts = 0;      // how often it becomes set
  std::optional<std::int64_t> first_set_us{}, first_clear_us{};
};

Counted count(const Spool<std::int64_t>& all, const Spool<std::int64_t>& set, const Stretch& stretch,
              const Evidence& evidence) {
  Counted counted;
  std::optional<Condition::InRun> condition;
  if (stretch.condition != nullptr) condition.emplace(*stretch.condition, evidence);
  bool before = false;
  estimators::each_state(all, set, [&](std::int64_t t_us, bool is_set) {
    if (within(stretch.window, t_us) && (!condition || condition->holds(t_us))) {
      counted.times.push_back(t_us);
      counted.set += is_set ? 1 : 0;
      counted.starts += is_set && !before ? 1 : 0;
      auto& first = is_set ? counted.first_set_us : counted.first_clear_us;
      if (!first) first = t_us;
    }
    before = is_set;
  });
  return counted;
}

constexpr double percent_of_share = 100;

Criterion criterion_of_share(const Flag& rule) {
  return {.quantity = rule.flag,
          .estimator = rule.estimator,
          .statistic = rule.set ? "share of the answers in which it is set" : "share in which it is clear",
          .lower = Limit{.value = percent_of_share * rule.share},
          .unit = "%",
          .stretch = Stretch{.window = rule.window, .condition = rule.condition}};
}

Criterion criterion_of_starts(const Flag& rule) {
  Criterion criterion{.quantity = rule.flag,
                      .estimator = rule.estimator,
                      .statistic = "starts",
                      .stretch = Stretch{.window = rule.window, .condition = rule.condition}};
  if (!rule.starts) return criterion;
  criterion.lower = Limit{.value = static_cast<double>(rule.starts->first)};
  criterion.upper = Limit{.value = static_cast<double>(rule.starts->second)};
  return criterion;
}

}  // namespace

bool can_be_judged(const Mark& mark) { return mark.name != mark.among && !mark.among.empty(); }

Flag Flag::read(scenario::Section& section, const scenario::CheckContext& context) {
  Flag rule;
  const std::vector<std::string> running(context.estimators.begin(), context.estimators.end());
  rule.estimator = read_estimator(
      section, running, "Estimator to judge. By default, each estimator is judged, by a check of its own.",
      context);
  std::vector<std::string> names;
  if (const estimators::Estimator* one = estimators::find(context.contract.known, rule.estimator)) {
    for (const Mark& mark : one->marks(Observations{})) {
      if (can_be_judged(mark)) names.emplace_back(mark.name);
    }
  }
  rule.flag =
      section.given_name({"flag", "Name of a flag of the mapping, or of a mark of the estimator."}, names);
  const std::string state = section.one_of({"state", "The state that is expected in the answers."},
                                           std::vector<std::string>{"set", "clear"}, "set");
  rule.set = state == "set";
  read_window_of(section, context, rule);
  rule.condition = Condition::read(section, context, rule.estimator);
  if (section.has("starts")) {
    const auto [least, most] = section.interval(
        {"starts", "How often the flag becomes set in the window: least and most."}, Limits::at_least(0));
    rule.starts = {static_cast<std::int64_t>(least), static_cast<std::int64_t>(most)};
  }
  section.optional("starts");
  rule.share = section
                   .optional_number({"share_percent",
                                     "Least share of the answers that have the state. Default: 100, and 0 "
                                     "beside `starts`."},
                                    Limits::between(0, 100))
                   .value_or(rule.starts ? 0 : 1);
  return rule;
}

std::string Flag::subject() const {
  return fmt::format("{}{}{}", set ? "" : "no ", flag, fault.empty() ? "" : " at " + fault);
}

Finding Flag::judge(const Evidence& evidence) const {
  const std::string_view state = set ? "set" : "clear";
  const Stretch stretch{.window = window, .condition = condition};
  Expected expected;
  if (share > 0)
    expected.text = share == 1 ? fmt::format("always {}", state)
                               : fmt::format("{} in at least {:g} % of the answers", state, 100 * share);
  if (starts)
    expected.text +=
        fmt::format("{}{} to {} starts", expected.text.empty() ? "" : ", ", starts->first, starts->second);
  expected.text += " " + to_text(stretch);
  expected.criterion = share > 0 ? criterion_of_share(*this) : criterion_of_starts(*this);
  if (std::string why = did_not_strike(evidence, fault); !why.empty())
    return {Outcome::not_measured, std::move(why), expected};
  const estimators::Estimator* by = estimators::find(evidence.estimators, estimator);
  const auto marks = by == nullptr ? std::vector<Mark>() : by->marks(evidence.seen);
  const auto mark = std::ranges::find(marks, std::string_view(flag), &Mark::name);
  const auto all = mark == marks.end() ? marks.end() : std::ranges::find(marks, mark->among, &Mark::name);
  if (all == marks.end()) return {Outcome::fail, "no answers", expected};
  const Counted counted = count(all->t_us, mark->t_us, stretch, evidence);
  const Stretch whole{.window = window};
  const auto& times =
      condition == nullptr ? counted.times : count(all->t_us, mark->t_us, whole, evidence).times;
  if (std::string gap = missing(evidence.seen, *all, times, window); !gap.empty())
    return {Outcome::fail, std::move(gap), expected};
  if (counted.times.empty()) return {Outcome::not_measured, "the condition held at no answer", expected};
  const auto total = static_cast<std::int64_t>(counted.times.size());
  const std::int64_t right = set ? counted.set : total - counted.set;
  const auto& wrong_us = set ? counted.first_clear_us : counted.first_set_us;
  std::string measured = fmt::format("{} in {} of {} answers", state, right, total);
  if (wrong_us) measured += fmt::format(", not at {:g} s", static_cast<double>(*wrong_us) * 1e-6);
  bool good = static_cast<double>(right) >= share * static_cast<double>(total);
  std::vector<Judgement> judgements;
  const auto judged = [&](Criterion criterion, double value) {
    judgements.push_back(
        {.criterion = std::move(criterion),
         .measurement = {
             .value = value, .count = static_cast<std::uint64_t>(total), .worst_at_us = wrong_us}});
  };
  if (share > 0)
    judged(criterion_of_share(*this),
           percent_of_share * static_cast<double>(right) / static_cast<double>(total));
  if (starts) {
    measured += fmt::format(", {} starts", counted.starts);
    good = good && counted.starts >= starts->first && counted.starts <= starts->second;
    judged(criterion_of_starts(*this), static_cast<double>(counted.starts));
  }
  Finding finding{pass_if(good), std::move(measured), std::move(expected)};
  take_nearest_to_limit(finding, std::move(judgements));
  return finding;
}

}  // namespace canhil::checks
