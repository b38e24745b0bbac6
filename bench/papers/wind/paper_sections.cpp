// Table 1 and the figures.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "bench/estimators/wind/quantities.hpp"
#include "bench/papers/wind/sections.hpp"
#include "bench/world/glide/glide.hpp"

namespace canhil::papers::wind {
namespace {

constexpr double deg = std::numbers::pi / 180;

struct Filter {
  const char* stem;
  const char* label;
  const char* curve;                 // beside its end; empty: not drawn
  std::array<const char*, 3> paper;  // at 0, 20, 40 %
};
constexpr std::array filters{
    Filter{"low", "EKF, low Q (the paper's KF)", "EKF low Q", {"0.62 (0.07)", "2.24 (0.34)", "NaN"}},
    Filter{"hinf",
           "H-infinity, theta 0.03 a sample, same Q",
           "H-inf",
           {"0.74 (0.10)", "1.76 (0.24)", "3.53 (0.52)"}},
    Filter{"hinf_01", "H-infinity, theta 0.1 (capped)", "", {"", "", ""}},
    Filter{"omega", "EKF, Q of the rates 0.5 deg/s", "EKF Q rates", {"", "", ""}},
    Filter{"adaptive", "EKF, Q of the rates adapts to NIS", "EKF adaptive", {"", "", ""}},
    Filter{"low_corr", "EKF, low Q, correlated", "", {"", "", ""}},
    Filter{"corr", "EKF, Q 0.1 m/s and 1 deg/s, correlated", "EKF corr", {"", "", ""}}};
constexpr std::array levels{0, 20, 40};

std::string variant(const Filter& filter, int level) { return fmt::format("{}_{}", filter.stem, level); }

Figure error_figure(const Results& results, int number, int level) {
  Figure figure{.id = fmt::format("fig{}", number),
                .title = fmt::format("Fig {}: coefficients wrong by {} %", number, level),
                .caption = fmt::format("RMS over {} runs of the 3-D error of the wind. {}.", results.runs,
                                       frames_flown(results.campaigns)),
                .y_label = "wind error, RMS [m/s]",
                .x_range = {0, 100},
                .y_range = {0.1, 30},
                .thresholds = {},
                .curves = {}};
  for (const Filter& filter : filters) {
    if (*filter.curve == '\0') continue;
    Curve curve{.label = filter.curve, .points = {}};
    const auto points = results.of("table1").curve(variant(filter, level), {}, quantities::wind_norm);
    constexpr std::size_t step = 10;  // answers come every 100 ms: a point a second
    for (std::size_t i = 0; i < points.size(); i += step)
      add_rms(curve, static_cast<double>(points[i].t_us) * 1e-6, points[i]);
    figure.curves.push_back(std::move(curve));
  }
  return figure;
}

template <class Value>
Curve profile(std::string label, world::glide::Season season, Value value) {
  const world::glide::WindProfile wind(season);
  Curve curve{.label = std::move(label), .points = {}};
  for (double km = 0; km <= 15; km += 0.25) curve.points.emplace_back(km, value(wind.at(1000 * km)));
  return curve;
}

double from_deg(const world::Vector3& wind_n) {
  const double from = std::atan2(-wind_n.y(), -wind_n.x()) / deg;
  return from < 0 ? from + 360 : from;
}

Figure profiles(int number, const char* what, const char* label, std::pair<double, double> range,
                double (*value)(const world::Vector3&)) {
  Figure figure{
      .id = fmt::format("fig{}", number),
      .title = fmt::format("Fig {}: {}", number, what),
      .caption =
          "Synthetic profiles; components joined by lines between the kilometres. The glide sees 10 to "
          "8.6 km.",
      .y_label = label,
      .x_label = "height [km]",
      .logarithmic = false,
      .x_range = {0, 15},
      .y_range = range,
      .thresholds = {},
      .curves = {}};
  using world::glide::Season;
  for (const auto& [name, season] :
       {std::pair{"March", Season::march}, std::pair{"June", Season::june},
        std::pair{"September", Season::september}, std::pair{"December", Season::december}})
    figure.curves.push_back(profile(name, season, value));
  return figure;
}

// The nominal glide: no run of the target.
const world::GlideRecord& nominal_glide() {
  static const world::GlideRecord record({}, 100'000'000, world::Stream(0, 0, "none"),
                                         world::Stream(0, 0, "none"));
  return record;
}

template <class Value>
Curve over_time(std::string label, Value value) {
  Curve curve{.label = std::move(label), .points = {}};
  const auto epochs = nominal_glide().epochs();
  for (std::size_t k = 0; k < epochs.size(); k += 25)
    curve.points.emplace_back(static_cast<double>(epochs[k].t_us) * 1e-6, value(epochs[k]));
  return curve;
}

}  // namespace

Section table_1(const Results& results) {
  Table table{.head = {"filter", "0 %: paper", "0 %", "20 %: paper", "20 %", "40 %: paper", "40 %", "lost"},
              .rows = {},
              .note =
                  "Wind error, m/s: mean over t >= 10 s and over runs (standard deviation over runs). The "
                  "paper's KF and "
                  "H-infinity columns stand beside the filter in their role."};
  Table along{.head = {"filter", "along, 20 %", "across, 20 %", "down, 20 %", "along, 40 %", "across, 40 %",
                       "down, 40 %", ""},
              .rows = {},
              .note = "The same by component: along the horizontal air velocity, to its right, down."};
  for (const Filter& filter : filters) {
    std::vector<std::string> cells{filter.label};
    std::size_t lost = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      cells.emplace_back(filter.paper[i]);
      cells.push_back(words(results.score("table1", variant(filter, levels[i]))));
      lost += results.lost("table1", variant(filter, levels[i]));
    }
    table.rows.push_back({.cells = std::move(cells), .mark = Mark::none, .verdict = fmt::format("{}", lost)});
    std::vector<std::string> parts{filter.label};
    for (const int level : {20, 40}) {
      for (const char* axis : {"along track", "cross track", "down"})
        parts.push_back(words(results.score("table1", variant(filter, level), axis)));
    }
    along.rows.push_back({.cells = std::move(parts), .mark = Mark::none, .verdict = ""});
  }
  return {
      .id = "table1",
      .title = "Table 1 and Figs 7 to 9",
      .paragraphs = {},
      .tables = {std::move(table), std::move(along)},
      .figures = {error_figure(results, 7, 0), error_figure(results, 8, 20), error_figure(results, 9, 40)}};
}

Section glide(const Results& /*results*/) {
  Figure speed{.id = "fig5",
               .title = "Fig 5: speeds of the glide",
               .caption = "The nominal glide, March: let go level at 250 m/s through the air, heading north.",
               .y_label = "[m/s]",
               .logarithmic = false,
               .x_range = {0, 100},
               .y_range = {0, 280},
               .thresholds = {},
               .curves = {}};
  speed.curves = {over_time("air speed", [](const auto& t) { return t.v_a.norm(); }),
                  over_time("north", [](const auto& t) { return t.v_eb_n.x(); }),
                  over_time("east", [](const auto& t) { return t.v_eb_n.y(); }),
                  over_time("down", [](const auto& t) { return t.v_eb_n.z(); })};
  Figure attitude{.id = "fig6",
                  .title = "Fig 6: attitude of the glide",
                  .caption = "Pitch and roll are held, the heading drifts.",
                  .y_label = "[deg]",
                  .logarithmic = false,
                  .x_range = {0, 100},
                  .y_range = {-4, 6},
                  .thresholds = {},
                  .curves = {}};
  attitude.curves = {
      over_time("roll", [](const auto& t) { return world::euler_from(t.C_bn).roll / deg; }),
      over_time("pitch", [](const auto& t) { return world::euler_from(t.C_bn).pitch / deg; }),
      over_time("heading", [](const auto& t) { return world::euler_from(t.C_bn).heading / deg; }),
      over_time("attack", [](const auto& t) { return std::atan2(t.v_a.z(), t.v_a.x()) / deg; })};
  const world::GlideTruth& end = nominal_glide().epochs().back();
  return {.id = "glide",
          .title = "Figs 3 to 6: the wind and the glide",
          .paragraphs = {fmt::format("The glide ends at {:.0f} m/s and {:.2f} km, heading {:+.1f} deg.",
                                     end.v_a.norm(), end.height / 1000,
                                     world::euler_from(end.C_bn).heading / deg)},
          .tables = {},
          .figures = {profiles(3, "wind speed over the height", "wind speed [m/s]", {0, 80},
                               [](const world::Vector3& w) { return w.norm(); }),
                      profiles(4, "where the wind blows from", "from [deg]", {0, 360}, from_deg),
                      std::move(speed), std::move(attitude)}};
}

}  // namespace canhil::papers::wind
