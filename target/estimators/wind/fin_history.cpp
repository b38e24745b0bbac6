#include "target/estimators/wind/fin_history.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace canhil::wind {
namespace {

Deflection weighted(const Deflection& a, double weight_a, const Deflection& b, double weight_b) {
  return {weight_a * a.elevator + weight_b * b.elevator, weight_a * a.aileron + weight_b * b.aileron,
          weight_a * a.rudder + weight_b * b.rudder};
}

}  // namespace

FinOutcome FinHistory::push(std::int64_t t_us, const Deflection& d, double limit) {
  const auto physical = [limit](double angle) { return std::abs(angle) <= limit; };  // false for NaN
  last_refused_ = !(physical(d.elevator) && physical(d.aileron) && physical(d.rudder));
  if (last_refused_) return FinOutcome::not_physical;
  const std::optional<Sample> before = std::exchange(out_of_order_, std::nullopt);
  if (count_ > 0 && t_us <= back(0).t_us) {
    constexpr std::int64_t overtaken_us = 100'000;  // the longest time by which a bus may reorder frames
    if (!before || t_us <= before->t_us || t_us >= back(0).t_us - overtaken_us) {
      out_of_order_ = {t_us, d};
      return FinOutcome::out_of_order;
    }
    samples_[0] = *before;
    count_ = 1;
  }
  samples_[count_ % samples_.size()] = {t_us, d};
  ++count_;
  return FinOutcome::kept;
}

ActingFins FinHistory::over(std::int64_t from_us, std::int64_t to_us) const {
  ActingFins acting;
  acting.not_physical = last_refused_;
  if (count_ == 0) return acting;
  acting.known = true;
  const std::size_t kept = std::min(count_, samples_.size());
  // Integrates backwards from the interval's end: `later` is the end of a piece, `at` is the deflection at
  // this end.
  std::size_t age = 0;
  while (age + 1 < kept && back(age).t_us >= to_us && back(age + 1).t_us >= to_us) ++age;
  // Interpolates between sample `newer` and the sample before it.
  const auto between = [&](std::size_t newer, std::int64_t t) {
    const Sample& b = back(newer);
    if (newer + 1 >= kept) return b.deflection;
    const Sample& a = back(newer + 1);
    const double share = static_cast<double>(t - a.t_us) / static_cast<double>(b.t_us - a.t_us);
    return weighted(a.deflection, 1 - share, b.deflection, share);
  };
  const double length = static_cast<double>(to_us - from_us);
  std::int64_t later = to_us;
  Deflection at;
  if (back(age).t_us < to_us) {  // after the newest sample its deflection is held
    acting.gap_us = to_us - back(age).t_us;
    at = back(age).deflection;
    const std::int64_t held_from = std::max(from_us, back(age).t_us);
    acting.mean = weighted(at, static_cast<double>(to_us - held_from) / length, {}, 0);
    later = held_from;
  } else {
    at = between(age, to_us);
  }
  for (; later > from_us; ++age) {  // the piece that ends at `later`, at or before sample `age`
    const bool oldest = age + 1 >= kept;
    const std::int64_t earlier = oldest ? from_us : std::max(from_us, back(age + 1).t_us);
    const Deflection start = between(age, earlier);
    const double half = static_cast<double>(later - earlier) / (2 * length);
    acting.mean = weighted(acting.mean, 1, weighted(start, half, at, half), 1);
    acting.gap_us =
        std::max(acting.gap_us, oldest ? back(age).t_us - from_us : back(age).t_us - back(age + 1).t_us);
    later = earlier;
    at = start;
  }
  return acting;
}

}  // namespace canhil::wind
