// The figures, and what the paper did not ask: any start, other paths, forms of the filters, late and lost
// data.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "bench/papers/inflight_alignment/sections.hpp"

namespace canhil::papers::inflight_alignment {
namespace {

constexpr double deg = std::numbers::pi / 180;

std::string percent(double fraction) { return fmt::format("{:.1f} %", 100 * fraction); }
std::string number(double value) { return fmt::format("{:.3g}", value); }

const std::vector<std::string> spread_head{"filter",       "RMS", "RMS of 100 runs", "median", "p90",
                                           "below 10 deg", ""};
Row spread(std::string filter, const Heading& h, std::string remark = "") {
  return {.cells = {std::move(filter), number(h.rms), fmt::format("{:.2g} to {:.2g}", h.rms_low, h.rms_high),
                    number(h.median), number(h.p90), percent(h.below_10_deg)},
          .mark = Mark::none,
          .verdict = std::move(remark)};
}
constexpr const char* spread_note =
    "Heading error at 300 s [deg]; 'RMS of 100 runs': 5 % to 95 % of the RMS of 100 runs drawn from these "
    "(bootstrap).";

struct Filter {
  const char* stem;
  const char* label;
};
constexpr std::array filters{Filter{"ekf", "EKF"}, Filter{"ukf", "UKF"}, Filter{"nav", "EKF nav"},
                             Filter{"sincos", "sin/cos"}};
struct Start {
  const char* stem;
  const char* label;
};
constexpr std::array drawn_starts{Start{"n30", "N(0, 30 deg)"}, Start{"n45", "N(0, 45 deg)"},
                                  Start{"90", "90 deg to either side"}};

Figure figure(const Results& results, int number, const char* campaign, const char* aid, const Start& start) {
  Figure drawn{
      .id = fmt::format("fig{}", number),
      .title = fmt::format("Fig {}: {}, start {}", number, aid, start.label),
      .caption = fmt::format(
          "RMS of the heading error over the first {} runs, as many as the paper flew. EKF and UKF in open "
          "loop; EKF nav: closed loop, error in navigation axes; sin/cos: this product's filter. IMU 50 Hz, "
          "a fix "
          "each second, {}.",
          std::min<std::uint64_t>(100, results.runs), frames_flown(results.campaigns)),
      .y_label = "heading error, RMS [deg]",
      .x_range = {0, 300},
      .y_range = {0.3, 200},
      .thresholds = {},
      .curves = {}};
  for (const Filter& filter : filters) {
    Curve curve{.label = filter.label, .points = {}};
    for (const campaign::CurvePoint& point :
         results.curves.find(fmt::format("{} {}_{}", campaign, filter.stem, start.stem))->second)
      add_rms(curve, static_cast<double>(point.t_us) * 1e-6, point, deg);
    drawn.curves.push_back(std::move(curve));
  }
  return drawn;
}

}  // namespace

Section figures(const Results& results) {
  Section section{.id = "figures",
                  .title = "Figs 5 to 10: heading against time",
                  .paragraphs = {},
                  .tables = {},
                  .figures = {}};
  int number = 5;
  for (const auto& [campaign, aid] : {std::pair{"ssbl", "SSBL"}, std::pair{"gps", "GPS"}}) {
    Table table{.head = spread_head, .rows = {}, .note = spread_note};
    for (const Start& start : drawn_starts) {
      section.figures.push_back(figure(results, number++, campaign, aid, start));
      for (const Filter& filter : filters) {
        const std::string variant = fmt::format("{}_{}", filter.stem, start.stem);
        table.rows.push_back(spread(fmt::format("{}, {}, {}", aid, start.label, filter.label),
                                    results.heading(campaign, variant),
                                    fmt::format("{:.2g} repairs", results.repairs(campaign, variant))));
      }
    }
    section.tables.push_back(std::move(table));
  }
  return section;
}

Section starts(const Results& results) {
  Table table{.head = spread_head, .rows = {}, .note = spread_note};
  for (const auto& [aid, label] : {std::pair{"ssbl", "SSBL"}, std::pair{"gps", "GPS"}}) {
    for (const char* from : {"30", "45", "90", "150", "180"})
      table.rows.push_back(spread(fmt::format("{} sin/cos from {} deg", label, from),
                                  results.heading("starts", fmt::format("{}_sincos_{}", aid, from))));
    for (const auto& [stem, filter] : {std::pair{"ekf", "EKF"}, std::pair{"ukf", "UKF"}}) {
      for (const char* from : {"150", "180"}) {
        const std::string variant = fmt::format("{}_{}_{}", aid, stem, from);
        table.rows.push_back(spread(fmt::format("{} {} from {} deg", label, filter, from),
                                    results.heading("starts", variant),
                                    fmt::format("{:.2g} repairs", results.repairs("starts", variant))));
      }
    }
  }
  return {
      .id = "starts",
      .title = "From anywhere",
      .paragraphs =
          {"The hard nonlinearity is the product of tilt and heading: in the paper's psi the tilts stand in "
           "platform "
           "axes, and gravity projects them through the heading error. With the sine and cosine of the "
           "heading error "
           "as states and the tilts in computer axes the model is linear, and the start does not matter."},
      .tables = {std::move(table)},
      .figures = {}};
}

Section paths(const Results& results) {
  Table table{
      .head = {"path, aid", "EKF", "UKF", "EKF nav", "sin/cos", "UKF ahead by RMS"},
      .rows = {},
      .note =
          "From 90 deg. Heading error at 300 s [deg]: RMS [5 % to 95 % of the RMS of 100 runs] (median)."};
  for (const auto& [aid, label] : {std::pair{"ssbl", "SSBL"}, std::pair{"gps", "GPS"}}) {
    for (const auto& [stem, path] :
         {std::pair{"50_33", "±50 deg in 33 s"}, std::pair{"30_33", "±30 deg in 33 s"},
          std::pair{"30_100", "±30 deg in 100 s"}, std::pair{"60_40", "±60 deg in 40 s"},
          std::pair{"60_100", "±60 deg in 100 s"}, std::pair{"90_100", "±90 deg in 100 s"}}) {
      const auto of = [&, aid = aid, stem = stem](const char* filter) {
        return results.heading("paths", fmt::format("{}_{}_{}", aid, filter, stem));
      };
      const bool ahead = of("ukf").rms < of("ekf").rms;
      table.rows.push_back({.cells = {fmt::format("{}, {}", path, label), words(of("ekf")), words(of("ukf")),
                                      words(of("nav")), words(of("sincos"))},
                            .mark = ahead ? Mark::yes : Mark::no,
                            .verdict = ahead ? "yes" : "no"});
    }
  }
  return {.id = "paths",
          .title = "Other paths: what is robust and what is not",
          .paragraphs = {"The paper's order, UKF before EKF, holds for the median more often than for the "
                         "RMS; the RMS depends on how "
                         "many runs stay stuck, and that on the path. sin/cos is below both on every path."},
          .tables = {std::move(table)},
          .figures = {}};
}

Section forms(const Results& results) {
  Table table{.head = spread_head, .rows = {}, .note = spread_note};
  for (const auto& [aid, label] : {std::pair{"ssbl", "SSBL"}, std::pair{"gps", "GPS"}}) {
    for (const auto& [stem, form] : {std::pair{"ekf_open", "EKF, open loop (paper)"},
                                     std::pair{"ekf_closed", "EKF, closed loop, P turned at the reset"},
                                     std::pair{"ukf_cholesky", "UKF, lower Cholesky (paper)"},
                                     std::pair{"ukf_symmetric", "UKF, symmetric root"},
                                     std::pair{"ukf_central", "UKF, covariance about the central point"}}) {
      const std::string variant = fmt::format("{}_{}", aid, stem);
      table.rows.push_back(spread(fmt::format("{} {}", label, form), results.heading("forms", variant),
                                  fmt::format("{:.2g} repairs", results.repairs("forms", variant))));
    }
  }
  return {.id = "forms",
          .title = "What the filters owe to their form",
          .paragraphs = {"The UKF's central weight is negative, so its covariance may lose positive "
                         "definiteness; it is then "
                         "repaired, counted and told on the bus. The choice of the root alone moves the UKF "
                         "as much as the paper's "
                         "gap between UKF and EKF."},
          .tables = {std::move(table)},
          .figures = {}};
}

Section late_fixes(const Results& results) {
  Table table{
      .head = {"latency of the fixes", "at their time of validity", "at their arrival", "handling pays"},
      .rows = {},
      .note =
          "sin/cos, SSBL, from 90 deg. Heading error at 300 s [deg]: RMS [5 % to 95 % of the RMS of 100 "
          "runs] (median)."};
  for (const char* ms : {"0", "100", "200", "500", "1000", "1500", "2000"}) {
    const std::string point = fmt::format("ssbl.latency_ms={}", ms);
    const Heading valid = results.heading("late", "at_validity", point),
                  arrival = results.heading("late", "at_arrival", point);
    const bool pays = valid.rms < arrival.rms;
    table.rows.push_back({.cells = {fmt::format("{} ms", ms), words(valid), words(arrival)},
                          .mark = pays ? Mark::yes : Mark::none,
                          .verdict = pays ? fmt::format("{:.1f} times", arrival.rms / valid.rms) : "-"});
  }
  return {.id = "late",
          .title = "Late fixes",
          .paragraphs = {"A fix is applied against the INS of its time of validity, out of a history of the "
                         "IMU's samples, and the "
                         "samples since are navigated again. Taken as if it were new, each fix pulls the "
                         "position back by speed times "
                         "latency."},
          .tables = {std::move(table)},
          .figures = {}};
}

Section losses(const Results& results) {
  Table table{.head = spread_head, .rows = {}, .note = spread_note};
  for (const auto& [variant, label] :
       {std::pair{"imu_0", "nothing lost"}, std::pair{"imu_1", "1 % of the IMU's groups lost"},
        std::pair{"imu_2", "2 %"}, std::pair{"imu_5", "5 %"}, std::pair{"fix_10", "10 % of the fixes lost"},
        std::pair{"fix_30", "30 %"}, std::pair{"fix_50", "50 %"}, std::pair{"fix_80", "80 %"},
        std::pair{"outlier_5", "5 % of the fixes off by 200 m, gated"}, std::pair{"outlier_20", "20 %"}})
    table.rows.push_back(spread(label, results.heading("loss", variant)));
  return {.id = "losses",
          .title = "Lost and wrong data",
          .paragraphs = {"A lost group of the IMU is bridged with the mean of its neighbours and flagged as "
                         "coasting. sin/cos, SSBL, from "
                         "90 deg."},
          .tables = {std::move(table)},
          .figures = {}};
}

}  // namespace canhil::papers::inflight_alignment
