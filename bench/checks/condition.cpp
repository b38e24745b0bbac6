#include "bench/checks/condition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <optional>
#include <utility>

#include "bench/checks/kinds/flag.hpp"
#include "bench/checks/kinds/of_faults.hpp"
#include "bench/scenario/contract.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::checks {
namespace {

using estimators::Mark;

std::string as_name(std::string_view text) {
  std::string name(text);
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

// The index of the newest of ascending times; none: all are later.
template <class Times, class TimeOf>
std::optional<std::size_t> newest(const Times& times, std::int64_t t_us, TimeOf time_of) {
  const auto after = std::ranges::upper_bound(times, t_us, {}, time_of);
  if (after == times.begin()) return std::nullopt;
  return static_cast<std::size_t>(after - times.begin() - 1);
}

}  // namespace

std::shared_ptr<const Condition> Condition::read(scenario::Section& section,
                                                 const scenario::CheckContext& context,
                                                 std::string_view estimator) {
  const scenario::Key key{"while",
                          "Expression: only what belongs to times at which it is not 0 is judged "
                          "(scenarios.md lists its values). By default, all is judged."};
  const std::string text = section.text(key, "");
  if (text.empty()) return nullptr;
  std::vector<Value> values;
  std::vector<std::string> names;
  const auto add = [&](std::string name, Value value) {
    if (std::ranges::find(names, name) != names.end()) return;  // of an estimator before
    names.push_back(std::move(name));
    values.push_back(std::move(value));
  };
  std::vector<const estimators::Estimator*> running;
  for (const estimators::Estimator* one : context.contract.known) {
    if (std::ranges::find(context.estimators, one->name) == context.estimators.end()) continue;
    running.insert(one->name == estimator ? running.begin() : running.end(), one);
  }
  for (const estimators::Estimator* one : running) {
    const std::string by(one->name);
    for (const Mark& mark : one->marks(Observations{})) {
      if (can_be_judged(mark))
        add("flag." + as_name(mark.name),
            {.what = What::flag, .name = std::string(mark.name), .estimator = by});
    }
    for (const quantities::Quantity* quantity : one->of_runs) {
      if (!quantity->parts.empty()) continue;
      const auto of = [&](std::string_view prefix, What what) {
        add(fmt::format("{}.{}", prefix, quantity->name),
            {.what = what, .name = {}, .estimator = by, .quantity = quantity});
      };
      of("error", What::error);
      of("sigma", What::sigma);
      of("estimate", What::estimate);
    }
  }
  for (const scenario::FaultWindow& fault : context.faults)
    add("fault." + as_name(fault.name), {.what = What::fault, .name = fault.name});
  for (std::size_t i = 0; i < context.events.size(); ++i)
    add("event." + as_name(context.events[i]), {.what = What::event, .name = {}, .event = i});
  auto expression = scenario::Expression::parse(text, names);
  if (!expression) {
    section.reject(key.name, expression.error().what, expression.error().expected);
    return nullptr;
  }
  return std::shared_ptr<const Condition>(new Condition(text, std::move(*expression), std::move(values)));
}

Condition::InRun::InRun(const Condition& condition, const Evidence& evidence)
    : condition_(condition), evidence_(evidence), truths_(estimators::truths_of(evidence.truth)) {
  for (const std::size_t index : condition.expression_.uses_further()) {
    const Value& value = condition.values_[index];
    Known& known = known_[index];
    if (value.quantity != nullptr) {
      const auto tracks = tracks_of(evidence, value.estimator, *value.quantity);
      if (!tracks.empty()) known.track = tracks.front();
    }
    const estimators::Estimator* by = estimators::find(evidence.estimators, value.estimator);
    if (value.what != What::flag || by == nullptr) continue;
    for (Mark& mark : by->marks(evidence.seen)) {
      if (mark.name != value.name) continue;
      for (Mark& among : by->marks(evidence.seen)) {
        if (among.name == mark.among) known.all = std::move(among.t_us);
      }
      known.set = std::move(mark.t_us);
    }
  }
}

std::optional<double> Condition::InRun::value_at(std::size_t index, std::int64_t t_us) const {
  const Value& value = condition_.values_[index];
  const Known& known = known_.at(index);
  switch (value.what) {
    case What::flag: {
      const auto last = newest(known.all, t_us, std::identity());
      if (!last) return std::nullopt;
      return std::ranges::binary_search(known.set, known.all[*last]) ? 1 : 0;
    }
    case What::fault:
      return std::ranges::any_of(evidence_.seen.faults, [&](const FaultRecord& one) {
        return one.name == value.name && within(one.window, t_us);
      });
    case What::event:
      return std::ranges::any_of(evidence_.seen.exchanges, [&](const Exchange& one) {
        return one.event == value.event && one.sent_ns - evidence_.seen.first_ns <= t_us * 1000;
      });
    case What::error:
    case What::sigma:
    case What::estimate:
      break;
  }
  if (known.track == nullptr) return std::nullopt;
  const auto last = newest(known.track->points, t_us, &quantities::TrackPoint::t_us);
  if (!last) return std::nullopt;
  const quantities::TrackPoint& point = known.track->points[*last];
  return value.what == What::error   ? std::optional(point.value)
         : value.what == What::sigma ? point.sigma
                                     : point.estimate;
}

bool Condition::InRun::holds(std::int64_t t_us) const {
  const auto value =
      condition_.expression_.at(truths_, t_us, [&](std::size_t index) { return value_at(index, t_us); });
  return value && *value != 0;
}

std::vector<const Condition::Value*> Condition::used() const {
  std::vector<const Value*> all;
  for (const std::size_t index : expression_.uses_further()) all.push_back(&values_[index]);
  return all;
}

std::string Condition::why_unknown(const Evidence& evidence) const {
  for (const Value* one : used()) {
    if (one->what != What::fault) continue;
    if (std::string why = did_not_strike(evidence, one->name); !why.empty()) return why;
  }
  return "";
}

std::vector<Subject> Condition::subjects(bool of_errors) const {
  std::vector<Subject> all;
  for (const Value* one : used()) {
    if (of_errors ? one->what == What::error : one->quantity != nullptr)
      all.push_back({.estimator = one->estimator, .quantity = one->quantity});
  }
  return all;
}

}  // namespace canhil::checks
