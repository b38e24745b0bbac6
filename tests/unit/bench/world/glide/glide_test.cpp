// The truth of the glider: the flight of the published study, and the laws of mechanics applied to the
// recorded states.
#include "bench/world/glide/glide.hpp"

#include <gtest/gtest.h>

#include "bench/world/units.hpp"
#include "target/estimators/wind/design.hpp"
#include "target/estimators/wind/model.hpp"

namespace canhil::world {
namespace {

using units::deg;

GlideRecord flown(const GlidePlan& plan, double seconds, std::uint64_t run = 0) {
  return GlideRecord(plan, static_cast<std::int64_t>(seconds * 1e6), Stream(3, run, "coefficients"),
                     Stream(3, run, "gusts"));
}

GlidePlan in_steady_wind(const Vector3& wind_n) {
  GlidePlan plan;
  plan.wind = glide::WindProfile(wind_n);
  return plan;
}

glide::Loads loads_at(const GlideTruth& now) {
  return glide::loads(now.v_a, now.omega_nb_b, now.fins, glide::standard_air(now.height));
}

TEST(Glide, FliesThePublishedPath) {
  const GlideRecord record = flown({}, 100);
  ASSERT_EQ(record.epochs().size(), 10'001U);
  const GlideTruth& start = record.epochs().front();
  EXPECT_LT((start.v_a - Vector3(250, 0, 0)).norm(), 1e-12);
  EXPECT_LT((start.v_eb_n - Vector3(256.06265, 57.68227, 0)).norm(), 1e-4);
  const GlideTruth& end = record.epochs().back();
  EXPECT_NEAR(end.v_a.norm(), 165, 2);
  EXPECT_NEAR(end.height, 8'600, 60);
  EXPECT_NEAR((start.height - end.height) / 100, 14, 1);
  const GlideTruth& late = record.at(90'000'000);
  EXPECT_NEAR((late.height - end.height) / 10, 16, 1);  // the mean sink rate of the last 10 s
  EXPECT_NEAR(std::abs(euler_from(end.C_bn).heading) / deg, 2, 0.7);
  EXPECT_LT(std::abs(euler_from(end.C_bn).roll) / deg, 0.2);
  EXPECT_LT(std::abs(euler_from(end.C_bn).pitch) / deg, 0.5);
}

// The fin deflections of the published run. They were recorded without noise, but with coefficient errors of
// 20 %, so the test allows 30 %. The glider is released with fins at zero, pitches up, and is then
// stabilised.
TEST(Glide, ReleaseIsThePublishedOne) {
  const GlideRecord record = flown({}, 20);
  const auto elevator_deg = [&](std::int64_t t_ms) { return record.at(1000 * t_ms).fins.x() / deg; };
  EXPECT_NEAR(elevator_deg(100), 0.87, 0.30 * 0.87);
  EXPECT_NEAR(elevator_deg(200), 1.64, 0.30 * 1.64);
  EXPECT_NEAR(elevator_deg(1'000), 0.87, 0.30 * 0.87);
  EXPECT_NEAR(elevator_deg(8'000), 0.01, 0.10);
  EXPECT_NEAR(elevator_deg(20'000), -0.56, 0.30 * 0.56);
  EXPECT_NEAR(record.at(20'000'000).height, 9812.9, 5);
}

TEST(Glide, EnergyGoesIntoDragAlone) {
  const Vector3 wind(10, -30, 0);
  const GlideRecord record = flown(in_steady_wind(wind), 20);
  const auto energy = [&](const GlideTruth& t) {  // of the centre of gravity, in axes that move with the air
    return glide::mass * (0.5 * t.v_a.squaredNorm() + units::standard_gravity * t.height);
  };
  const auto epochs = record.epochs();
  for (std::size_t k = 300; k + 1 < epochs.size(); k += 50) {
    const double power = (energy(epochs[k + 1]) - energy(epochs[k - 1])) / 0.02;
    EXPECT_NEAR(power, loads_at(epochs[k]).force.dot(epochs[k].v_a), 1e-3 * std::abs(power)) << k;
  }
}

TEST(Glide, MomentumFollowsForceAndMoment) {
  const GlideRecord record = flown(in_steady_wind({10, -30, 0}), 5);
  const auto epochs = record.epochs();
  const auto spin = [](const GlideTruth& t) { return Vector3(t.C_bn * glide::inertia() * t.omega_nb_b); };
  // Skips the motion after release, which is too fast for finite differences.
  for (std::size_t k = 40; k + 1 < epochs.size(); k += 20) {
    const glide::Loads loads = loads_at(epochs[k]);
    const Vector3 acceleration = (epochs[k + 1].v_eb_n - epochs[k - 1].v_eb_n) / 0.02;
    const Vector3 expected = epochs[k].C_bn * loads.force / glide::mass + Vector3(0, 0, 9.80665);
    EXPECT_LT((acceleration - expected).norm(), 2e-3) << k;  // second-order differences over 20 ms
    const Vector3 torque = (spin(epochs[k + 1]) - spin(epochs[k - 1])) / 0.02;
    EXPECT_LT((torque - epochs[k].C_bn * loads.moment).norm(), 0.02 * (1 + loads.moment.norm())) << k;
    const Vector3 v = (epochs[k + 1].position_n - epochs[k - 1].position_n) / 0.02;
    EXPECT_LT((v - epochs[k].v_eb_n).norm(), 1e-3);
  }
}

// The truth must satisfy the equations of the estimator. The estimator has the air velocity as a state, the
// truth does not.
TEST(Glide, ObeysTheTargetsEquations) {
  const GlideRecord record = flown(in_steady_wind({20, 40, 0}), 10);
  const wind::Design design = wind::make_design({});
  const auto epochs = record.epochs();
  // Skips the motion after release, which is too fast for finite differences.
  for (std::size_t k = 80; k + 1 < epochs.size(); k += 20) {
    const auto state = [](const GlideTruth& t) {
      const Euler angles = euler_from(t.C_bn);
      wind::StateVector x;
      x << t.v_a, t.omega_nb_b, angles.roll, angles.pitch, angles.heading, t.wind_n;
      return x;
    };
    const wind::Inputs inputs{{epochs[k].fins.x(), epochs[k].fins.y(), epochs[k].fins.z()},
                              wind::standard_atmosphere(epochs[k].height)};
    wind::RangeFlags outside;
    const wind::StateVector theirs = wind::derivative(state(epochs[k]), inputs, design, outside);
    const wind::StateVector ours = (state(epochs[k + 1]) - state(epochs[k - 1])) / 0.02;
    EXPECT_LT((ours - theirs).cwiseAbs().maxCoeff(), 3e-3) << k;
    EXPECT_FALSE(outside.any());
  }
}

TEST(Glide, WindActsThroughTheAirAlone) {
  const GlideRecord still = flown(in_steady_wind({0, 0, 0}), 30);
  const GlideRecord moved = flown(in_steady_wind({-20, 50, 0}), 30);
  const GlideTruth& a = still.epochs().back();
  const GlideTruth& b = moved.epochs().back();
  EXPECT_LT((a.v_a - b.v_a).norm(), 1e-8);
  EXPECT_LT((b.position_n - a.position_n - 30 * Vector3(-20, 50, 0)).norm(), 1e-6);
}

TEST(Glide, HeadingTurnsEverything) {
  GlidePlan east = in_steady_wind({0, 0, 0});
  east.heading = 90 * deg;
  const GlideTruth a = flown(in_steady_wind({0, 0, 0}), 20).epochs().back();
  const GlideTruth b = flown(east, 20).epochs().back();
  EXPECT_LT((Vector3(-b.v_eb_n.y(), b.v_eb_n.x(), -b.v_eb_n.z()) + a.v_eb_n).norm(), 1e-8);
}

TEST(Glide, DenserAirSlowsIt) {
  GlidePlan dense;
  dense.density_error = 0.03;
  EXPECT_LT(flown(dense, 10).epochs().back().v_a.norm(), flown({}, 10).epochs().back().v_a.norm());
}

TEST(Glide, SameStreamsSameBitsAndOthersOtherwise) {
  GlidePlan plan;
  plan.coefficients.level = 0.4;
  plan.gusts.sigma = 1;
  const GlideTruth a = flown(plan, 20).epochs().back();
  EXPECT_EQ(a.v_a, flown(plan, 20).epochs().back().v_a);
  EXPECT_NE(a.v_a, flown(plan, 20, 1).epochs().back().v_a);
  EXPECT_NEAR((a.v_a - a.C_bn.transpose() * (a.v_eb_n - a.wind_n)).norm(), 0, 1e-12);
  EXPECT_NE(a.wind_n, plan.wind.at(a.height));  // gusts are part of the wind
}

TEST(Glide, EndsOnTheGround) {
  GlidePlan low;
  low.height = 100;
  const GlideRecord record = flown(low, 100);
  EXPECT_LT(record.end_us(), 40'000'000);
  EXPECT_GT(record.epochs().back().height, 0);
}

}  // namespace
}  // namespace canhil::world
