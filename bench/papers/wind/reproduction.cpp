#include "bench/papers/wind/reproduction.hpp"

#include <fmt/format.h>

#include "bench/papers/wind/sections.hpp"

namespace canhil::papers::wind {
namespace {

Page page(const Results& results) {
  return {.title = "Wind without an air-speed sensor: EKF, H-infinity, and what the noise of the rates does",
          .subtitle = fmt::format("Park and Park (2019), flown over the bus: {} runs a variant of Table 1.",
                                  results.runs),
          .sections = {claims(results), table_1(results), glide(results), models(results),
                       sensitivity(results), timing(results), settings(results)}};
}

}  // namespace

Result<std::optional<Reproduction>> reproduce(const FlyOptions& options,
                                              const std::filesystem::path& /*exact*/,
                                              const std::atomic<bool>& stop) {
  const auto results = fly(options, stop);
  if (!results) return tl::unexpected(results.error());
  if (!*results) return std::nullopt;
  return Reproduction{
      .page = page(**results), .bars_met = bars_met(**results), .runs = (*results)->runs, .enough = 50};
}

}  // namespace canhil::papers::wind
