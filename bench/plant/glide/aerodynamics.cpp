#include "bench/plant/glide/aerodynamics.hpp"

#include <algorithm>
#include <cmath>

namespace canhil::plant::glide {
namespace {

constexpr double area = 0.65;   // [m^2]
constexpr double span = 2.6;    // [m]
constexpr double chord = 0.25;  // [m]

// A coefficient at zero angles and rates (`zero`), and its derivatives [1/rad]. The derivatives p, q and r
// are those with respect to the dimensionless rates p b / (2 V), q c / (2 V) and r b / (2 V), where b is the
// span, c the chord and V the air speed.
struct Derivatives {
  double zero, alpha, beta;
  double p, q, r;
  double elevator, aileron, rudder;
};
// clang-format off
constexpr Derivatives lift_table {.zero = 0.10, .alpha =  5.50, .beta =  0.00, .p =  0.00, .q =   6.0, .r =  0.00,
                                  .elevator =  0.40, .aileron =  0.000, .rudder =  0.00};
constexpr Derivatives side_table {.zero = 0.00, .alpha =  0.00, .beta = -0.90, .p =  0.00, .q =   0.0, .r =  0.35,
                                  .elevator =  0.00, .aileron =  0.000, .rudder =  0.25};
constexpr Derivatives roll_table {.zero = 0.00, .alpha =  0.00, .beta = -0.05, .p = -0.50, .q =   0.0, .r =  0.10,
                                  .elevator =  0.00, .aileron =  0.080, .rudder =  0.01};
constexpr Derivatives pitch_table{.zero = 0.06, .alpha = -1.50, .beta =  0.00, .p =  0.00, .q = -27.0, .r =  0.00,
                                  .elevator = -1.80, .aileron =  0.000, .rudder =  0.00};
constexpr Derivatives yaw_table  {.zero = 0.00, .alpha =  0.00, .beta =  0.08, .p = -0.03, .q =   0.0, .r = -0.25,
                                  .elevator =  0.00, .aileron = -0.005, .rudder = -0.10};
// clang-format on

using Parts = std::array<double, part_count>;

double sum(const Parts& parts, const Parts& factors) {
  return parts[0] * factors[0] + parts[1] * factors[1] + parts[2] * factors[2];
}

}  // namespace

Matrix3 inertia() {
  constexpr double Ixx = 8;
  constexpr double Iyy = 120;
  constexpr double Izz = 125;
  constexpr double Ixz = 0.5;
  Matrix3 I;
  I << Ixx, 0, -Ixz, 0, Iyy, 0, -Ixz, 0, Izz;
  return I;
}

Flow flow(const Vector3& v_a, double speed_of_sound) {
  const double speed = v_a.norm();
  return {.speed = speed,
          .alpha = std::atan2(v_a.z(), v_a.x()),
          .beta = std::atan2(v_a.y(), std::hypot(v_a.x(), v_a.z())),  // asin(v / V), also valid at zero speed
          .mach = speed / speed_of_sound};
}

std::array<double, coefficient_count> coefficients(const Flow& flow, const Vector3& omega, const Fins& fins,
                                                   const Factors& factors) {
  const double compressibility =
      1 + 0.30 * flow.mach * flow.mach;  // applies to all parts except the rate derivatives
  const Vector3 reduced = omega.cwiseProduct(Vector3(span, chord, span)) / (2 * std::max(flow.speed, 1.0));
  const auto parts = [&](const Derivatives& d) {
    return Parts{compressibility * (d.zero + d.alpha * flow.alpha + d.beta * flow.beta),
                 Vector3(d.p, d.q, d.r).dot(reduced),
                 compressibility * Vector3(d.elevator, d.aileron, d.rudder).dot(fins)};
  };
  // The drag uses the nominal lift, not the true lift, so that only the factors of the drag change the drag.
  const Parts lift = parts(lift_table);
  const double nominal_lift = sum(lift, nominal[0]);
  const double wave = 0.03 * (1 + std::tanh((flow.mach - 0.92) / 0.04));
  const Parts drag{0.070 + 0.050 * nominal_lift * nominal_lift + 0.50 * flow.beta * flow.beta + wave, 0,
                   0.30 * fins.squaredNorm()};
  return {sum(lift, factors[0]),
          sum(drag, factors[1]),
          sum(parts(side_table), factors[2]),
          sum(parts(roll_table), factors[3]),
          sum(parts(pitch_table), factors[4]),
          sum(parts(yaw_table), factors[5])};
}

Loads loads(const Vector3& v_a, const Vector3& omega, const Fins& fins, const Air& air,
            const Factors& factors) {
  const Flow now = flow(v_a, air.speed_of_sound);
  const auto [lift, drag, side, roll, pitch, yaw] = coefficients(now, omega, fins, factors);
  const double sa = std::sin(now.alpha);
  const double ca = std::cos(now.alpha);
  const double pressure_area =
      air.density * now.speed * now.speed * area / 2;  // dynamic pressure times area [N]
  return {.force = pressure_area * Vector3(lift * sa - drag * ca, side, -lift * ca - drag * sa),
          .moment = pressure_area * Vector3(span * roll, chord * pitch, span * yaw)};
}

}  // namespace canhil::plant::glide
