// Content of the page on in-flight alignment: heading errors at 300 s, repairs of the covariance.
#include "bench/papers/page_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/campaign/statistics.hpp"
#include "bench/world/units.hpp"

namespace canhil::papers::inflight_alignment {
namespace {

constexpr std::array judged{"ssbl", "gps", "starts"};
constexpr std::size_t drawn_runs = 100;  // the number of runs in the paper

// Heading error at 300 s over the runs of a variant [deg].
struct Heading {
  double rms = 0, rms_low = 0, rms_high = 0;  // low and high: 5 % and 95 % quantile of the RMS of 100 runs
  double median = 0, p90 = 0;
  double below_10_deg = 0;  // fraction of runs
};
Heading heading(const Flown& flown, std::string_view variant) {
  const campaign::Answer& answer = flown.answer("heading at 300 s", variant);
  return {.rms = figure(answer, "rms_deg"),
          .rms_low = figure(answer, "rms_low_deg"),
          .rms_high = figure(answer, "rms_high_deg"),
          .median = figure(answer, "median_deg"),
          .p90 = figure(answer, "p90_deg"),
          .below_10_deg = figure(answer, "fraction_below")};
}

// "9.3 [2.8-15.3] (0.87)": RMS, its range, median.
std::string words_of(const Heading& h) {
  return fmt::format("{:.3g} [{:.2g}-{:.2g}] ({:.2g})", h.rms, h.rms_low, h.rms_high, h.median);
}

// The RMS of the heading over the first `drawn_runs` runs of each variant.
Result<Curves> first_runs(const Results& results, const FlyOptions& options) {
  std::map<std::string, Curve, std::less<>> drawn;
  for (const char* name : {"ssbl", "gps"}) {
    const auto store = campaign::Store::open(results_file(options, name));
    if (!store) return tl::unexpected(store.error());
    const campaign::Campaign& campaign = results.of(name).campaign;
    for (std::size_t v = 0; v < campaign.variants.size(); ++v) {
      const auto runs = store->load(v);
      if (!runs) return tl::unexpected(runs.error());
      const auto first = std::span(*runs).first(std::min(drawn_runs, runs->size()));
      drawn[fmt::format("{} {}", name, campaign.variants[v].name)] =
          over_time(campaign::rms_curve(first, quantities::attitude_heading), world::units::deg);
    }
  }
  return Curves{{"first_runs", [drawn = std::move(drawn)](Words& words) {
                   const auto found = drawn.find(words.rest());
                   if (found == drawn.end()) throw std::logic_error("is unknown");
                   return found->second;
                 }}};
}

void add_headings(Names& names, const Results& results) {
  const auto of = [&results](Words& words) {
    const Flown& flown = results.of(words.next());
    return heading(flown, words.rest());
  };
  names["rms"] = [=](Words& words) {
    const std::string_view format = words.next();
    return number(format, of(words).rms);
  };
  names["median"] = [=](Words& words) {
    const std::string_view format = words.next();
    return number(format, of(words).median);
  };
  names["rms_of_100"] = [=](Words& words) {
    const Heading h = of(words);
    return fmt::format("{:.2g} to {:.2g}", h.rms_low, h.rms_high);
  };
  names["heading"] = [=](Words& words) { return words_of(of(words)); };
  names["spread"] = [=](Words& words) {
    const Heading h = of(words);
    return fmt::format("{:.3g} | {:.2g} to {:.2g} | {:.3g} | {:.3g} | {:.1f} %", h.rms, h.rms_low, h.rms_high,
                       h.median, h.p90, 100 * h.below_10_deg);
  };
  // Whether the RMS of 100 runs in the paper lies between the 5 % and the 95 % quantile of our RMS of 100
  // runs.
  names["in_range"] = [=](Words& words) {
    const double paper_deg = std::stod(std::string(words.next()));
    const Heading ours = of(words);
    return paper_deg >= ours.rms_low && paper_deg <= ours.rms_high;
  };
  names["repairs"] = [&results](Words& words) {
    const std::string_view format = words.next();
    const Flown& flown = results.of(words.next());
    return number(format, figure(flown.answer("repairs", words.rest()), "mean"));
  };
  names["late"] = [&results](Words& words) {
    const std::string point = fmt::format("ssbl.latency_ms={}", words.rest());
    const Heading valid = heading(results.of("late"), "at_validity " + point),
                  arrival = heading(results.of("late"), "at_arrival " + point);
    return fmt::format(
        "{} | {} | {}", words_of(valid), words_of(arrival),
        valid.rms < arrival.rms ? fmt::format("[yes] {:.1f} times", arrival.rms / valid.rms) : "-");
  };
}

// Adds template names whose values compare the RMS of the EKF with the RMS of the UKF on other flight paths.
void add_paths(Names& names, const Results& results) {
  const auto cells = [&results](std::string_view aid, std::string_view path) {
    std::string text;
    std::array<double, 4> rms{};
    for (std::size_t i = 0; const char* filter : {"ekf", "ukf", "nav", "sincos"}) {
      const Heading h = heading(results.of("paths"), fmt::format("{}_{}_{}", aid, filter, path));
      rms[i++] = h.rms;
      text += words_of(h) + " | ";
    }
    return text + (rms[1] < rms[0] ? "[yes] yes" : "[no] no");
  };
  names["path"] = [=](Words& words) {
    const std::string_view aid = words.next();
    return cells(aid, words.rest());
  };
  std::size_t combinations = 0, reversed = 0;
  for (const campaign::Variant& variant : results.of("paths").campaign.variants) {
    std::string ukf = variant.name;
    const auto at = ukf.find("_ekf_");
    if (at == std::string::npos) continue;
    ukf.replace(at, 5, "_ukf_");
    ++combinations;
    if (!(heading(results.of("paths"), ukf).rms < heading(results.of("paths"), variant.name).rms)) ++reversed;
  }
  names["reversed"] = [=](Words&) { return fmt::format("{} of {}", reversed, combinations); };
}

// Adds template names for the paper's claims, and for those limits that are in no campaign file. Returns
// whether these limits are met.
bool add_claims(Names& names, const Results& results) {
  const auto claim = [&names](std::string name, bool holds) {
    names[std::move(name)] = [=](Words&) { return holds; };
    return holds;
  };
  bool met = true;
  for (const char* aid : {"ssbl", "gps"}) {
    const auto rms = [&](const char* variant) { return heading(results.of(aid), variant).rms; };
    claim(fmt::format("{}_equal", aid), std::abs(rms("ekf_n30") / rms("ukf_n30") - 1) < 0.1);
    claim(fmt::format("{}_ukf_better", aid), rms("ukf_n45") < rms("ekf_n45"));
    const auto median = [&](const char* variant) { return heading(results.of(aid), variant).median; };
    met = claim(fmt::format("{}_order", aid), median("ukf_90") < median("ekf_90")) && met;
    const auto from = [&](int start_deg) {
      return heading(results.of("starts"), fmt::format("{}_sincos_{}", aid, start_deg)).rms;
    };
    met = claim(fmt::format("{}_from_anywhere", aid),
                std::abs(from(180) - from(30)) <= 0.2 * std::min(from(30), from(180))) &&
          met;
  }
  return met;
}

}  // namespace

Result<PageContent> page_content(const Results& results, const FlyOptions& options,
                                 const std::filesystem::path& /*exact*/) {
  PageContent content;
  auto curves = first_runs(results, options);
  if (!curves) return tl::unexpected(curves.error());
  content.curves = std::move(*curves);
  add_headings(content.names, results);
  add_paths(content.names, results);
  content.bars_met = add_claims(content.names, results) && std::ranges::all_of(judged, [&](const char* name) {
                       return passed(results.of(name), "bar B");
                     });
  content.names["drawn_runs"] = [drawn = std::min(drawn_runs, results.of("ssbl").campaign.runs)](Words&) {
    return fmt::to_string(drawn);
  };
  return content;
}

}  // namespace canhil::papers::inflight_alignment
