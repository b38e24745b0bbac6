#include "bench/checks/kinds/error.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "bench/checks/evidence.hpp"
#include "bench/checks/kinds/of_tracks.hpp"
#include "bench/checks/not_finite.hpp"
#include "bench/scenario/read_enum.hpp"
#include "bench/scenario/rule.hpp"

namespace canhil::checks {
namespace {

constexpr std::array<std::string_view, 4> statistics{"max", "rms", "mean", "final"};

// For each statistic, in the order of the enumeration: what is compared with the limit.
constexpr std::array<std::string_view, 4> asked{"|error|", "RMS", "mean |error|",
                                                "|error| of the last answer"};

}  // namespace

std::string_view name(Error::Statistic statistic) { return statistics[static_cast<std::size_t>(statistic)]; }

Error Error::read(scenario::Section& section, const scenario::CheckContext& context) {
  Error rule;
  rule.judged = read_subject(section, context, [](const quantities::Quantity& quantity) {
    return quantity.degrees_of_freedom == 0 && !quantity.white;
  });
  rule.statistic =
      scenario::read_enum<Statistic>(section,
                                     {"statistic",
                                      "Statistic of |estimated - true| in the window: its maximum, RMS or "
                                      "mean, or (`final`) its value at the last answer. If the quantity has "
                                      "several parts, such as the planes of `los.rate`: the maximum and the "
                                      "last value of the worst part, the RMS and the mean over all parts."},
                                     statistics, Statistic::max);
  rule.stretch = read_stretch(section, context, rule.judged);
  std::tie(rule.below, rule.unit) =
      read_bar(section, "below", "The statistic must be below this value.", *rule.judged.quantity);
  return rule;
}

std::string Error::subject() const {
  std::string text = judged.text;
  if (statistic != Statistic::max) text += fmt::format(" {}", name(statistic));
  if (stretch.to_go_s)
    text += fmt::format(" {:g} to {:g} s to go", stretch.to_go_s->second, stretch.to_go_s->first);
  return text;
}

std::optional<Bar> Error::bar() const {
  Bar bar{.judged = {}, .stretch = stretch, .below = below, .statistic = name(statistic)};
  for (const quantities::Quantity* part : parts_of(*judged.quantity))
    bar.judged.push_back({.estimator = judged.estimator, .quantity = part});
  return bar;
}

Finding Error::judge(const Evidence& evidence) const {
  const Expected expected{.text = fmt::format("{} < {:g} {} {}", asked[static_cast<std::size_t>(statistic)],
                                              below / unit.factor, unit.name, to_text(stretch)),
                          .criterion = {.quantity = std::string(judged.quantity->name),
                                        .estimator = judged.estimator,
                                        .statistic = std::string(name(statistic)),
                                        .upper = exclusive(below / unit.factor),
                                        .unit = std::string(unit.name),
                                        .stretch = stretch}};
  const auto tracks = tracks_of(evidence, judged.estimator, *judged.quantity);
  if (tracks.empty()) return no_values(*judged.quantity, expected);
  const Places part = inside(*tracks.front(), stretch, evidence);
  if (auto gap = no_evidence(*tracks.front(), stretch, part, expected, evidence)) return *gap;
  double worst = 0, sum = 0, squares = 0, last = 0;
  std::int64_t worst_at_us = 0, last_at_us = 0;
  NotFinite not_finite;
  for (const std::size_t index : part) {
    last = 0;  // of the worst part
    double all = 0;
    for (const quantities::Track* track : tracks) {
      const double error = std::abs(track->points[index].value);
      last = std::max(last, error);
      all += error;
      squares += error * error;
    }
    last_at_us = tracks.front()->points[index].t_us;
    if (last >= worst) {
      worst = last;
      worst_at_us = last_at_us;
    }
    sum += all;
    not_finite.take(last_at_us, all);
  }
  if (auto why = not_finite.to_text(part.size()); !why.empty())
    return {Outcome::fail, std::move(why), expected};
  const auto count = static_cast<double>(part.size() * tracks.size());
  const std::array<double, 4> values{worst, std::sqrt(squares / count), sum / count, last};
  const double value = values[static_cast<std::size_t>(statistic)];
  const int digits = digits_of(unit, below);
  std::string measured = fmt::format("{} {:.{}f}", statistic == Statistic::rms ? "RMS" : name(statistic),
                                     value / unit.factor, digits);
  if (statistic == Statistic::mean) measured += fmt::format(", max {:.{}f}", worst / unit.factor, digits);
  return {pass_if(value < below),
          fmt::format("{} {} of {}", measured, unit.name, part.size()),
          expected,
          {.value = value / unit.factor,
           .count = part.size(),
           .worst_at_us = statistic == Statistic::final ? last_at_us : worst_at_us}};
}

}  // namespace canhil::checks
