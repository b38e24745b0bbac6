// The engagement compared with finite differences and with the equations of the filter, and the miss distance
// of proportional navigation.
#include "bench/plant/engagement/engagement.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace canhil::plant::engagement {
namespace {

constexpr std::int64_t ms_us = 1000;
constexpr std::int64_t longest_us = 10'000'000;

Settings rolling() {
  Settings plan;
  plan.roll_rate = 3;
  plan.manoeuvre = {.kind = Manoeuvre::Kind::weave, .at_time_to_go = {}};
  return plan;
}

/// Calls inspect(before, after, increment) at steps of 1 ms (0.9 m) until the range is 100 m.
template <class Inspect>
void fly(const Settings& plan, std::uint64_t run, Inspect inspect) {
  Engagement engagement(plan, Stream(1, run, "engagement"));
  for (std::int64_t t_us = ms_us; !engagement.over(); t_us += ms_us) {
    const Truth before = engagement.truth();
    if (before.range < 100) break;
    engagement.fly_to(t_us);
    const Increment increment = engagement.take_increment();
    if (!engagement.over()) inspect(before, engagement.truth(), increment);
  }
}

Vector3 mean_acceleration(const Increment& increment) {
  return increment.delta_v / (1e-6 * static_cast<double>(increment.interval_us));
}

Vector3 miss(const Settings& plan, std::uint64_t run) {
  Engagement engagement(plan, Stream(1, run, "engagement"));
  engagement.fly_to(longest_us);
  return engagement.miss_n().value();
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

TEST(Engagement, StartsAsPlanned) {
  Settings plan;
  plan.heading_error_sigma = 0;
  plan.pointing_error_sigma = 0;
  const Truth start = Engagement(plan, Stream(1, 0, "engagement")).truth();
  EXPECT_EQ(start.range, 5000);
  EXPECT_EQ(start.closing_speed, 900);
  EXPECT_EQ(start.los_rate, Planes<double>{});
  EXPECT_EQ(start.error, Planes<double>{});
}

TEST(Engagement, SignsOfErrorAndRate) {
  Settings plan;
  plan.pointing_error_sigma = 0.01;
  plan.heading_error_sigma = 0;
  plan.heading_error = 0.05;
  plan.planes = ActivePlanes::pitch;
  const Truth start = Engagement(plan, Stream(1, 0, "engagement")).truth();
  EXPECT_NEAR(std::abs(start.los_rate.pitch), 600 * std::sin(0.05) / 5000, 1e-6);
  EXPECT_LT(std::abs(start.los_rate.yaw), 1e-4) << "but for the antenna's pointing";
  // A target above the antenna's axis has a positive pitch error. A target to the right of this axis has a
  // positive yaw error.
  const Vector3 los_a = start.q_na.conjugate() * start.relative_n;
  EXPECT_NEAR(start.error.pitch, -los_a.z() / los_a.x(), 1e-5);
  EXPECT_NEAR(start.error.yaw, los_a.y() / los_a.x(), 1e-5);
}

TEST(Engagement, RatesAreTheDerivativesOfWhatTheyAreRatesOf) {
  fly(rolling(), 3, [](const Truth& before, const Truth& after, const Increment&) {
    const double dt = 1e-3;
    const Vector3 turned = before.relative_n.normalized().cross(after.relative_n.normalized()) / dt;
    const Vector3 omega = (before.omega_los_n + after.omega_los_n) / 2;
    ASSERT_LT((turned - omega).norm(), 1e-4 * omega.norm() + 1e-7) << "at range " << before.range;
    ASSERT_NEAR((before.range - after.range) / dt, (before.closing_speed + after.closing_speed) / 2, 1e-3);
    ASSERT_NEAR(after.los_rate.pitch, (after.q_na.conjugate() * after.omega_los_n).y(), 1e-12);
    ASSERT_NEAR(after.los_rate.yaw, (after.q_na.conjugate() * after.omega_los_n).z(), 1e-12);
  });
}

// For small angles, e_y' = w_y - q_n + p e_z and e_z' = w_z - r_n - p e_y. The error of these equations is of
// the order e^2 w.
TEST(Engagement, ErrorAnglesObeyTheFiltersEquations) {
  fly(rolling(), 3, [](const Truth& before, const Truth& after, const Increment& increment) {
    const double dt = 1e-3;
    const auto mean = [](double a, double b) { return (a + b) / 2; };
    const double roll = increment.delta_theta.x();
    const double pitch = mean(before.los_rate.pitch, after.los_rate.pitch) * dt - increment.delta_theta.y() +
                         roll * mean(before.error.yaw, after.error.yaw);
    const double yaw = mean(before.los_rate.yaw, after.los_rate.yaw) * dt - increment.delta_theta.z() -
                       roll * mean(before.error.pitch, after.error.pitch);
    ASSERT_NEAR(after.error.pitch - before.error.pitch, pitch, 3e-8);
    ASSERT_NEAR(after.error.yaw - before.error.yaw, yaw, 3e-8);
    ASSERT_NEAR(roll, 3 * dt, 1e-12);
  });
}

// w_y' = 2vc/r w_y - (a_tz - a_mz)/r + p w_z,  w_z' = 2vc/r w_z + (a_ty - a_my)/r - p w_y.
TEST(Engagement, LosRatesObeyTheFiltersEquations) {
  int compared = 0;
  fly(rolling(), 5, [&](const Truth& before, const Truth& after, const Increment& increment) {
    ++compared;
    const double dt = 1e-3;
    const auto mean = [](double a, double b) { return (a + b) / 2; };
    const double r = mean(before.range, after.range);
    const double growth = 2 * mean(before.closing_speed, after.closing_speed) / r;
    const Planes<double> w{.pitch = mean(before.los_rate.pitch, after.los_rate.pitch),
                           .yaw = mean(before.los_rate.yaw, after.los_rate.yaw)};
    const double a_z = mean(before.target.pitch, after.target.pitch) - mean_acceleration(increment).z();
    const double a_y = mean(before.target.yaw, after.target.yaw) - mean_acceleration(increment).y();
    // The tolerance allows for the error angle e times the terms along the LOS.
    const double tolerance = 2e-5 + 0.02 * std::abs(growth * w.pitch);
    ASSERT_NEAR((after.los_rate.pitch - before.los_rate.pitch) / dt, growth * w.pitch - a_z / r + 3 * w.yaw,
                tolerance)
        << r;
    ASSERT_NEAR((after.los_rate.yaw - before.los_rate.yaw) / dt, growth * w.yaw + a_y / r - 3 * w.pitch,
                2e-5 + 0.02 * std::abs(growth * w.yaw))
        << r;
  });
  EXPECT_GT(compared, 5000);
}

TEST(Engagement, TheAntennaFollowsWithItsServoGain) {
  Settings plan;
  plan.heading_error_sigma = 0;
  plan.manoeuvre.kind = Manoeuvre::Kind::none;
  Engagement engagement(plan, Stream(1, 2, "engagement"));
  const Planes<double> start = engagement.truth().error;
  ASSERT_GT(std::abs(start.pitch), 1e-4);
  engagement.fly_to(100'000);
  EXPECT_NEAR(engagement.truth().error.pitch / start.pitch, std::exp(-1.2), 1e-4);
  EXPECT_NEAR(engagement.truth().error.yaw / start.yaw, std::exp(-1.2), 1e-4);
}

TEST(Engagement, TheTargetManoeuvresWhenAndAsHardAsPlanned) {
  double largest_before = 0, smallest_after = 1e9, largest_after = 0;
  fly(Settings{}, 1, [&](const Truth&, const Truth& after, const Increment& increment) {
    EXPECT_LT(mean_acceleration(increment).norm(), 35 * units::standard_gravity);
    const double a = std::hypot(after.target.pitch, after.target.yaw);
    if (after.time_to_go() > 1.002) largest_before = std::max(largest_before, a);
    if (after.time_to_go() > 0.998 || after.time_to_go() < 0.1) return;
    smallest_after = std::min(smallest_after, a);
    largest_after = std::max(largest_after, a);
  });
  const double both = 4 * units::standard_gravity * std::sqrt(2.0);
  EXPECT_EQ(largest_before, 0);
  EXPECT_GT(smallest_after, 0.97 * both) << "across its velocity, which turns by 7.5 deg a plane";
  EXPECT_LE(largest_after, both);
}

// The reference simulation of Na and Lee's engagement has a miss distance of 0.05 m; here the miss distance
// is about 0.05 m in each plane.
TEST(Engagement, MissOfProportionalNavigationOnTheTruth) {
  std::vector<double> misses;
  for (std::uint64_t run = 0; run < 200; ++run) {
    Settings plan;
    plan.planes = run % 2 == 0 ? ActivePlanes::pitch : ActivePlanes::yaw;
    const Vector3 n = miss(plan, run);
    misses.push_back(n.norm());
    EXPECT_LT(std::abs(run % 2 == 0 ? n.y() : n.z()), 1e-9) << "planar";
  }
  EXPECT_GT(median(misses), 0.03);
  EXPECT_LT(median(misses), 0.08);
  Settings straight;
  straight.navigation_constant = 0;
  EXPECT_GT(miss(straight, 1).norm(), 20) << "what guidance is needed for";
}

TEST(Engagement, TheMissIsTheClosestApproach) {
  for (std::uint64_t run = 0; run < 20; ++run) {
    Engagement engagement(Settings{}, Stream(1, run, "engagement"));
    engagement.fly_to(longest_us);
    const Truth end = engagement.truth();
    EXPECT_LT(std::abs(engagement.miss_n()->dot(end.velocity_n)), 1e-6) << "across the relative velocity";
    const std::int64_t passage_us = engagement.t_us();
    engagement.fly_to(longest_us);
    EXPECT_EQ(engagement.t_us(), passage_us) << "over is over";
    EXPECT_GT(passage_us, 5'000'000);
    EXPECT_LT(passage_us, 6'000'000);
  }
}

/// The miss distance when the target's answers are the truth, each with a delay.
double miss_on_commands(std::uint64_t run, std::int64_t delay_us) {
  Settings plan;
  plan.guidance = Guidance::target;
  Engagement engagement(plan, Stream(1, run, "engagement"));
  for (std::int64_t t_us = 5000; !engagement.over(); t_us += 5000) {
    engagement.fly_to(t_us);
    const Truth now = engagement.truth();
    if (engagement.over()) break;
    EXPECT_TRUE(engagement.command(t_us + delay_us, now.omega_los_n, now.closing_speed));
  }
  return engagement.miss_n()->norm();
}

TEST(Engagement, CommandsTakeEffectWhenTheySay) {
  for (std::uint64_t run = 0; run < 10; ++run) {
    const double on_truth = miss(Settings{}, run).norm();
    EXPECT_NEAR(miss_on_commands(run, 0), on_truth, 0.1);
    EXPECT_GT(miss_on_commands(run, 300'000), 1) << "a delay of two lags";
  }
  Engagement engagement(Settings{}, Stream(1, 0, "engagement"));
  engagement.fly_to(10'000);
  EXPECT_FALSE(engagement.command(9'999, Vector3::Zero(), 900));
  EXPECT_TRUE(engagement.command(10'000, Vector3::Zero(), 900));
}

TEST(Engagement, TheNumbersOfARunAreItsOwn) {
  EXPECT_EQ(miss(Settings{}, 4), miss(Settings{}, 4));
  EXPECT_NE(miss(Settings{}, 4), miss(Settings{}, 5));
  // Steps of a different length must give the same flight.
  Engagement fine(Settings{}, Stream(1, 4, "engagement"));
  for (std::int64_t t_us = 2000; !fine.over(); t_us += 2000) fine.fly_to(t_us);
  EXPECT_EQ(*fine.miss_n(), miss(Settings{}, 4));
}

}  // namespace
}  // namespace canhil::plant::engagement
