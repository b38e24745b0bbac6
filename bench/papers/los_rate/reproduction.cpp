#include "bench/papers/los_rate/reproduction.hpp"

#include <fmt/format.h>

#include "bench/papers/los_rate/sections.hpp"

namespace canhil::papers::los_rate {
namespace {

Page page(const Results& results) {
  return {.title = "LOS rate with gains of range alone, against the Kalman filter and a fixed bandwidth",
          .subtitle = fmt::format(
              "Na and Lee, \"A Practical Real-Time LOS Rate Estimator with Time-Varying Measurement Noise "
              "Variance\", flown over the bus: {} runs a variant.",
              results.runs),
          .sections = {claims(results), open_loop(results), closing_speed(results), formulas(),
                       closed_loop(results), delays(results), glint(results), settings(results)}};
}

}  // namespace

Result<std::optional<Reproduction>> reproduce(const FlyOptions& options,
                                              const std::filesystem::path& /*exact*/,
                                              const std::atomic<bool>& stop) {
  const auto results = fly(options, stop);
  if (!results) return tl::unexpected(results.error());
  if (!*results) return std::nullopt;
  return Reproduction{
      .page = page(**results), .bars_met = bars_met(**results), .runs = (*results)->runs, .enough = 200};
}

}  // namespace canhil::papers::los_rate
