// The bench's aerodynamics and atmosphere, compared with the published table and with the independently
// written models of the target.
#include "bench/plant/glide/aerodynamics.hpp"

#include <gtest/gtest.h>

#include "target/estimators/wind/aerodynamics.hpp"
#include "target/estimators/wind/airframe_table.hpp"

namespace canhil::plant::glide {
namespace {

struct Case {
  Vector3 v_a, omega;
  Fins fins;
  double height;
};
const std::array cases{
    Case{{250, 0, 0}, {0, 0, 0}, {0, 0, 0}, 10'000},
    Case{{200, 9, 14}, {0.2, -0.1, 0.15}, {0.05, -0.03, 0.08}, 8'600},
    Case{{165, -4, 20}, {-0.3, 0.2, -0.4}, {-0.2, 0.1, -0.05}, 500},
    Case{{290, 20, -15}, {0.1, 0.4, 0.1}, {0.1, 0.3, 0.2}, 12'500},  // near Mach 1: wave drag
};

TEST(GlideAtmosphere, IsTheStandardOne) {
  EXPECT_NEAR(standard_air(0).density, 1.2250, 1e-4);
  EXPECT_NEAR(standard_air(0).speed_of_sound, 340.294, 1e-3);
  EXPECT_NEAR(standard_air(10'000).density, 0.4127, 1e-4);  // ISO 2533 at a geopotential height of 10 km
  EXPECT_NEAR(standard_air(15'000).density, 0.1937, 1e-4);
}

TEST(GlideAerodynamics, CoefficientsOfTheTable) {
  const Flow now{.speed = 200, .alpha = 0.05, .beta = -0.02, .mach = 0.5};
  const Vector3 omega(0.3, 0.2, -0.1);
  const Fins fins(0.10, -0.05, 0.02);
  const double k = 1 + 0.30 * 0.25;
  const double p = 0.3 * 2.6 / 400;
  const double q = 0.2 * 0.25 / 400;
  const double r = -0.1 * 2.6 / 400;
  const double lift = k * (0.10 + 5.5 * 0.05 + 0.40 * 0.10) + 6.0 * q;
  const double wave = 0.03 * (1 + std::tanh((0.5 - 0.92) / 0.04));
  const auto c = coefficients(now, omega, fins);
  EXPECT_NEAR(c[0], lift, 1e-15);
  EXPECT_NEAR(c[1], 0.070 + 0.050 * lift * lift + 0.50 * 0.0004 + wave + 0.30 * (0.01 + 0.0025 + 0.0004),
              1e-15);
  EXPECT_NEAR(c[2], k * (-0.90 * -0.02 + 0.25 * 0.02) + 0.35 * r, 1e-15);
  EXPECT_NEAR(c[3], k * (-0.05 * -0.02 + 0.08 * -0.05 + 0.01 * 0.02) - 0.50 * p + 0.10 * r, 1e-15);
  EXPECT_NEAR(c[4], k * (0.06 - 1.50 * 0.05 - 1.80 * 0.10) - 27 * q, 1e-15);
  EXPECT_NEAR(c[5], k * (0.080 * -0.02 - 0.005 * -0.05 - 0.10 * 0.02) - 0.03 * p - 0.25 * r, 1e-15);
}

TEST(GlideAerodynamics, AgreesWithTheTargetsModel) {
  for (const Case& each : cases) {
    const Air air = standard_air(each.height);
    const Loads ours = loads(each.v_a, each.omega, each.fins, air);
    const wind::Air their_air = wind::standard_atmosphere(each.height);
    EXPECT_NEAR(air.density, their_air.density, 2e-7);  // the target's exponent has eight digits
    EXPECT_NEAR(air.speed_of_sound, their_air.speed_of_sound, 1e-9);
    const wind::Air same{air.density, air.speed_of_sound};
    const wind::Flow flow = wind::flow(each.v_a, each.omega, same, wind::airframe_table);
    ASSERT_FALSE(flow.outside.any());
    const wind::Deflection fins{each.fins.x(), each.fins.y(), each.fins.z()};
    const wind::Loads theirs =
        wind::loads(flow, wind::coefficients(flow, fins, wind::airframe_table), same, wind::airframe_table);
    EXPECT_LT((ours.force / mass - theirs.specific_force).norm(), 1e-12 * (1 + theirs.specific_force.norm()));
    EXPECT_LT((ours.moment - theirs.moment).norm(), 1e-12 * (1 + theirs.moment.norm()));
  }
}

TEST(GlideAerodynamics, FactorsReachTheirPartAlone) {
  const Case& banked = cases[1];
  const Flow now = flow(banked.v_a, 300);
  const auto exact = coefficients(now, banked.omega, banked.fins);
  for (std::size_t c = 0; c < coefficient_count; ++c) {
    double all = 0;
    for (std::size_t p = 0; p < part_count; ++p) {
      Factors factors = nominal;
      factors[c][p] = 2;
      const auto doubled = coefficients(now, banked.omega, banked.fins, factors);
      for (std::size_t other = 0; other < coefficient_count; ++other) {
        if (other != c) {
          EXPECT_EQ(doubled[other], exact[other]);
        }
      }
      all += doubled[c] - exact[c];
    }
    EXPECT_NEAR(all, exact[c], 1e-15);  // the parts sum to the whole coefficient
  }
}

TEST(GlideAerodynamics, NoSpeedIsNoTrouble) {
  EXPECT_TRUE(loads(Vector3::Zero(), {1, 1, 1}, {0.1, 0.1, 0.1}, standard_air(0)).force.isZero());
}

}  // namespace
}  // namespace canhil::plant::glide
