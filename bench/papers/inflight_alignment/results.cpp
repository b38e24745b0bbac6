#include "bench/papers/inflight_alignment/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "bench/campaign/statistics.hpp"
#include "bench/campaign/store.hpp"
#include "bench/papers/inflight_alignment/embedded.hpp"

namespace canhil::papers::inflight_alignment {
namespace {

constexpr std::size_t drawn_runs = 100;  // as many as the paper flew
constexpr std::string_view heading_metric = "heading at 300 s";
constexpr std::string_view repairs_metric = "repairs";

// The curves of the first runs of every variant of a campaign.
Result<void> draw_first_runs(Results& results, const FlyOptions& options, std::string_view name) {
  const auto store = campaign::Store::open(results_file(options, name));
  if (!store) return tl::unexpected(store.error());
  const campaign::Campaign& campaign = results.of(name).campaign;
  for (std::size_t v = 0; v < campaign.variants.size(); ++v) {
    const auto runs = store->load(v);
    if (!runs) return tl::unexpected(runs.error());
    const auto first = std::span(*runs).first(std::min(drawn_runs, runs->size()));
    results.curves[fmt::format("{} {}", name, campaign.variants[v].name)] =
        campaign::rms_curve(first, quantities::attitude_heading);
  }
  return {};
}

}  // namespace

std::string words(const Heading& h) {
  return fmt::format("{:.3g} [{:.2g}-{:.2g}] ({:.2g})", h.rms, h.rms_low, h.rms_high, h.median);
}

Heading Results::heading(std::string_view campaign, std::string_view variant, std::string_view point) const {
  const campaign::Answer& answer = of(campaign).answer(heading_metric, variant, point);
  return {.rms = figure(answer, "rms_deg"),
          .rms_low = figure(answer, "rms_low_deg"),
          .rms_high = figure(answer, "rms_high_deg"),
          .median = figure(answer, "median_deg"),
          .p90 = figure(answer, "p90_deg"),
          .below_10_deg = figure(answer, "fraction_below")};
}

double Results::repairs(std::string_view campaign, std::string_view variant) const {
  return figure(of(campaign).answer(repairs_metric, variant), "mean");
}

Result<std::optional<Results>> fly(const FlyOptions& options, const std::atomic<bool>& stop) {
  auto flown = papers::fly(embedded, options, stop);
  if (!flown) return tl::unexpected(flown.error());
  if (!*flown) return std::nullopt;
  Results results;
  results.campaigns = std::move(**flown);
  results.flights = flights(results.campaigns);
  results.runs = results.of("ssbl").campaign.runs;
  for (const char* name : {"ssbl", "gps"}) {
    if (auto drawn = draw_first_runs(results, options, name); !drawn) return tl::unexpected(drawn.error());
  }
  return results;
}

}  // namespace canhil::papers::inflight_alignment
