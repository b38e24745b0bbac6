#include "bench/papers/los_rate/results.hpp"

#include <fmt/format.h>

#include <cmath>

#include "bench/papers/los_rate/embedded.hpp"

namespace canhil::papers::los_rate {

double Results::figure(std::string_view campaign, std::string_view metric, std::string_view variant,
                       std::string_view name, std::string_view point) const {
  return papers::figure(of(campaign).answer(metric, variant, point), name);
}

double Results::rms(std::string_view campaign, std::string_view variant, const Window& window) const {
  return figure(campaign, fmt::format("RMS {:g}-{:g}", window.most, window.least), variant, "rms_mradps");
}

Miss Results::miss(std::string_view campaign, std::string_view variant, std::string_view point) const {
  const auto both = [&](std::string_view name) {
    return std::pair{figure(campaign, "miss_pitch", variant, name, point),
                     figure(campaign, "miss_yaw", variant, name, point)};
  };
  const auto [pitch_rms, yaw_rms] = both("rms_m");
  const auto [pitch_median, yaw_median] = both("median_m");
  return {.median = (pitch_median + yaw_median) / 2,
          .rms = std::sqrt((pitch_rms * pitch_rms + yaw_rms * yaw_rms) / 2),
          .of_both = figure(campaign, "miss", variant, "rms_m", point)};
}

Result<std::optional<Results>> fly(const FlyOptions& options, const std::atomic<bool>& stop) {
  auto flown = papers::fly(embedded, options, stop);
  if (!flown) return tl::unexpected(flown.error());
  if (!*flown) return std::nullopt;
  Results results;
  results.campaigns = std::move(**flown);
  results.flights = flights(results.campaigns);
  results.runs = results.of("open_loop").campaign.runs;
  return results;
}

}  // namespace canhil::papers::los_rate
