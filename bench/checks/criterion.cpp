#include "bench/checks/criterion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "bench/checks/finding.hpp"

namespace canhil::checks {
namespace {

// The distance to a limit, positive on the permitted side.
struct Distance {
  double distance = 0;
  Limit limit;
  [[nodiscard]] bool beyond() const { return distance < 0 || (distance == 0 && !limit.inclusive); }
};

std::vector<Distance> distances(const Judgement& judgement) {
  std::vector<Distance> all;
  const auto& [criterion, measurement] = judgement;
  if (!measurement.value) return all;
  if (criterion.lower) all.push_back({*measurement.value - criterion.lower->value, *criterion.lower});
  if (criterion.upper) all.push_back({criterion.upper->value - *measurement.value, *criterion.upper});
  return all;
}

// The margin, if there is one; without a margin, the largest or the smallest number.
double rank_of(const Judgement& judgement) {
  constexpr double largest = std::numeric_limits<double>::infinity();
  if (const auto share = margin(judgement)) return *share;
  return std::ranges::any_of(distances(judgement), &Distance::beyond) ? -largest : largest;
}

}  // namespace

std::string to_text(const Criterion& criterion) {
  std::string text;
  if (const auto& lower = criterion.lower)
    text = fmt::format("{} {:.4g}", lower->inclusive ? ">=" : ">", lower->value);
  if (const auto& upper = criterion.upper)
    text +=
        fmt::format("{}{} {:.4g}", text.empty() ? "" : " and ", upper->inclusive ? "<=" : "<", upper->value);
  return text.empty() || criterion.unit.empty() ? text : text + " " + criterion.unit;
}

std::optional<double> margin(const Judgement& judgement) {
  std::optional<double> least;
  for (const Distance& one : distances(judgement)) {
    if (one.limit.value == 0) {  // no share of 0 says how far the value is beyond it
      if (one.beyond()) return std::nullopt;
      continue;
    }
    const double share = one.distance / std::abs(one.limit.value);
    if (!least || share < *least) least = share;
  }
  return least;
}

void take_nearest_to_limit(Finding& finding, std::vector<Judgement> judgements) {
  const auto nearest = std::ranges::min_element(judgements, {}, rank_of);
  if (nearest == judgements.end()) return;
  finding.expected.criterion = std::move(nearest->criterion);
  finding.measurement = nearest->measurement;
}

}  // namespace canhil::checks
