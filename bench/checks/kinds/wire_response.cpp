#include "bench/checks/kinds/wire_response.hpp"

#include <fmt/format.h>

#include "bench/checks/evidence.hpp"
#include "bench/checks/wire_bounds.hpp"

namespace canhil::checks {
namespace {

Finding against_bounds(const Observations& seen) {
  Finding finding{.outcome = Outcome::not_measured,
                  .measured = no_bounds(seen),
                  .expected = {.text = "no frame takes longer over the bus than its bound"}};
  if (!finding.measured.empty()) return finding;
  const std::vector<WireBound> bounds = wire_bounds(seen);
  const auto share = [](const WireBound& bound) {
    return static_cast<double>(bound.longest_ns) / static_cast<double>(*bound.bound_ns);
  };
  const WireBound* worst = nullptr;
  for (const WireBound& bound : bounds) {
    if (!bound.bound_ns) {
      finding.measured = fmt::format("{} has no bound that the analysis finds", bound.message);
      return finding;
    }
    if (worst == nullptr || share(bound) > share(*worst)) worst = &bound;
  }
  if (worst == nullptr) {
    finding.measured = "no frame was seen";
    return finding;
  }
  const auto in_ms = [](std::int64_t t_ns) { return static_cast<double>(t_ns) * 1e-6; };
  finding.expected.criterion = {.quantity = std::string(worst->message),
                                .statistic = "longest response",
                                .upper = Limit{.value = in_ms(*worst->bound_ns)},
                                .unit = "ms"};
  finding.measurement = {.value = in_ms(worst->longest_ns), .count = worst->count};
  finding.outcome = pass_if(worst->longest_ns <= *worst->bound_ns);
  finding.measured = fmt::format("{}: {:.3f} of {:.3f} ms, the most of {} message{}", worst->message,
                                 in_ms(worst->longest_ns), in_ms(*worst->bound_ns), bounds.size(),
                                 bounds.size() == 1 ? "" : "s");
  return finding;
}

}  // namespace

Finding WireResponseRule::judge(const Evidence& evidence) const {
  constexpr double bar_s = 1e-3;
  Finding finding = against_bounds(evidence.seen);
  if (finding.outcome != Outcome::fail) return finding;
  // If the host stops a program between two frames, the frames are late although the bus has no fault.
  if (auto why = unfit(evidence, 1, bar_s); !why.empty())
    return {Outcome::not_measured, std::move(why), std::move(finding.expected)};
  return unless_target_delayed(evidence, 1, bar_s, std::move(finding));
}

}  // namespace canhil::checks
