#include "bench/campaign/export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "bench/estimators/registry.hpp"
#include "bench/scenario/nearest.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::campaign {
namespace {

bool wants(const std::vector<std::string>& names, std::string_view name) {
  return names.empty() || std::ranges::find(names, name) != names.end();
}

// Refuses a chosen name that is not one of `known`.
Result<void> check_known(std::string_view option, const std::vector<std::string>& chosen,
                         const std::vector<std::string>& known) {
  for (const std::string& name : chosen) {
    if (std::ranges::find(known, name) == known.end())
      return failure(fmt::format("{} '{}': is not in the results, expected {}", option, name,
                                 scenario::expected_instead(name, known)));
  }
  return {};
}

// The lines of a run; the quantities that are kept, in columns.
std::string lines_of(const std::string& variant, const RunSeries& run, const Chosen& chosen) {
  std::string lines;
  const auto& kept = run.samples.layout().kept;
  for (std::size_t i = 0; i < run.samples.size(); ++i) {
    const double t_s = static_cast<double>(run.samples.times()[i]) * 1e-6;
    if (t_s < chosen.from_s || t_s > chosen.to_s) continue;
    const auto values = run.samples.values(i);
    for (std::size_t column = 0; column < kept.size(); ++column) {
      if (std::isnan(values[column]) || !wants(chosen.quantities, kept[column]->name)) continue;
      lines += fmt::format("{},{},{:.6f},{},{},{}\n", variant, run.run, t_s, for_csv(kept[column]->name),
                           quantities::si_name(kept[column]->unit), values[column]);
    }
  }
  return lines;
}

}  // namespace

Result<void> export_csv(const Campaign& campaign, const Store& store, const Chosen& chosen,
                        const std::function<Result<void>(std::string_view text)>& give) {
  std::vector<std::string> variants, quantities;
  for (const Variant& variant : campaign.variants) {
    variants.push_back(variant.name);
    for (const Quantity* quantity : estimators::of(variant.scenario).layout.kept)
      quantities.emplace_back(quantity->name);
  }
  if (auto known = check_known("--variant", chosen.variants, variants); !known) return known;
  if (auto known = check_known("--quantity", chosen.quantities, quantities); !known) return known;
  if (auto given = give("variant,run,t_s,quantity,unit,value\n"); !given) return given;
  for (std::size_t variant = 0; variant < campaign.variants.size(); ++variant) {
    if (!wants(chosen.variants, variants[variant])) continue;
    const auto runs = store.load(variant);
    if (!runs) return tl::unexpected(runs.error());
    for (const RunSeries& run : *runs) {
      if (auto given = give(lines_of(for_csv(variants[variant]), run, chosen)); !given) return given;
    }
  }
  return {};
}

}  // namespace canhil::campaign
