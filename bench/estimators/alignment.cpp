#include "bench/estimators/alignment.hpp"

#include <fmt/format.h>

namespace canhil::estimators {

std::vector<ResultLine> alignment_results(const Spool<NavigationError>& errors, std::span<const double> bands,
                                          const quantities::Unit& angle) {
  ResultLine convergence{.name = "heading_convergence", .what = "heading error for good within"};
  for (const double band : bands) {
    const std::string name = fmt::format("{:g} {}", band, angle.name);
    const auto t_us = quantities::entered_for_good_us(
        errors, band * angle.factor, [](const NavigationError& error) { return error.angles.heading; });
    const std::optional<double> t_s = t_us ? std::optional(static_cast<double>(*t_us) * 1e-6) : std::nullopt;
    convergence.add(name, t_s, t_s ? fmt::format("{} from {:.2f} s", name, *t_s) : name + " never");
  }
  ResultLine end{.name = "final_error", .what = "error at the end"};
  const auto add = [&](const char* name, double value) {
    end.add(name, value, fmt::format("{} {:+.3f} {}", name, value / angle.factor, angle.name));
  };
  if (!errors.empty()) {
    const NavigationError& last = errors.back();
    add("roll", last.angles.roll);
    add("pitch", last.angles.pitch);
    add("heading", last.angles.heading);
    const double velocity = last.v_eb_n.norm();
    end.add("velocity", velocity, fmt::format("velocity {:.4f} m/s", velocity));
  } else {
    end.add("heading", std::nullopt, "the target gave no navigation answers");
  }
  return {std::move(convergence), std::move(end)};
}

}  // namespace canhil::estimators
