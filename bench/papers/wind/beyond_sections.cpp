// What the paper did not ask: how coefficients may be wrong, what else may be, and what the bus does.
#include <fmt/format.h>

#include <array>
#include <utility>

#include "bench/papers/wind/sections.hpp"

namespace canhil::papers::wind {
namespace {

using Named = std::pair<const char*, const char*>;  // stem of the variant, words

// A row of scores by component.
Row by_component(const Results& results, const char* campaign, std::string label,
                 const std::string& variant) {
  std::vector<std::string> cells{std::move(label)};
  for (const char* metric : {"wind error", "along track", "cross track", "down"})
    cells.push_back(words(results.score(campaign, variant, metric)));
  return {.cells = std::move(cells), .mark = Mark::none, .verdict = ""};
}
const std::vector<std::string> component_head{"", "wind error", "along track", "cross track", "down", ""};
constexpr const char* component_note =
    "m/s: mean over t >= 10 s and over runs (standard deviation over runs).";

}  // namespace

Section models(const Results& results) {
  Table table{.head = {"how the coefficients are wrong", "EKF, low Q", "EKF, Q of the rates", ""},
              .rows = {},
              .note = component_note};
  for (const auto& [stem, label] :
       {Named{"white_total", "white each 10 ms, one factor a coefficient"},
        Named{"white_term", "white each 10 ms, a factor a part"},
        Named{"held", "held 50 ms, a factor a part (Table 1)"},
        Named{"held_forces", "the same, of the forces alone"},
        Named{"markov", "Markov, 1 s, a factor a part"}, Named{"constant", "constant in a run"},
        Named{"constant_5", "constant in a run, 5 %"}}) {
    table.rows.push_back({.cells = {label, words(results.score("models", fmt::format("low_{}", stem))),
                                    words(results.score("models", fmt::format("omega_{}", stem)))},
                          .mark = Mark::none,
                          .verdict = ""});
  }
  return {.id = "models",
          .title = "20 % of what?",
          .paragraphs = {"The paper does not say how the coefficient noise goes on in time, and everything "
                         "depends on it. A "
                         "constant error of the run scatters far more from run to run than the paper's "
                         "standard deviation."},
          .tables = {std::move(table)},
          .figures = {}};
}

Section sensitivity(const Results& results) {
  std::vector<Table> tables;
  for (const auto& [filter, name] : {Named{"omega", "EKF, Q of the rates 0.5 deg/s"},
                                     Named{"corr", "EKF, Q 0.1 m/s and 1 deg/s, correlated"}}) {
    Table table{.head = component_head, .rows = {}, .note = component_note};
    table.head.front() = name;
    for (const auto& [stem, label] :
         {Named{"base", "exact coefficients"}, Named{"density_3", "air 3 % denser"},
          Named{"density_minus_3", "air 3 % thinner"},
          Named{"constant_5", "coefficients constantly wrong by 5 %"}, Named{"gusts", "gusts of 1 m/s, 3 s"},
          Named{"correlated", "half of the navigation's error stays for 60 s"},
          Named{"east", "heading east, along the jet"}, Named{"june", "June"},
          Named{"september", "September"}, Named{"december", "December"}})
      table.rows.push_back(by_component(results, "sensitivity", label, fmt::format("{}_{}", filter, stem)));
    tables.push_back(std::move(table));
  }
  return {
      .id = "sensitivity",
      .title = "What sets the floor",
      .paragraphs =
          {"A constant error of the density or of the coefficients looks like another air speed: the filter "
           "cannot see it, and the wind along the track is wrong by it. 3 % of density are 1.5 % of air "
           "speed."},
      .tables = std::move(tables),
      .figures = {}};
}

Section timing(const Results& results) {
  const std::vector<std::string> rate_head{"rate of navigation and fins", "EKF, low Q", "EKF, Q of the rates",
                                           "H-infinity", ""};
  Table rates{.head = rate_head, .rows = {}, .note = component_note};
  for (const int hz : {100, 50, 20, 10, 5}) {
    const auto of = [&](const char* filter) {
      return words(results.score("rates", fmt::format("{}_{}", filter, hz)));
    };
    rates.rows.push_back({.cells = {fmt::format("{} Hz", hz), of("low"), of("omega"), of("hinf")},
                          .mark = Mark::none,
                          .verdict = ""});
  }
  Table ages{.head = {"age of the fins", "EKF, low Q", "the same, stamped on arrival", "EKF, Q of the rates",
                      "the same, stamped on arrival", ""},
             .rows = {},
             .note = component_note};
  for (const int ms : {0, 20, 50, 100, 200}) {
    const auto of = [&](const char* filter, const char* how) {
      return ms == 0 && *how != '\0' ? std::string("-")
                                     : words(results.score("age", fmt::format("{}_{}{}", filter, ms, how)));
    };
    ages.rows.push_back({.cells = {fmt::format("{} ms", ms), of("low", ""), of("low", "_stamped"),
                                   of("omega", ""), of("omega", "_stamped")},
                         .mark = Mark::none,
                         .verdict = ""});
  }
  Table losses{.head = component_head, .rows = {}, .note = component_note};
  losses.head.front() = "EKF, Q of the rates";
  for (const auto& [stem, label] :
       {Named{"nothing", "nothing lost"}, Named{"navigation_10", "10 % of the navigation lost"},
        Named{"navigation_50", "50 %"}, Named{"navigation_outage", "1 s in every 10 s"},
        Named{"fins_10", "10 % of the fins lost"}, Named{"fins_50", "50 %"},
        Named{"fins_outage", "1 s in every 10 s"}, Named{"both_10", "10 % of both"}})
    losses.rows.push_back(by_component(results, "losses", label, stem));
  return {
      .id = "timing",
      .title = "Rate, age, losses",
      .paragraphs =
          {"Coefficients wrong by 20 %. A deflection carries its time of validity; the newest is held until "
           "the next. Beyond 100 ms without one the target says so and trusts its model less."},
      .tables = {std::move(rates), std::move(ages), std::move(losses)},
      .figures = {}};
}

}  // namespace canhil::papers::wind
