// Content of the page on the wind: scores, the wind over the height, the nominal flight.
#include "bench/papers/page_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "bench/estimators/wind/quantities.hpp"
#include "bench/plant/published.hpp"
#include "bench/world/units.hpp"

namespace canhil::papers::wind {
namespace {

using world::units::deg;

constexpr const char* requirement = "section 8";
constexpr const char* lost_requirement = "section 8: lost";
constexpr std::array judged{"table1", "sensitivity", "rates"};

// Names of metrics: the error of the wind vector, and of each component.
constexpr const char* all = "wind error";
constexpr std::array components{"along track", "cross track", "down"};

// The mean of |wind error| for t >= 10 s in each run, averaged over the runs [m/s].
double mean(const campaign::Answer& answer) { return figure(answer, "mean_mps"); }
std::string score(const campaign::Answer& answer) {
  return fmt::format("{:.2f} ({:.2f})", mean(answer), figure(answer, "standard_deviation_mps"));
}
std::size_t lost(const campaign::Answer& answer) {
  return static_cast<std::size_t>(figure(answer, "missing"));
}

std::string cells(const Flown& flown, std::string_view variant) {
  std::string text;
  for (const char* component : components)
    text += (text.empty() ? "" : " | ") + score(flown.answer(component, variant));
  return text;
}

void add_scores(Names& names, const Results& results) {
  const auto of = [&results](Words& words, std::string_view metric) -> const campaign::Answer& {
    const Flown& flown = results.of(words.next());
    return flown.answer(metric, words.rest());
  };
  names["mean"] = [=](Words& words) { return fmt::format("{:.2f}", mean(of(words, all))); };
  names["mean_along"] = [=](Words& words) { return fmt::format("{:.2f}", mean(of(words, components[0]))); };
  names["mean_across"] = [=](Words& words) { return fmt::format("{:.2f}", mean(of(words, components[1]))); };
  names["score"] = [=](Words& words) { return score(of(words, all)); };
  names["lost"] = [=](Words& words) { return fmt::to_string(lost(of(words, all))); };
  names["scores"] = [&results](Words& words) {
    const Flown& flown = results.of(words.next());
    const std::string_view variant = words.rest();
    return score(flown.answer(all, variant)) + " | " + cells(flown, variant);
  };
  names["components"] = [&results](Words& words) {
    const Flown& flown = results.of(words.next());
    return cells(flown, words.rest());
  };
  names["lost_at_any_level"] = [&results](Words& words) {
    const std::string_view filter = words.rest();
    std::size_t sum = 0;
    for (const int level : {0, 20, 40})
      sum += lost(results.of("table1").answer(all, fmt::format("{}_{}", filter, level)));
    return fmt::to_string(sum);
  };
}

// Adds template names for the paper's claims: whether each claim holds, and the numbers that decide this.
void add_claims(Names& names, const Results& results) {
  const auto at = [&](const char* filter, int level) {
    return mean(results.of("table1").answer(all, fmt::format("{}_{}", filter, level)));
  };
  const auto claim = [&names](const char* name, bool holds) { names[name] = [=](Words&) { return holds; }; };
  claim("h_infinity_ahead", at("hinf", 20) < 0.85 * at("low", 20));
  claim("kf_diverges", lost(results.of("table1").answer(all, "low_40")) > 0);
  claim("h_infinity_holds", at("hinf", 40) < 0.6 * at("low", 40));
  claim("h_infinity_costs", at("hinf", 0) > at("low", 0));
  claim("kf_grows", at("low", 0) < at("low", 20) && at("low", 20) < at("low", 40));
  const auto text = [&names](const char* name, const std::string& words) {
    names[name] = [=](Words&) { return words; };
  };
  text("h_infinity_less", fmt::format("{:.0f} %", 100 * (1 - at("hinf", 20) / at("low", 20))));
  for (const int level : {20, 40})
    text(level == 20 ? "times_better_at_20" : "times_better_at_40",
         fmt::format("{:.1f}", at("hinf", level) / at("omega", level)));

  const auto answers = results.of("table1").answers(lost_requirement);
  const auto astray =
      std::ranges::count_if(answers, [](const auto* answer) { return !answer->passed.value_or(false); });
  claim("none_lost", astray == 0);
  text("variants_that_lost", fmt::format("{} of {}", astray, answers.size()));
}

template <class Value>
Curve profile(std::string_view season, Value value) {
  std::string name(season);
  name.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(name.front())));
  Curve curve;
  for (int quarter = 0; quarter <= 60; ++quarter) {
    const double km = 0.25 * quarter;
    curve.points.emplace_back(km, value(plant::published_wind(name, 1000 * km).value()));
  }
  return curve;
}

double from_deg(const world::Vector3& wind_n) {
  const double from = std::atan2(-wind_n.y(), -wind_n.x()) / deg;
  return from < 0 ? from + 360 : from;
}

/// The nominal flight at a row of its record.
struct Flown {
  double t_s = 0;
  world::Vector3 v_a, v_eb_n;
  world::Euler angles;
  double height = 0;
};
Flown flown_at(std::size_t row) {
  static const auto columns =
      world::PlantColumns<10>::find({&plant::published_flight()},
                                    {"plant.air_velocity.x", "plant.air_velocity.y", "plant.air_velocity.z",
                                     "velocity.north", "velocity.east", "velocity.down", "attitude.roll",
                                     "attitude.pitch", "attitude.heading", "plant.height"})
          .value();
  const auto of = columns.of_row(row);
  return {.t_s = static_cast<double>(columns.record().times_us()[row]) * 1e-6,
          .v_a = world::Vector3(&of[0]),
          .v_eb_n = world::Vector3(&of[3]),
          .angles = {.roll = of[6], .pitch = of[7], .heading = of[8]},
          .height = of[9]};
}

Curve flight(std::string_view what) {
  static const std::map<std::string_view, double (*)(const Flown&)> values{
      {"air_speed", [](const Flown& at) { return at.v_a.norm(); }},
      {"north", [](const Flown& at) { return at.v_eb_n.x(); }},
      {"east", [](const Flown& at) { return at.v_eb_n.y(); }},
      {"down", [](const Flown& at) { return at.v_eb_n.z(); }},
      {"roll", [](const Flown& at) { return at.angles.roll / deg; }},
      {"pitch", [](const Flown& at) { return at.angles.pitch / deg; }},
      {"heading", [](const Flown& at) { return at.angles.heading / deg; }},
      {"attack", [](const Flown& at) { return std::atan2(at.v_a.z(), at.v_a.x()) / deg; }}};
  const auto value = values.at(what);
  constexpr std::size_t every = 25;  // rows of 10 ms
  Curve curve;
  for (std::size_t row = 0; row < plant::published_flight().times_us().size(); row += every) {
    const Flown now = flown_at(row);
    curve.points.emplace_back(now.t_s, value(now));
  }
  return curve;
}

}  // namespace

Result<PageContent> page_content(const Results& results, const FlyOptions& /*options*/,
                                 const std::filesystem::path& /*exact*/) {
  PageContent content;
  add_scores(content.names, results);
  add_claims(content.names, results);
  content.names["end_of_flight"] = [](Words&) {
    const Flown end = flown_at(plant::published_flight().times_us().size() - 1);
    return fmt::format("{:.0f} m/s and {:.2f} km, heading {:+.1f} deg", end.v_a.norm(), end.height / 1000,
                       end.angles.heading / deg);
  };
  content.curves["error"] = [&results](Words& words) {
    constexpr std::size_t step = 10;  // answers come every 100 ms: one point per second
    return over_time(results.of("table1").curve(words.rest(), quantities::wind_norm), 1, step);
  };
  content.curves["wind_speed"] = [](Words& words) {
    return profile(words.rest(), [](const world::Vector3& wind_n) { return wind_n.norm(); });
  };
  content.curves["wind_from"] = [](Words& words) { return profile(words.rest(), from_deg); };
  content.curves["flight"] = [](Words& words) { return flight(words.rest()); };
  content.bars_met =
      passed(results.of("table1"), lost_requirement) &&
      std::ranges::all_of(judged, [&](const char* name) { return passed(results.of(name), requirement); });
  return content;
}

}  // namespace canhil::papers::wind
