#include "bench/papers/wind/results.hpp"

#include <fmt/format.h>

#include "bench/papers/wind/embedded.hpp"

namespace canhil::papers::wind {

std::string words(const Score& score) {
  return fmt::format("{:.2f} ({:.2f})", score.mean, score.standard_deviation);
}

Score Results::score(std::string_view campaign, std::string_view variant, std::string_view metric) const {
  const campaign::Answer& answer = of(campaign).answer(metric, variant);
  return {.mean = figure(answer, "mean_mps"), .standard_deviation = figure(answer, "standard_deviation_mps")};
}

std::size_t Results::lost(std::string_view campaign, std::string_view variant) const {
  return static_cast<std::size_t>(figure(of(campaign).answer("wind error", variant), "missing"));
}

Result<std::optional<Results>> fly(const FlyOptions& options, const std::atomic<bool>& stop) {
  auto flown = papers::fly(embedded, options, stop);
  if (!flown) return tl::unexpected(flown.error());
  if (!*flown) return std::nullopt;
  Results results;
  results.campaigns = std::move(**flown);
  results.flights = flights(results.campaigns);
  results.runs = results.of("table1").campaign.runs;
  return results;
}

}  // namespace canhil::papers::wind
