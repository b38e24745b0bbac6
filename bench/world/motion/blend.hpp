// The smooth change from one value to another: the polynomial of degree 7 whose first three derivatives
// vanish at both ends. A quantity that changes in this way is continuous to its third derivative. So a
// velocity is smooth enough that an attitude which follows the acceleration is continuous to its second
// derivative.
#pragma once

namespace canhil::world {

/// A quantity with its first two derivatives w.r.t. time.
struct Changing {
  double value = 0;
  double rate = 0;
  double rate_rate = 0;
};

/// The greatest rate of a change, as a multiple of its mean rate.
inline constexpr double blend_peak = 35.0 / 16.0;

/// The change from `from` to `to` within the time `length` [s], at the time tau [s] after it began. Constant
/// before and after.
constexpr Changing blend(double from, double to, double length, double tau) {
  if (tau >= length || from == to) return {.value = to};
  if (tau <= 0) return {.value = from};
  const double x = tau / length, change = to - from, rest = 1 - x;
  return {.value = from + change * x * x * x * x * (35 + x * (-84 + x * (70 - 20 * x))),
          .rate = change / length * 140 * x * x * x * rest * rest * rest,
          .rate_rate = change / (length * length) * 420 * x * x * rest * rest * (1 - 2 * x)};
}

/// The integral of a change from 0 to 1 within `length`, from its beginning to tau, 0 <= tau <= length [s].
constexpr double blend_integral(double length, double tau) {
  const double x = tau / length;
  return length * x * x * x * x * x * (7 + x * (-14 + x * (10 - 2.5 * x)));
}

}  // namespace canhil::world
