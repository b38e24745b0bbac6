#include "target/estimators/los_rate/closed_form.hpp"

#include <cmath>

namespace canhil::los_rate {
namespace {

// The coefficient c1: the largest root c of (c^2 - 35v^2/4)^2/4 = 2 c c3 + 259v^4/16. Newton's method starts
// above the root, where the function is convex.
double first_coefficient(double W, double v, double c3) {
  const double v2 = v * v;
  double c = 2 * W + 4.5 * v;
  for (int i = 0; i < 50; ++i) {
    const double b = c * c - 8.75 * v2;
    const double change = (b * b / 4 - 2 * c * c3 - 16.1875 * v2 * v2) / (c * b - 2 * c3);
    c -= change;
    if (!(std::abs(change) > 1e-15 * c)) break;
  }
  return c;
}

// A real root of the polynomial s^3 + d1 s^2 + d2 s + d3. The polynomial is Hurwitz, so the root is between
// -d1 and 0; Newton's method is restricted to this bracket. For glint, the roots are the poles of a
// Butterworth filter, and the start value is already the real root.
double real_pole(const Gain& d) {
  double low = -d.e, high = 0, s = -d.w / d.e;
  for (int i = 0; i < 100; ++i) {
    const double f = ((s + d.e) * s + d.w) * s + d.a;
    (f < 0 ? low : high) = s;
    const double next = s - f / ((3 * s + 2 * d.e) * s + d.w);
    const double previous = s;
    s = next > low && next < high ? next : (low + high) / 2;
    if (std::abs(s - previous) <= 4e-16 * std::abs(s)) break;
  }
  return s;
}

}  // namespace

double sample_variance(const Noise& noise, double range) {
  const double r2 = range * range;
  return noise.thermal * noise.thermal * r2 * r2 + noise.glint * noise.glint / r2 +
         noise.constant * noise.constant;
}

Covariance riccati(double q, double s2, double v) {
  // The closed-loop polynomial is s^3 + c1 s^2 + c2 s + c3. Its coefficients follow from the spectral
  // factorisation of (z - v^2/4)(z - 9v^2/4)(z - 25v^2/4) = q/s2, where z is the square of s. Comparing
  // coefficients then gives k = P(1,:)/s2.
  const double W6 = q / s2, W = std::cbrt(std::sqrt(W6)), v2 = v * v;
  const double c3 = std::sqrt(W6 + 3.515625 * v2 * v2 * v2);
  const double c1 = first_coefficient(W, v, c3);
  const double c2 = (c1 * c1 - 8.75 * v2) / 2;
  const double k1 = c1 + 4.5 * v;
  const double k2 = c2 - 1.25 * v2 + 3 * v * (k1 - 1.5 * v);
  const double k3 = c3 + v / 2 * k2 - 1.25 * v2 * (k1 - 1.5 * v);
  // The other three entries of P follow from the elements (1,2), (1,3), (2,3) of the Riccati equation.
  Covariance P{.ee = s2 * k1, .ew = s2 * k2, .ea = s2 * k3};
  P.ww = s2 * k1 * k2 - 4 * v * P.ew - P.ea;
  P.wa = s2 * k1 * k3 - 2 * v * P.ea;
  P.aa = s2 * k2 * k3 - 3 * v * P.wa;
  return P;
}

DisplacementNoise displacement_noise(const Noise& noise, Geometry at, double Ts) {
  const double r2 = at.range * at.range;
  const double thermal = noise.thermal * noise.thermal * Ts * r2 * r2 * r2;
  const double constant = noise.constant * noise.constant * Ts * r2;
  const double R_y = thermal + noise.glint * noise.glint * Ts + constant;
  return {R_y, at.closing_speed / at.range * (thermal + constant / 3) / R_y};
}

SteadyState steady_state(double q, DisplacementNoise noise) {
  // The thermal solution at r = 1, vc = nu, where y = [e, w - nu e, a].
  const double nu = noise.nu;
  const Covariance x = riccati(q, noise.R_y, nu);
  const Covariance P{.ee = x.ee,
                     .ew = x.ew - nu * x.ee,
                     .ea = x.ea,
                     .ww = x.ww - nu * (2 * x.ew - nu * x.ee),
                     .wa = x.wa - nu * x.ea,
                     .aa = x.aa};
  return {P, {P.ee / noise.R_y, P.ew / noise.R_y, P.ea / noise.R_y}};
}

Gain polar(const Gain& d, Geometry at) {
  return {d.e, d.w + at.closing_speed / at.range * d.e, at.range * d.a};
}

Gain displacement(const Gain& K, Geometry at) {
  return {K.e, K.w - at.closing_speed / at.range * K.e, K.a / at.range};
}

Gain pole_matched(const Gain& d, double Ts) {
  // There is one real pole, and there is a pair of poles, the roots of s^2 + b s + c. Each pole s becomes a
  // discrete pole z = exp(s Ts). The gains are alpha = 1 - z1 z2 z3, gamma = (1 - z1)(1 - z2)(1 - z3) and
  // beta = sum (1 - z) - alpha - gamma/2. To avoid cancellation they are computed from u = 1 - z of the real
  // pole, and from m = 1 - |z| and n = 2 (|z| - Re z) of the pair.
  const double s = real_pole(d), b = d.e + s, c = d.w + s * b;
  const double u = -std::expm1(s * Ts), m = -std::expm1(-b / 2 * Ts);
  const double square = c - b * b / 4, half = std::sqrt(std::abs(square)) * Ts / 2;
  const double wave = square > 0 ? std::sin(half) : std::sinh(half);
  const double n = (square > 0 ? 4 : -4) * (1 - m) * wave * wave;
  const double gamma = u * (m * m + n);
  const double alpha = u + (1 - u) * m * (2 - m);
  const double beta = n + m * m + u * m * (2 - m) - gamma / 2;
  return {alpha, beta / Ts, gamma / (Ts * Ts)};
}

double crossing_range(const Noise& noise) { return std::cbrt(noise.glint / noise.thermal); }

}  // namespace canhil::los_rate
