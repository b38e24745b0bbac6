#include "bench/campaign/export.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "dbc/text/escape.hpp"
namespace canhil::campaign {
Result<void> export_csv(const Campaign& campaign, const Store& store,
                        const std::function<Result<void>(std::string_view text)>& give) {
  if (auto given = give("variant,run,t_s,quantity,unit,value\n"); !given) return given;
  for (std::size_t variant = 0; variant < campaign.variants.size(); ++variant) {
    const auto runs = store.load(variant);
    if (!runs) return tl::unexpected(runs.error());
    const std::string name = for_csv(campaign.variants[variant].name);
    for (const RunSeries& run : *runs) {
      std::string lines;
      const auto& kept = run.samples.layout().kept;
      for (std::size_t i = 0; i < run.samples.size(); ++i) {
        const double t_s = static_cast<double>(run.samples.times()[i]) * 1e-6;
        const auto values = run.samples.values(i);
        for (std::size_t column = 0; column < kept.size(); ++column) {
          if (std::isnan(values[column])) continue;
          lines += fmt::format("{},{},{:.6f},{},{},{}\n", name, run.run, t_s, for_csv(kept[column]->name),
                               quantities::si_name(kept[column]->unit), values[column]);
        }
      }
      if (auto given = give(lines); !given) return given;
    }
  }
  return {};
}

}  // namespace canhil::campaign
