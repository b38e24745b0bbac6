#include "bench/papers/transfer_alignment/reproduction.hpp"

#include <fmt/format.h>

#include "bench/papers/transfer_alignment/sections.hpp"

namespace canhil::papers::transfer_alignment {
namespace {

Page page(const Results& results) {
  Page page{
      .title = "Velocity-matching transfer alignment: robust H2 filter against Kalman filter",
      .subtitle = fmt::format(
          "Yang, Shim, Park, \"Velocity Matching Algorithm Using Robust H2 Filter\", 2001, flown over the "
          "bus{}: {} runs a variant.",
          rounding_of(results.campaigns) == Rounding::none ? " without its rounding" : "", results.runs),
      .sections = {claims(results), table_2(results), cases(results), cruise(results), sizes(results),
                   axes(results), artefact(results), noise(results), rates(results), cost_of_the_bus(results),
                   settings(results)}};
  return page;
}

}  // namespace

Result<std::optional<Reproduction>> reproduce(const FlyOptions& options, const std::filesystem::path& exact,
                                              const std::atomic<bool>& stop) {
  const auto results = fly(options, exact, stop);
  if (!results) return tl::unexpected(results.error());
  if (!*results) return std::nullopt;
  return Reproduction{
      .page = page(**results), .bars_met = bars_met(**results), .runs = (*results)->runs, .enough = 300};
}

}  // namespace canhil::papers::transfer_alignment
