#include "bench/papers/transfer_alignment/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/campaign/execute.hpp"
#include "bench/campaign/statistics.hpp"
#include "bench/campaign/store.hpp"
#include "bench/papers/transfer_alignment/campaign_texts.hpp"
#include "bench/run/contract.hpp"

namespace canhil::papers::transfer_alignment {
namespace {

constexpr double mrad = 1e-3;
constexpr double diverged_mrad = 20;
constexpr std::string_view main_campaign = "table2";

std::string in_words(double t_s) { return std::isfinite(t_s) ? fmt::format("{:.1f}", t_s) : "never"; }

Result<campaign::Campaign> read_embedded(const CampaignText& file) {
  return campaign::parse_campaign(
      file.text, fmt::format("{}.toml", file.name),
      [](const std::string& /*name*/) -> Result<std::string> { return std::string(flight_text); });
}

Result<Flown> evaluated(std::string name, campaign::Campaign campaign, const campaign::Store& store) {
  auto evaluation = campaign::evaluate(campaign, store);
  if (!evaluation) return tl::unexpected(evaluation.error());
  return Flown{
      .name = std::move(name), .campaign = std::move(campaign), .evaluation = std::move(*evaluation)};
}

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
      const Times times =
          times_of(campaign::rms_curve(std::span(*runs).subspan(b * size, size), Quantity::heading));
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
    return failure(fmt::format("{}: {}, expected {} runs of {} by hil-bench-exact", path.string(), what,
                               ours.runs, ours.sources.file));
  };
  if (found.campaign_hash != ours.hash) return refused("is of another campaign");
  if (found.runs != ours.runs) return refused(fmt::format("has {} runs", found.runs));
  if (found.dbc_hash == campaign::identity_of(ours).dbc_hash)
    return refused("was flown with the bus's rounding");
  return evaluated("exact", ours, *store);
}

template <class Wanted>
const campaign::Answer& answer_of(const Flown& flown, std::string_view variant, std::string_view point,
                                  Wanted&& wanted) {
  const std::string name = point.empty() ? std::string(variant) : fmt::format("{} {}", variant, point);
  for (const campaign::Answer& answer : flown.evaluation.answers) {
    if (answer.variant == name && wanted(answer)) return answer;
  }
  // The campaigns are built into the program, and their names with them: a test asks for every one.
  throw std::logic_error(fmt::format("campaign '{}': no such answer for '{}'", flown.name, name));
}

}  // namespace

std::span<const CurvePoint> Flown::curve(std::string_view variant, std::string_view point,
                                         Quantity quantity) const {
  return answer_of(*this, variant, point,
                   [&](const campaign::Answer& answer) {
                     return answer.kind == campaign::RmsCurve::kind && answer.quantity == quantity;
                   })
      .curve;
}

std::string Flown::diverged_runs(std::string_view variant, std::string_view point) const {
  return answer_of(*this, variant, point,
                   [](const campaign::Answer& answer) { return answer.kind == campaign::Diverged::kind; })
      .measured;
}

std::vector<const campaign::Answer*> Flown::answers(std::string_view requirement) const {
  std::vector<const campaign::Answer*> found;
  for (const campaign::Answer& answer : evaluation.answers) {
    if (answer.requirement == requirement) found.push_back(&answer);
  }
  return found;
}

const Flown& Results::of(std::string_view name) const {
  const auto found = std::ranges::find(campaigns, name, &Flown::name);
  if (found == campaigns.end()) throw std::logic_error(fmt::format("no campaign '{}'", name));
  return *found;
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

std::string frames_of(const Results& results) {
  return results.rounded ? "frames quantised as on the bus"
                         : "frames without the bus's rounding (hil-bench-exact)";
}

Result<std::optional<Results>> fly(const Options& options, const std::atomic<bool>& stop) {
  Results results;
  results.rounded = run::frames_round();
  for (const CampaignText& file : campaign_texts) {
    auto campaign = read_embedded(file);
    if (!campaign) return tl::unexpected(campaign.error());
    if (options.runs) campaign->runs = *options.runs;
    const campaign::Options flying{.file = options.folder / fmt::format("{}.sqlite", file.name),
                                   .shard = {},
                                   .threads = 0,
                                   .resume = true,
                                   .progress = [&](const campaign::Progress& p) {
                                     options.progress(file.name, p.stored + p.done, p.total);
                                   }};
    const auto ended = campaign::execute(*campaign, flying, stop);
    if (!ended) return tl::unexpected(ended.error());
    if (*ended == campaign::Execution::interrupted) return std::nullopt;
    const auto store = campaign::Store::open(flying.file);
    if (!store) return tl::unexpected(store.error());
    if (file.name == main_campaign) {
      auto spreads = spreads_of(*campaign, *store);
      if (!spreads) return tl::unexpected(spreads.error());
      results.spreads = std::move(*spreads);
      results.runs = campaign->runs;
      if (!options.exact.empty()) {
        auto exact = read_exact(options.exact, *campaign);
        if (!exact) return tl::unexpected(exact.error());
        results.exact = std::move(*exact);
      }
    }
    results.flights += campaign->variants.size() * campaign->runs;
    auto flown = evaluated(std::string(file.name), std::move(*campaign), *store);
    if (!flown) return tl::unexpected(flown.error());
    results.campaigns.push_back(std::move(*flown));
  }
  return results;
}

}  // namespace canhil::papers::transfer_alignment
