// A gust that rises and falls once: the discrete "1 - cosine" gust of the airworthiness rules (CS-25.341).
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>

namespace canhil::plant {

struct Gust {
  std::optional<std::pair<std::int64_t, std::int64_t>> us{};  ///< begin and end; none: no gust

  /// The part of its largest value, from 0 to 1, at a time [s] of the run.
  [[nodiscard]] double at(double t) const {
    if (!us) return 0;
    const double from = 1e-6 * static_cast<double>(us->first);
    const double to = 1e-6 * static_cast<double>(us->second);
    if (t <= from || t >= to) return 0;
    return (1 - std::cos(2 * std::numbers::pi * (t - from) / (to - from))) / 2;
  }
};

}  // namespace canhil::plant
