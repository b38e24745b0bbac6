// Content of the page on the LOS rate: errors by time to go, misses, bandwidths.
#include "bench/papers/page_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "bench/estimators/los_rate/los_rate.hpp"
#include "bench/estimators/los_rate/quantities.hpp"
#include "bench/world/units.hpp"

namespace canhil::papers::los_rate {
namespace {

constexpr std::array judged{"open_loop", "closed_loop"};

// A window of the time to go [s].
struct Window {
  double most, least;
};
constexpr std::array windows{Window{5.6, 4.5}, Window{4.5, 3},   Window{3, 2},     Window{2, 1},
                             Window{1, 0.5},   Window{0.5, 0.2}, Window{0.2, 0.08}};
constexpr std::size_t first_settled = 2;  // first window after the start-up

// RMS of the LOS rate error over both planes [mrad/s].
double rms(const Flown& flown, std::string_view variant, const Window& window) {
  return figure(flown.answer(fmt::format("RMS {:g}-{:g}", window.most, window.least), variant), "rms_mradps");
}

// Miss distance per plane over the runs of a variant [m], averaged over the pitch and the yaw plane: the mean
// of the two medians, and the root of the mean of the two mean squares.
struct Miss {
  double median = 0, rms = 0;
};
Miss miss(const Flown& flown, std::string_view variant) {
  const campaign::Answer &pitch = flown.answer("miss_pitch", variant),
                         &yaw = flown.answer("miss_yaw", variant);
  const double pitch_rms = figure(pitch, "rms_m"), yaw_rms = figure(yaw, "rms_m");
  return {.median = (figure(pitch, "median_m") + figure(yaw, "median_m")) / 2,
          .rms = std::sqrt((pitch_rms * pitch_rms + yaw_rms * yaw_rms) / 2)};
}
std::string words_of(const Miss& one) { return fmt::format("{:.2f} / {:.2f}", one.median, one.rms); }

std::string two_digits(double value) { return fmt::format("{:.2f}", value); }

void add_tables(Names& names, const Results& results) {
  // Arguments: a campaign, a variant and, optionally, one reference value for each window. The reference
  // values are shown in brackets.
  const auto by_window = [&results](std::size_t from) {
    return [&results, from](Words& words) {
      const Flown& flown = results.of(words.next());
      const std::string_view variant = words.next();
      const bool with_reference = !words.empty();
      std::string cells;
      for (std::size_t i = from; i < windows.size(); ++i) {
        cells += (cells.empty() ? "" : " | ") + two_digits(rms(flown, variant, windows[i]));
        if (with_reference) cells += fmt::format(" ({})", words.next());
      }
      return cells;
    };
  };
  names["windows"] = by_window(0);
  names["settled_windows"] = by_window(first_settled);
  names["noise"] = [&results](Words& words) {
    const std::string_view vc = words.rest();
    return two_digits(figure(
        results.of("closing_speed").answer(fmt::format("noise at 1 km, vc {}", vc), fmt::format("vc_{}", vc)),
        "rms_mradps"));
  };
  names["miss"] = [&results](Words& words) {
    return words_of(miss(results.of("closed_loop"), words.rest()));
  };
  names["distance"] = [&results](Words& words) {
    return two_digits(figure(results.of("closed_loop").answer("miss", words.rest()), "rms_m"));
  };
  names["miss_rms"] = [&results](Words& words) {
    const Flown& flown = results.of(words.next());
    return two_digits(miss(flown, words.rest()).rms);
  };
  names["delayed"] = [&results](Words& words) {
    const std::string_view ms = words.rest();
    std::string cells;
    for (const char* what : {"latency", "jitter"}) {
      for (const char* variant : {"combined", "kalman", "low_pass_12"})
        cells += (cells.empty() ? "" : " | ") +
                 words_of(miss(results.of(what), fmt::format("{} seeker.{}_ms={}", variant, what, ms)));
    }
    return cells;
  };
}

// Adds template names for the paper's claims: whether each claim holds, and the numbers that decide this.
void add_claims(Names& names, const Results& results) {
  const Flown &open = results.of("open_loop"), &closed = results.of("closed_loop");
  const auto claim = [&names](const char* name, bool holds) { names[name] = [=](Words&) { return holds; }; };
  const auto number = [&names](const char* name, const char* format, double value) {
    names[name] = [=](Words&) { return papers::number(format, value); };
  };
  // The RMS of the variant is divided by the RMS of the Kalman filter, for each window after the start-up.
  // Returns the largest deviation of this ratio from 1.
  const auto departure = [&](const char* variant) {
    double largest = 0;
    for (std::size_t i = first_settled; i < windows.size(); ++i)
      largest =
          std::max(largest, std::abs(rms(open, variant, windows[i]) / rms(open, "kalman", windows[i]) - 1));
    return largest;
  };
  constexpr double as_good = 0.1;
  number("switched_departs_percent", ".1f", 100 * departure("switched"));
  claim("switched_as_good", departure("switched") <= as_good);
  number("combined_departs_percent", ".1f", 100 * departure("combined"));
  claim("combined_as_good", departure("combined") <= as_good);

  const double at_once = rms(open, "switched_at_once", windows[1]), kalman = rms(open, "kalman", windows[1]);
  number("at_once", ".2f", at_once);
  number("kalman_by_then", ".2f", kalman);
  number("at_once_over_kalman", ".2f", at_once / kalman);
  claim("no_start_up", at_once / kalman < 1.1);

  const auto over_best_fixed = [&](const Window& window) {
    double best = std::numeric_limits<double>::infinity();
    for (const char* variant : {"low_pass_4", "low_pass_8", "low_pass_12"})
      best = std::min(best, rms(open, variant, window));
    return rms(open, "combined", window) / best;
  };
  // `quiet` is for the window before the manoeuvre, from 3 to 2 s to go. `onset` is for the window at the
  // onset of the manoeuvre, from 1 to 0.5 s to go.
  const double quiet = over_best_fixed(windows[2]), onset = over_best_fixed(windows[4]);
  number("over_best_in_the_quiet", ".2f", quiet);
  number("over_best_at_the_onset", ".2f", onset);
  claim("better_by_rms", quiet < 1 && onset < 1);

  double best = std::numeric_limits<double>::infinity(), worst = 0;
  for (const char* variant : {"low_pass_4", "low_pass_6", "low_pass_8", "low_pass_12", "low_pass_20"}) {
    best = std::min(best, miss(closed, variant).rms);
    worst = std::max(worst, miss(closed, variant).rms);
  }
  number("best_fixed_miss", ".2f", best);
  number("worst_fixed_miss", ".2f", worst);
  claim("better_by_miss", miss(closed, "combined").rms < best);
}

// The bandwidth of the displacement frame [Hz]. In rad/s, the bandwidth is 1.70 omega with
// omega = (q / (r^2 R Ts))^(1/6),
// where q is the jerk density, r the range, R the variance of the angle and Ts the sample period. This holds
// if vc / r is small compared with omega, where vc is the closing speed.
double bandwidth_hz(double range, double thermal, double glint) {
  constexpr double jerk_density = 300, sample_period = 0.005;
  const double variance = std::pow(thermal * range * range, 2) + std::pow(glint / range, 2);
  const double omega = std::pow(jerk_density / (range * range * variance * sample_period), 1.0 / 6);
  return 1.70 * omega / (2 * std::numbers::pi);
}

Curve bandwidth(std::string_view noise) {
  Curve curve;
  for (int i = 1; i <= 100; ++i)
    curve.points.emplace_back(
        50.0 * i, bandwidth_hz(50.0 * i, noise == "glint" ? 0 : 1e-10, noise == "thermal" ? 0 : 0.5));
  return curve;
}

Curve error(const Flown& flown, std::string_view variant) {
  const double half_us = static_cast<double>(estimators::los_rate.layout.to_go_stretch_us) / 2;
  Curve curve;
  for (const campaign::CurvePoint& point : flown.curve(variant, quantities::los_rate_both)) {
    const double middle_s = 1e-6 * (static_cast<double>(point.t_us) + half_us);
    constexpr double blind_s = 0.06;  // within 50 m the guidance must hold its command
    if (middle_s < -blind_s) add_rms(curve, middle_s, point, world::units::mrad);
  }
  return curve;
}

}  // namespace

Result<PageContent> page_content(const Results& results, const FlyOptions& /*options*/,
                                 const std::filesystem::path& /*exact*/) {
  PageContent content;
  add_tables(content.names, results);
  add_claims(content.names, results);
  content.curves["error"] = [&results](Words& words) { return error(results.of("open_loop"), words.rest()); };
  content.curves["bandwidth"] = [](Words& words) { return bandwidth(words.rest()); };
  content.bars_met =
      std::ranges::all_of(judged, [&](const char* name) { return passed(results.of(name), "bar"); });
  return content;
}

}  // namespace canhil::papers::los_rate
