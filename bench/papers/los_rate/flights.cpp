// The figures and tables of the page.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "bench/estimators/los_rate/los_rate.hpp"
#include "bench/estimators/los_rate/quantities.hpp"
#include "bench/papers/los_rate/sections.hpp"
#include "bench/world/units.hpp"

namespace canhil::papers::los_rate {
namespace {

std::string rms_words(double value) { return fmt::format("{:.2f}", value); }

struct Filter {
  const char* variant;
  const char* label;
  /// RMS of a simulation in double precision by window, one plane [mrad/s]; 0: none.
  std::array<double, windows.size()> reference;
};
constexpr std::array filters{
    Filter{"kalman", "Kalman filter", {7.07, 1.20, 0.95, 1.05, 5.10, 5.01, 16.7}},
    Filter{"combined", "combined gain after 2.5 s of Kalman filter", {}},
    Filter{"combined_at_once", "combined gain at once", {5.29, 1.82, 0.95, 1.05, 5.10, 5.01, 16.7}},
    Filter{"switched", "switched table after 2.5 s of Kalman filter", {}},
    Filter{"switched_at_once", "switched table at once (paper)", {5.29, 1.82, 0.98, 1.10, 5.09, 5.01, 16.7}},
    Filter{"thermal_only", "thermal gain down to 215 m", {5.29, 1.82, 0.98, 1.58, 7.96, 62.0, 553}},
    Filter{"low_pass_4", "low-pass, 4 rad/s", {4.31, 1.07, 0.71, 0.60, 12.4, 14.5, 9.1}},
    Filter{"low_pass_8", "low-pass, 8 rad/s", {5.06, 1.33, 0.81, 0.68, 8.39, 6.04, 12.9}},
    Filter{"low_pass_12", "low-pass, 12 rad/s", {6.37, 2.19, 1.18, 0.92, 6.04, 4.25, 12.9}}};

std::vector<std::string> window_head(std::string first, std::size_t from = 0) {
  std::vector<std::string> head{std::move(first)};
  for (std::size_t i = from; i < windows.size(); ++i)
    head.push_back(fmt::format("{:g}-{:g} s", windows[i].most, windows[i].least));
  head.emplace_back("");
  return head;
}

Row window_row(const Results& results, const char* campaign, std::string label, const char* variant,
               std::size_t from) {
  Row row{.cells = {std::move(label)}, .mark = Mark::none, .verdict = ""};
  for (std::size_t i = from; i < windows.size(); ++i)
    row.cells.push_back(rms_words(results.rms(campaign, variant, windows[i])));
  return row;
}

Table table_of_windows(const Results& results) {
  Table table{.head = window_head("filter"),
              .rows = {},
              .note =
                  "RMS of the LOS rate error by time to go, mrad/s, both planes together; in brackets one "
                  "plane of a simulation in double precision, other random numbers."};
  for (const Filter& filter : filters) {
    Row row = window_row(results, "open_loop", filter.label, filter.variant, 0);
    for (std::size_t i = 0; i < windows.size(); ++i) {
      if (filter.reference[i] > 0) row.cells[i + 1] += fmt::format(" ({:g})", filter.reference[i]);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table table_of_rates(const Results& results) {
  Table table{.head = window_head("seeker, filter", first_settled),
              .rows = {},
              .note =
                  "RMS of the LOS rate error, mrad/s. A simulation in double precision gave, for 3-2, 2-1, "
                  "1-0.5 and 0.5-0.2 s: 1.10, 1.22, 6.15, 6.22 at 100 Hz, 0.81, 0.88, 3.83, 4.10 at 500 Hz."};
  for (const char* hz : {"100", "500"}) {
    for (const auto& [stem, label] :
         {std::pair{"kalman", "Kalman filter"}, std::pair{"combined", "combined"}})
      table.rows.push_back(window_row(results, "rates", fmt::format("{} Hz, {}", hz, label),
                                      fmt::format("{}_{}", stem, hz).c_str(), first_settled));
  }
  return table;
}

Figure rms_figure(const Results& results) {
  Figure figure{
      .id = "fig2",
      .title = "Fig 2: error of the LOS rate against time",
      .caption = fmt::format("RMS over {} runs and both planes in each 20 ms of the time to go. The target "
                             "turns with 4 g from 1 s to go.",
                             results.runs),
      .y_label = "LOS rate error, RMS [mrad/s]",
      .x_label = "time from the closest approach [s]",
      .x_range = {-5.5, 0},
      .y_range = {0.3, 300},
      .thresholds = {},
      .curves = {}};
  const double half_us = static_cast<double>(estimators::los_rate.layout.to_go_stretch_us) / 2;
  for (const auto& [variant, label] :
       {std::pair{"kalman", "Kalman"}, std::pair{"switched_at_once", "switched"},
        std::pair{"combined", "combined"}, std::pair{"low_pass_4", "4 rad/s"},
        std::pair{"low_pass_8", "8 rad/s"}, std::pair{"low_pass_12", "12 rad/s"}}) {
    Curve curve{.label = label, .points = {}};
    for (const campaign::CurvePoint& point :
         results.of("open_loop").curve(variant, {}, quantities::los_rate_both)) {
      const double middle_s = 1e-6 * (static_cast<double>(point.t_us) + half_us);
      constexpr double blind_s = 0.06;  // from 50 m on guidance is to hold
      if (middle_s < -blind_s) add_rms(curve, middle_s, point, world::units::mrad);
    }
    figure.curves.push_back(std::move(curve));
  }
  return figure;
}

// Of the displacement frame: 1.70 Om, Om = (q / (r^2 R Ts))^(1/6), where vc/r is small against Om.
double bandwidth_hz(double range, double thermal, double glint) {
  constexpr double jerk_density = 300, sample_period = 0.005;
  const double variance = std::pow(thermal * range * range, 2) + std::pow(glint / range, 2);
  const double omega = std::pow(jerk_density / (range * range * variance * sample_period), 1.0 / 6);
  return 1.70 * omega / (2 * std::numbers::pi);
}

Figure bandwidth_figure() {
  Figure figure{.id = "fig3",
                .title = "Fig 3: bandwidth against range",
                .caption =
                    "-3 dB bandwidth of the LOS rate, true to estimated, in displacement states: 1.70 Om. It "
                    "holds for every closing speed for which vc is small against r Om (here vc/(r Om) is "
                    "0.02 to 0.13 at 1 km); 500 Hz or another q move it by the sixth root.",
                .y_label = "bandwidth [Hz]",
                .x_label = "range [m]",
                .x_range = {0, 5000},
                .y_range = {0.3, 30},
                .thresholds = {},
                .curves = {}};
  for (const auto& [label, thermal, glint] :
       {std::tuple{"thermal", 1e-10, 0.0}, std::tuple{"glint", 0.0, 0.5}, std::tuple{"both", 1e-10, 0.5}}) {
    Curve curve{.label = label, .points = {}};
    for (int i = 1; i <= 100; ++i)
      curve.points.emplace_back(50.0 * i, bandwidth_hz(50.0 * i, thermal, glint));
    figure.curves.push_back(std::move(curve));
  }
  return figure;
}

std::string miss_words(const Miss& miss) { return fmt::format("{:.2f} / {:.2f}", miss.median, miss.rms); }

}  // namespace

Section open_loop(const Results& results) {
  return {.id = "open-loop",
          .title = "Every filter on the same flights",
          .paragraphs =
              {"Guidance is on the truth, so that every filter meets the same data. 'At once': the closed "
               "gain from the first sample on, as the paper has it; the product runs a Kalman filter for "
               "the first 2.5 s."},
          .tables = {table_of_windows(results), table_of_rates(results)},
          .figures = {rms_figure(results)}};
}

Section closing_speed(const Results& results) {
  Table table{
      .head = {"closing speed", "RMS of the LOS rate, 1.2 to 0.8 km", ""},
      .rows = {},
      .note =
          "Thermal noise alone, thermal gain, no manoeuvre: what is left is noise through the bandwidth. "
          "mrad/s, both planes."};
  for (const int vc : {300, 600, 900, 1200, 1800}) {
    const double rms = results.figure("closing_speed", fmt::format("noise at 1 km, vc {}", vc),
                                      fmt::format("vc_{}", vc), "rms_mradps");
    table.rows.push_back(
        {.cells = {fmt::format("{} m/s", vc), rms_words(rms)}, .mark = Mark::none, .verdict = ""});
  }
  return {.id = "closing-speed",
          .title = "Closing speed",
          .paragraphs =
              {"The bandwidth does not depend on the closing speed: 3.68 Hz at 1 km from 300 to 1800 m/s, "
               "within 0.5 %; a unit test holds it to 2 %. The gain does: K1 goes from 28.6 to 36.1 1/s. And "
               "where vc/(r Om) is of order 1 (low q, much noise) the bandwidth does too: 2.9 Om at 1."},
          .tables = {std::move(table)},
          .figures = {bandwidth_figure()}};
}

Section formulas() {
  return {
      .id = "formulas",
      .title = "What is a property of the formulas",
      .paragraphs =
          {"That range scaling turns the Riccati equation into an algebraic one, exactly, is a property of "
           "the formulas and not of a flight: unit tests hold the closed forms against a table of the "
           "algebraic equation (1e-9), start the differential equation on them from 5 km to 50 m (1e-7), "
           "and compare gains with the discrete Kalman filter's. Only an r^4 variance in range scales "
           "exactly (thermal noise of an active seeker); glint is a chain of integrators in displacement "
           "states; a Singer target scales with neither."},
      .tables = {},
      .figures = {}};
}

Section closed_loop(const Results& results) {
  struct Line {
    const char* variant;
    const char* label;
    const char* reference;
  };
  Table table{
      .head = {"guidance on", "miss in one plane, median / RMS", "simulation", "RMS of the distance", ""},
      .rows = {},
      .note =
          "m. A command is made of an answer 10 ms after its sample was sent, the simulation had no delay. "
          "'Simulation': one plane in double precision, other random numbers."};
  for (const Line& line :
       {Line{"truth", "the truth", "0.05 / 0.05"}, Line{"kalman", "Kalman filter", "0.20 / 0.26"},
        Line{"combined", "combined gain", "0.20 / 0.26"}, Line{"switched", "switched table", "0.20 / 0.26"},
        Line{"combined_q3000", "combined gain, q = 3000", "0.17 / 0.22"},
        Line{"thermal_only", "thermal gain down to 215 m", "0.51 / 0.59"},
        Line{"low_pass_4", "low-pass, 4 rad/s", "9.1 / -"},
        Line{"low_pass_6", "low-pass, 6 rad/s", "4.4 / -"},
        Line{"low_pass_8", "low-pass, 8 rad/s", "1.60 / 1.61"},
        Line{"low_pass_12", "low-pass, 12 rad/s", "0.47 / 0.49"},
        Line{"low_pass_20", "low-pass, 20 rad/s", "0.62 / 0.64"}}) {
    const Miss miss = results.miss("closed_loop", line.variant);
    table.rows.push_back({.cells = {line.label, miss_words(miss), line.reference, rms_words(miss.of_both)},
                          .mark = Mark::none,
                          .verdict = ""});
  }
  return {.id = "closed-loop",
          .title = "Closed loop: miss",
          .paragraphs =
              {"Here the missile flies on the LOS rates that the target sends; the navigation constant is 4 "
               "for all."},
          .tables = {std::move(table)},
          .figures = {}};
}

Section delays(const Results& results) {
  Table table{
      .head = {"ms", "latency: combined", "Kalman", "12 rad/s", "jitter: combined", "Kalman", "12 rad/s", ""},
      .rows = {},
      .note =
          "Miss in one plane, m: median / RMS. Jitter: every sample is late by 0 to this, and none "
          "overtakes another."};
  for (const char* ms : {"0", "5", "10", "20", "50", "100"}) {
    Row row{.cells = {ms}, .mark = Mark::none, .verdict = ""};
    for (const char* what : {"latency", "jitter"}) {
      for (const char* variant : {"combined", "kalman", "low_pass_12"})
        row.cells.push_back(
            miss_words(results.miss(what, variant, fmt::format("seeker.{}_ms={}", what, ms))));
    }
    table.rows.push_back(std::move(row));
  }
  return {.id = "delays",
          .title = "Latency and jitter of the bus",
          .paragraphs =
              {"Samples say when they were valid, so late ones spoil no estimate of that time; but guidance "
               "acts on an estimate that is as old as the delay."},
          .tables = {std::move(table)},
          .figures = {}};
}

Section glint(const Results& results) {
  Table table{
      .head = window_head("filter", first_settled),
      .rows = {},
      .note =
          "RMS of the LOS rate error, mrad/s; glint of 0.5 m correlated over 40 ms. Told white: 0.5 m a "
          "sample; told its density: 2 tau sigma^2, 2 m a sample."};
  for (const auto& [variant, label] :
       {std::pair{"kalman_white", "Kalman filter, told white"},
        std::pair{"kalman_density", "Kalman filter, told the density"},
        std::pair{"combined_white", "combined, told white"},
        std::pair{"combined_density", "combined, told the density"},
        std::pair{"low_pass_8", "low-pass, 8 rad/s"}, std::pair{"low_pass_12", "low-pass, 12 rad/s"}})
    table.rows.push_back(window_row(results, "glint", label, variant, first_settled));
  return {.id = "glint",
          .title = "Glint that is not white",
          .paragraphs =
              {"The paper takes glint as white. Correlated glint is worse for every filter that believes "
               "that, the Kalman filter included; telling its density helps in the quiet and hurts at the "
               "onset of the manoeuvre. A state for it was not tried."},
          .tables = {std::move(table)},
          .figures = {}};
}

Section settings(const Results& results) {
  return {
      .id = "settings",
      .title = "Settings",
      .paragraphs =
          {fmt::format(
               "{} flights in virtual time, each through the codec with {}. Run r has the same random "
               "numbers in every variant (seed 20260501).",
               results.flights, frames_flown(results.campaigns)),
           "Head-on at 900 m/s from 5 km, PN with N = 4, autopilot 0.15 s, 35 g; heading error 3 deg, 1 "
           "sigma, and "
           "a turn of 4 g to either side from 1 s to go, in each of two planes. Seeker 200 Hz: thermal 2.5 "
           "mrad "
           "at 5 km, glint 5 mrad at 100 m a sample; they cross at 1710 m. Antenna loop 12 1/s, gyro 1 and "
           "0.5 mrad/s, range 5 and 15 m (less within 1 km), closing speed 3 and 5 m/s, accelerometer 0.3 "
           "and "
           "0.2 m/s^2: noise and constant error. q = 300 m^2/s^5.",
           "The paper gives no engagement in full; these are the reproduction's. Corrected against its "
           "print: the "
           "third state is the target's acceleration; eq. (4) lacks +u; K3 = P3bar/(s2 r^2) in (9); (10) is "
           "vc^2 P1bar/r^4 + 2 vc P2bar/r^3 + P4bar/r^2; K3 = r P3bar/s2 in (11); R is the variance of a "
           "sample "
           "times the sample period."},
      .tables = {},
      .figures = {}};
}

}  // namespace canhil::papers::los_rate
