// Content of the page on transfer alignment: the times from which the RMS of the heading stays within 3, 2
// and 1 mrad, beside the times of the reference simulation.
#include "bench/papers/page_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/papers/transfer_alignment/claims.hpp"
#include "bench/papers/transfer_alignment/times.hpp"
#include "bench/world/units.hpp"

namespace canhil::papers::transfer_alignment {
namespace {

using world::units::mrad;

constexpr const char* main_campaign = "table2";

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

// One row for each variant, with its results with rounding on the bus and without it.
std::string exact_rows(const Flown& bus, const Flown& exact) {
  std::string rows;
  for (const campaign::Variant& variant : bus.campaign.variants) {
    const Times quantised = times_of(bus.curve(variant.name)),
                unrounded = times_of(exact.curve(variant.name));
    rows += fmt::format("| {} | {} | {} | {:.3f}, {:.3f} | {:+.3f} mrad |\n", variant.name,
                        words_of(quantised), words_of(unrounded), quantised.end_mrad, unrounded.end_mrad,
                        quantised.end_mrad - unrounded.end_mrad);
  }
  rows.pop_back();
  return rows;
}

void add_times(Names& names, const Results& results) {
  names["times"] = [&results](Words& words) { return words_of(times_of(results.curve(words))); };
  names["into_3_mrad"] = [&results](Words& words) {
    const double t_s = times_of(results.curve(words)).within_3_mrad;
    return time_words(t_s) + (std::isfinite(t_s) ? " s" : "");
  };
  names["end_mrad"] = [&results](Words& words) {
    return fmt::format("{:.1f}", times_of(results.curve(words)).end_mrad);
  };
  names["diverged"] = [&results](Words& words) { return diverged(times_of(results.curve(words))); };
  // Returns a text such as "27 of 300 runs (0 ended early)": the number of runs whose heading error at the
  // end is beyond 20 mrad, or whose covariance gives no finite NEES there. The campaign must have a metric
  // that counts these runs.
  const auto diverged_runs = [](const Flown& flown, std::string_view variant) {
    return flown.answer_of_kind(campaign::Diverged::kind, variant).measured;
  };
  names["diverged_runs"] = [&results, diverged_runs](Words& words) {
    const Flown& flown = results.of(words.next());
    return diverged_runs(flown, words.rest());
  };
  // Three cells: the reference, our result, and whether they agree. `counted`: also the
  // number of diverged runs, because a few of them may not show in the RMS, or may have a right heading.
  const auto compared = [&results, diverged_runs](bool counted) {
    return [&results, diverged_runs, counted](Words& words) {
      const Times reference = times_in(std::string(words.next()));
      const Flown& flown = results.of(words.next());
      const std::string_view variant = words.rest();
      const auto curve = flown.curve(variant);
      std::string ours = words_of(times_of(curve));
      if (counted) ours += ": " + diverged_runs(flown, variant);
      return fmt::format("{} | {} | {}", words_of(reference), ours,
                         agrees(curve, reference, results.of(main_campaign).campaign.runs) ? "[yes] agrees"
                                                                                           : "[no] differs");
    };
  };
  names["compared"] = compared(false);
  names["compared_counted"] = compared(true);
}

// A curve through the times at which 3, 2 and 1 mrad are reached. A level that is never reached has no point.
Curve through(const Times& times) {
  Curve curve;
  for (const auto& [t_s, level_mrad] :
       {std::pair(times.within_3_mrad, 3.0), std::pair(times.within_2_mrad, 2.0),
        std::pair(times.within_1_mrad, 1.0)}) {
    if (std::isfinite(t_s)) curve.points.emplace_back(t_s, level_mrad);
  }
  return curve;
}

void add_curves(Curves& curves, const Results& results) {
  for (const Axis& axis : axes)
    curves[std::string(axis.name)] = [&results, &axis](Words& words) {
      return over_time(results.curve(words, *axis.quantity), axis.unit);
    };
  curves["all_signs"] = [&results](Words&) { return over_time(all_signs(results), mrad); };
  curves["through"] = [](Words& words) { return through(times_in(std::string(words.rest()))); };
}

}  // namespace

Result<PageContent> page_content(const Results& results, const FlyOptions& options,
                                 const std::filesystem::path& exact) {
  PageContent content;
  add_times(content.names, results);
  add_curves(content.curves, results);
  content.bars_met = add_claims(content.names, results);

  const Flown& table = results.of(main_campaign);
  const auto store = campaign::Store::open(results_file(options, main_campaign));
  if (!store) return tl::unexpected(store.error());
  auto spreads = spreads_of(table.campaign, *store);
  if (!spreads) return tl::unexpected(spreads.error());
  // The cells that `compared` gives for the main campaign. The spread over batches is inserted before the
  // cell with the verdict.
  content.names["batched"] = [compared = content.names["compared"],
                              spreads = std::move(*spreads)](Words& words) {
    const std::string_view reference = words.next(), variant = words.rest();
    const std::string three = fmt::format("{} {} {}", reference, main_campaign, variant);
    Words of_table(three);
    std::string cells = std::get<std::string>(compared(of_table));
    const auto spread = spreads.find(variant);
    return cells.insert(cells.rfind('|') + 1,
                        fmt::format(" {} |", spread == spreads.end() ? "-" : spread->second));
  };
  content.names["exact_given"] = [given = !exact.empty()](Words&) { return given; };
  if (!exact.empty()) {
    auto unrounded = read_exact(exact, table.campaign);
    if (!unrounded) return tl::unexpected(unrounded.error());
    content.names["exact_rows"] = [rows = exact_rows(table, *unrounded)](Words&) { return rows; };
  }
  return content;
}

}  // namespace canhil::papers::transfer_alignment
