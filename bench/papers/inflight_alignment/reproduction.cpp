#include "bench/papers/inflight_alignment/reproduction.hpp"

#include <fmt/format.h>

#include "bench/papers/inflight_alignment/sections.hpp"

namespace canhil::papers::inflight_alignment {
namespace {

Page page(const Results& results) {
  return {
      .title =
          "In-flight alignment under large heading error: EKF, UKF, and a filter that starts from anywhere",
      .subtitle = fmt::format(
          "Kang, Kim, Park, \"Performance Analysis of In-Flight Alignment Using UKF\", 2006, flown over the "
          "bus: {} runs a "
          "variant.",
          results.runs),
      .sections = {claims(results), figures(results), starts(results), paths(results), forms(results),
                   late_fixes(results), losses(results), settings(results)}};
}

}  // namespace

Result<std::optional<Reproduction>> reproduce(const FlyOptions& options,
                                              const std::filesystem::path& /*exact*/,
                                              const std::atomic<bool>& stop) {
  const auto results = fly(options, stop);
  if (!results) return tl::unexpected(results.error());
  if (!*results) return std::nullopt;
  return Reproduction{
      .page = page(**results), .bars_met = bars_met(**results), .runs = (*results)->runs, .enough = 400};
}

}  // namespace canhil::papers::inflight_alignment
