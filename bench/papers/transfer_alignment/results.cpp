#include "bench/papers/transfer_alignment/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/campaign/statistics.hpp"
#include "bench/campaign/store.hpp"
#include "bench/papers/transfer_alignment/embedded.hpp"

namespace canhil::papers::transfer_alignment {
namespace {

constexpr double mrad = 1e-3;
constexpr double diverged_mrad = 20;
constexpr std::string_view main_campaign = "table2";

std::string in_words(double t_s) { return std::isfinite(t_s) ? fmt::format("{:.1f}", t_s) : "never"; }

Times lowest(Times a, const Times& b) {
  a.within_3_mrad = std::min(a.within_3_mrad, b.within_3_mrad);
  a.within_2_mrad = std::min(a.within_2_mrad, b.within_2_mrad);
  a.within_1_mrad = std::min(a.within_1_mrad, b.within_1_mrad);
  return a;
}
Times highest(Times a, const Times& b) {
  a.within_3_mrad = std::max(a.within_3_mrad, b.within_3_mrad);
  a.within_2_mrad = std::max(a.within_2_mrad, b.within_2_mrad);
  a.within_1_mrad = std::max(a.within_1_mrad, b.within_1_mrad);
  return a;
}

// What the sampling of runs does to the times: ten batches of a tenth of the runs.
Result<std::vector<std::pair<std::string, Spread>>> spreads_of(const campaign::Campaign& campaign,
                                                               const campaign::Store& store) {
  constexpr std::size_t batches = 10;
  std::vector<std::pair<std::string, Spread>> all;
  for (std::size_t v = 0; v < campaign.variants.size(); ++v) {
    const auto runs = store.load(v);
    if (!runs) return tl::unexpected(runs.error());
    const std::size_t size = runs->size() / batches;
    if (size == 0) return all;
    std::optional<Spread> spread;
    for (std::size_t b = 0; b < batches; ++b) {
      const Times times = times_of(
          campaign::rms_curve(std::span(*runs).subspan(b * size, size), quantities::attitude_heading));
      if (!spread) spread = Spread{times, times};
      spread = Spread{lowest(spread->low, times), highest(spread->high, times)};
    }
    all.emplace_back(campaign.variants[v].name, *spread);
  }
  return all;
}

Result<Flown> read_exact(const std::filesystem::path& path, const campaign::Campaign& ours) {
  auto store = campaign::Store::open(path);
  if (!store) return tl::unexpected(store.error());
  const campaign::Identity& found = store->identity();
  const auto refused = [&](std::string_view what) {
    return failure(fmt::format("{}: {}, expected {} runs of {} with --unrounded", path.string(), what,
                               ours.runs, ours.sources.file));
  };
  if (found.campaign_hash != ours.hash) return refused("is of another campaign");
  if (found.runs != ours.runs) return refused(fmt::format("has {} runs", found.runs));
  if (found.rounding != Rounding::none) return refused("was flown with the bus's rounding");
  return evaluated("exact", ours, *store);
}

}  // namespace

std::string diverged_runs(const Flown& flown, std::string_view variant, std::string_view point) {
  return flown.answer_of_kind(campaign::Diverged::kind, variant, point).measured;
}

Times times_of(std::span<const CurvePoint> curve) {
  const auto at = [&](double within) { return campaign::time_within(curve, within).value_or(never); };
  return {.within_3_mrad = at(3 * mrad),
          .within_2_mrad = at(2 * mrad),
          .within_1_mrad = at(1 * mrad),
          .end_mrad = curve.empty() ? std::nan("") : curve.back().rms / mrad};
}

bool diverged(const Times& times) { return !(times.end_mrad < diverged_mrad); }

std::string words(const Times& times) {
  if (std::isnan(times.end_mrad)) return "diverges";
  if (diverged(times)) return fmt::format("diverges ({:.0f} mrad at the end)", times.end_mrad);
  return fmt::format("{} / {} / {}", in_words(times.within_3_mrad), in_words(times.within_2_mrad),
                     in_words(times.within_1_mrad));
}

Result<std::optional<Results>> fly(const FlyOptions& options, const std::filesystem::path& exact,
                                   const std::atomic<bool>& stop) {
  auto flown = papers::fly(embedded, options, stop);
  if (!flown) return tl::unexpected(flown.error());
  if (!*flown) return std::nullopt;
  Results results;
  results.campaigns = std::move(**flown);
  results.flights = flights(results.campaigns);
  const campaign::Campaign& table = results.of(main_campaign).campaign;
  results.runs = table.runs;
  const auto store = campaign::Store::open(results_file(options, main_campaign));
  if (!store) return tl::unexpected(store.error());
  auto spreads = spreads_of(table, *store);
  if (!spreads) return tl::unexpected(spreads.error());
  results.spreads = std::move(*spreads);
  if (!exact.empty()) {
    auto without_rounding = read_exact(exact, table);
    if (!without_rounding) return tl::unexpected(without_rounding.error());
    results.exact = std::move(*without_rounding);
  }
  return results;
}

}  // namespace canhil::papers::transfer_alignment
