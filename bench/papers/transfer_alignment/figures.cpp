#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "bench/campaign/statistics.hpp"
#include "bench/papers/transfer_alignment/comparison.hpp"
#include "bench/papers/transfer_alignment/sections.hpp"

namespace canhil::papers::transfer_alignment {
namespace {

constexpr double mrad = 1e-3;
constexpr const char* at_10_hz = "master_ins.period_ms=100";

Curve curve(std::string label, std::span<const CurvePoint> points, double unit = mrad) {
  Curve drawn{.label = std::move(label), .points = {}};
  for (const CurvePoint& point : points) add_rms(drawn, static_cast<double>(point.t_us) * 1e-6, point, unit);
  return drawn;
}

// The points of a curve that the times into 3, 2 and 1 mrad tell.
Curve curve_through(std::string label, const Times& times) {
  Curve drawn{.label = std::move(label), .points = {}};
  for (const auto& [t_s, level_mrad] :
       {std::pair(times.within_3_mrad, 3.0), std::pair(times.within_2_mrad, 2.0),
        std::pair(times.within_1_mrad, 1.0)}) {
    if (std::isfinite(t_s)) drawn.points.emplace_back(t_s, level_mrad);
  }
  return drawn;
}

std::string runs_of(const Results& results) {
  return fmt::format("{} runs a curve, seed 20010101, {}", results.runs, frames_flown(results.campaigns));
}

constexpr std::string_view standard =
    "P0 1 deg for true errors of 5 deg, R = 0.01 (m/s)² s, master without noise, update 10 Hz, IMU 100 Hz";

}  // namespace

std::vector<Figure> case_figures(const Results& results) {
  const Flown &cases = results.of("cases"), &table = results.of("table2");
  const auto figure = [&](std::string id, std::string title, std::string alpha, const char* suffix) {
    Figure drawn{.id = std::move(id),
                 .title = std::move(title),
                 .caption = fmt::format(
                     "RMS over runs of the heading error. {}; {}. {}. The acceleration begins at 10 s. "
                     "Cases 1 and 4 are the same filter.",
                     standard, alpha, runs_of(results)),
                 .y_label = "heading error, 1σ [mrad]",
                 .thresholds = {1, 2, 3},
                 .curves = {curve("KF", table.curve("kf_p1"))}};
    for (const int number : {1, 2, 3, 4})
      drawn.curves.push_back(curve(fmt::format("H2 case {}", number),
                                   cases.curve(fmt::format("case{}_{}", number, suffix), at_10_hz)));
    return drawn;
  };
  return {figure("fig3", "Figs 3 and 4: heading, the four cases, alpha from the covariance",
                 "alpha from the filter's own covariance", "cov"),
          figure("fig4", "Figs 3 and 4 with a constant alpha", "alpha constant, 0.856 m/s² (5 deg of 1 g)",
                 "constant")};
}

std::vector<Figure> cruise_figures(const Results& results) {
  const Flown& cruise = results.of("cruise");
  const std::vector<CurvePoint> signs = all_signs(results);
  return {{.id = "fig5",
           .title = "Fig 5: heading before the acceleration",
           .caption = fmt::format(
               "RMS over runs of the heading error in cruise. Initial error 5 deg on each axis: random; "
               "+5 deg on all axes, which is what a single run can show; ±5 deg, all eight sign "
               "combinations pooled. P0 5 deg, R = 0.01 (m/s)² s, no master noise, update every 0.3 s. {}.",
               runs_of(results)),
           .y_label = "heading error, 1σ [mrad]",
           .x_range = {0, 10},
           .y_range = {10, 1000},
           .thresholds = {},
           .curves = {curve("KF, random", cruise.curve("kf_random")),
                      curve("H2, random", cruise.curve("h2_random")),
                      curve("H2, +5° fixed", cruise.curve("h2_ppp")), curve("H2, ±5°", signs)}}};
}

std::vector<Figure> size_figures(const Results& results) {
  const Flown& sizes = results.of("sizes");
  const auto figure = [&](std::string id, std::string filter, const char* stem) {
    Figure drawn{.id = std::move(id),
                 .title = fmt::format("Fig 6: initial errors of 20, 10, 5 and 1 deg, {}", filter),
                 .caption = fmt::format("RMS over runs of the heading error. P0 1 deg, R = 0.01 (m/s)² s, "
                                        "no master noise, update 10 Hz. {}.",
                                        runs_of(results)),
                 .y_label = "heading error, 1σ [mrad]",
                 .y_range = {0.1, 1000},
                 .thresholds = {3},
                 .curves = {}};
    for (const int size : {20, 10, 5, 1})
      drawn.curves.push_back(curve(fmt::format("{}°", size), sizes.curve(fmt::format("{}_e{}", stem, size))));
    return drawn;
  };
  return {figure("fig6-kf", "Kalman filter", "kf"), figure("fig6-h2", "H2 filter, case 2", "h2")};
}

std::vector<Figure> axis_figures(const Results& results) {
  const Flown& table = results.of("table2");
  std::vector<Figure> figures;
  figures.reserve(4);
  const std::array axes{std::pair{&quantities::attitude_heading, "heading"},
                        std::pair{&quantities::attitude_roll, "roll"},
                        std::pair{&quantities::attitude_pitch, "pitch"}};
  for (const auto& [quantity, axis] : axes) {
    figures.push_back(
        {.id = fmt::format("fig7-{}", axis),
         .title = fmt::format("Fig 7: {}", axis),
         .caption =
             fmt::format("RMS over runs of the {} error. {}, but the curve KF 5° is told the true 5 deg. {}.",
                         axis, standard, runs_of(results)),
         .y_label = fmt::format("{} error, 1σ [mrad]", axis),
         .y_range = {0.1, 300},
         .thresholds = {1, 3},
         .curves = {curve("KF told 1°", table.curve("kf_p1", {}, *quantity)),
                    curve("H2 told 1°", table.curve("h2_case2_p1", {}, *quantity)),
                    curve("KF told 5°", table.curve("kf_p5", {}, *quantity))}});
  }
  figures.front().curves.push_back(curve_through("paper KF", paper_kalman));
  figures.front().curves.push_back(curve_through("paper H2", paper_h2));
  figures.front().caption += " 'Paper': the times of its table 2 into 3, 2 and 1 mrad, both told 1 deg.";
  Figure velocity{
      .id = "velocity",
      .title = "Velocity errors",
      .caption = fmt::format("RMS over runs of the velocity errors. {}. {}.", standard, runs_of(results)),
      .y_label = "velocity error, 1σ [m/s]",
      .y_range = {0.001, 3},
      .thresholds = {},
      .curves = {}};
  for (const auto& [variant, filter] : {std::pair{"kf_p1", "KF"}, std::pair{"h2_case2_p1", "H2"}}) {
    for (const auto& [quantity, axis] :
         {std::pair{&quantities::velocity_north, "north"}, std::pair{&quantities::velocity_east, "east"},
          std::pair{&quantities::velocity_down, "down"}})
      velocity.curves.push_back(
          curve(fmt::format("{} {}", filter, axis), table.curve(variant, {}, *quantity), 1));
  }
  figures.push_back(std::move(velocity));
  return figures;
}

std::vector<Figure> artefact_figures(const Results& results) {
  const Flown& artefact = results.of("artefact");
  return {
      {.id = "artefact",
       .title = "What gives the gain: growth of the attitude covariance, not the H2 filter as such",
       .caption = fmt::format(
           "RMS over runs of the heading error. True errors 5 deg; told 1 deg, but KF 3° and KF 5° told 3 "
           "and "
           "5 deg; fading memory of 0.1 /s; Q: attitude process noise of 0.5 deg/√s. R = 0.01 (m/s)² s, no "
           "master noise, update every 0.3 s. {}.",
           runs_of(results)),
       .y_label = "heading error, 1σ [mrad]",
       .y_range = {0.1, 300},
       .thresholds = {1, 2, 3},
       .curves = {curve("KF", artefact.curve("kf")), curve("H2 case 2", artefact.curve("h2")),
                  curve("KF fading", artefact.curve("kf_fading_0.1")),
                  curve("KF 3°", artefact.curve("kf_p3")), curve("KF 5°", artefact.curve("kf_p5")),
                  curve("KF with Q", artefact.curve("kf_attitude_q_0.5"))}}};
}

std::vector<Figure> noise_figures(const Results& results) {
  const Flown& noise = results.of("noise");
  const auto point = [](const char* sigma) { return fmt::format("master_ins.velocity_noise_mps={}", sigma); };
  return {
      {.id = "noise",
       .title = "Told the truth (5 deg), with noise of the master",
       .caption = fmt::format(
           "RMS over runs of the heading error. P0 5 deg, the filter assumes 0.316 m/s; in brackets the true "
           "noise of the master's velocity [m/s]. Update 10 Hz. {}.",
           runs_of(results)),
       .y_label = "heading error, 1σ [mrad]",
       .y_range = {0.1, 1000},
       .thresholds = {1, 3},
       .curves = {curve("KF (0)", noise.curve("kf", point("0"))),
                  curve("KF (0.05)", noise.curve("kf", point("0.05"))),
                  curve("H2 c2 (0)", noise.curve("h2_case2", point("0"))),
                  curve("H2 c2 (0.02)", noise.curve("h2_case2", point("0.02"))),
                  curve("H2 c2 (0.05)", noise.curve("h2_case2", point("0.05")))}}};
}

}  // namespace canhil::papers::transfer_alignment
