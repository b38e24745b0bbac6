// The truth of the glider: the flight of the published study, and the laws of mechanics applied to the
// recorded states.
#include "bench/plant/glide/glide.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "bench/world/units.hpp"
#include "target/estimators/wind/design.hpp"
#include "target/estimators/wind/model.hpp"
#include "tests/unit/bench/plant/glide/flown.hpp"

namespace canhil::plant::glide {
namespace {

using world::Euler;
using world::euler_from;
namespace units = world::units;
using units::deg;

Flown flown(const Settings& settings, double seconds, std::uint64_t run = 0) {
  return Flown(settings, static_cast<std::int64_t>(seconds * 1e6), run);
}

Settings in_steady_wind(const Vector3& wind_n) {
  Settings plan;
  plan.wind = WindProfile(wind_n);
  return plan;
}

Loads loads_at(const Truth& now) {
  return loads(now.v_a, now.omega_nb_b, now.fins, standard_air(now.height));
}

TEST(Glide, FliesThePublishedPath) {
  const Flown record = flown({}, 100);
  ASSERT_EQ(record.epochs().size(), 10'001U);
  const Truth& start = record.epochs().front();
  EXPECT_LT((start.v_a - Vector3(250, 0, 0)).norm(), 1e-12);
  EXPECT_LT((start.v_eb_n - Vector3(256.06265, 57.68227, 0)).norm(), 1e-4);
  const Truth& end = record.epochs().back();
  EXPECT_NEAR(end.v_a.norm(), 165, 2);
  EXPECT_NEAR(end.height, 8'600, 60);
  EXPECT_NEAR((start.height - end.height) / 100, 14, 1);
  const Truth& late = record.at(90'000'000);
  EXPECT_NEAR((late.height - end.height) / 10, 16, 1);  // the mean sink rate of the last 10 s
  EXPECT_NEAR(std::abs(euler_from(end.C_bn).heading) / deg, 2, 0.7);
  EXPECT_LT(std::abs(euler_from(end.C_bn).roll) / deg, 0.2);
  EXPECT_LT(std::abs(euler_from(end.C_bn).pitch) / deg, 0.5);
}

// The fin deflections of the published run. They were recorded without noise, but with coefficient errors of
// 20 %, so the test allows 30 %. The glider is released with fins at zero, pitches up, and is then
// stabilised.
TEST(Glide, ReleaseIsThePublishedOne) {
  const Flown record = flown({}, 20);
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
  const Flown record = flown(in_steady_wind(wind), 20);
  const auto energy = [&](const Truth& t) {  // of the centre of gravity, in axes that move with the air
    return mass * (0.5 * t.v_a.squaredNorm() + units::standard_gravity * t.height);
  };
  const auto& epochs = record.epochs();
  for (std::size_t k = 300; k + 1 < epochs.size(); k += 50) {
    const double power = (energy(epochs[k + 1]) - energy(epochs[k - 1])) / 0.02;
    EXPECT_NEAR(power, loads_at(epochs[k]).force.dot(epochs[k].v_a), 1e-3 * std::abs(power)) << k;
  }
}

TEST(Glide, MomentumFollowsForceAndMoment) {
  const Flown record = flown(in_steady_wind({10, -30, 0}), 5);
  const auto& epochs = record.epochs();
  const auto spin = [](const Truth& t) { return Vector3(t.C_bn * inertia() * t.omega_nb_b); };
  // Skips the motion after release, which is too fast for finite differences.
  for (std::size_t k = 40; k + 1 < epochs.size(); k += 20) {
    const Loads acting = loads_at(epochs[k]);
    const Vector3 acceleration = (epochs[k + 1].v_eb_n - epochs[k - 1].v_eb_n) / 0.02;
    const Vector3 expected = epochs[k].C_bn * acting.force / mass + Vector3(0, 0, 9.80665);
    EXPECT_LT((acceleration - expected).norm(), 2e-3) << k;  // second-order differences over 20 ms
    const Vector3 torque = (spin(epochs[k + 1]) - spin(epochs[k - 1])) / 0.02;
    EXPECT_LT((torque - epochs[k].C_bn * acting.moment).norm(), 0.02 * (1 + acting.moment.norm())) << k;
    const Vector3 v = (epochs[k + 1].position_n - epochs[k - 1].position_n) / 0.02;
    EXPECT_LT((v - epochs[k].v_eb_n).norm(), 1e-3);
  }
}

// The truth must satisfy the equations of the estimator. The estimator has the air velocity as a state, the
// truth does not.
TEST(Glide, ObeysTheTargetsEquations) {
  const Flown record = flown(in_steady_wind({20, 40, 0}), 10);
  const wind::Design design = wind::make_design({});
  const auto& epochs = record.epochs();
  // Skips the motion after release, which is too fast for finite differences.
  for (std::size_t k = 80; k + 1 < epochs.size(); k += 20) {
    const auto state = [](const Truth& t) {
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
  const Flown still = flown(in_steady_wind({0, 0, 0}), 30);
  const Flown moved = flown(in_steady_wind({-20, 50, 0}), 30);
  const Truth& a = still.epochs().back();
  const Truth& b = moved.epochs().back();
  EXPECT_LT((a.v_a - b.v_a).norm(), 1e-8);
  EXPECT_LT((b.position_n - a.position_n - 30 * Vector3(-20, 50, 0)).norm(), 1e-6);
}

TEST(Glide, HeadingTurnsEverything) {
  Settings east = in_steady_wind({0, 0, 0});
  east.heading = 90 * deg;
  const Truth a = flown(in_steady_wind({0, 0, 0}), 20).epochs().back();
  const Truth b = flown(east, 20).epochs().back();
  EXPECT_LT((Vector3(-b.v_eb_n.y(), b.v_eb_n.x(), -b.v_eb_n.z()) + a.v_eb_n).norm(), 1e-8);
}

TEST(Glide, DenserAirSlowsIt) {
  Settings dense;
  dense.density_error = 0.03;
  EXPECT_LT(flown(dense, 10).epochs().back().v_a.norm(), flown({}, 10).epochs().back().v_a.norm());
}

TEST(Glide, SameStreamsSameBitsAndOthersOtherwise) {
  Settings plan;
  plan.coefficients.level = 0.4;
  plan.gusts.sigma = 1;
  const Truth a = flown(plan, 20).epochs().back();
  EXPECT_EQ(a.v_a, flown(plan, 20).epochs().back().v_a);
  EXPECT_NE(a.v_a, flown(plan, 20, 1).epochs().back().v_a);
  EXPECT_NEAR((a.v_a - a.C_bn.transpose() * (a.v_eb_n - a.wind_n)).norm(), 0, 1e-12);
  EXPECT_NE(a.wind_n, plan.wind.at(a.height));  // gusts are part of the wind
}

// The record has the truth under the names by which others find it.
TEST(Glide, IsRecordedByName) {
  Settings settings;
  settings.gusts.sigma = 1;
  const Flown record = flown(settings, 5);
  const Truth& now = record.at(3'000'000);
  const auto three = [&](const world::PlantColumns<3>::Names& names) {
    const auto columns = world::PlantColumns<3>::find({&record.record()}, names);
    const auto values = columns ? columns->at(now.t_us) : std::nullopt;
    return values ? Vector3(values->data()) : Vector3(Vector3::Constant(std::nan("")));
  };
  const Euler angles = euler_from(now.C_bn);
  EXPECT_EQ(three({"attitude.roll", "attitude.pitch", "attitude.heading"}),
            Vector3(angles.roll, angles.pitch, angles.heading));
  EXPECT_EQ(three({"velocity.north", "velocity.east", "velocity.down"}), now.v_eb_n);
  EXPECT_EQ(three({"wind.north", "wind.east", "wind.down"}), now.wind_n);
  EXPECT_EQ(three({"plant.body_rate.x", "plant.body_rate.y", "plant.body_rate.z"}), now.omega_nb_b);
  EXPECT_EQ(three({"plant.fins.elevator", "plant.fins.aileron", "plant.fins.rudder"}), now.fins);
  EXPECT_EQ(three({"plant.air_velocity.x", "plant.air_velocity.y", "plant.air_velocity.z"}), now.v_a);
  EXPECT_EQ(three({"plant.air_velocity.north", "plant.air_velocity.east", "plant.air_velocity.down"}),
            now.C_bn * now.v_a);
  const auto height = record.record().find("plant.height");
  ASSERT_TRUE(height);
  EXPECT_EQ(record.record().at(*height, now.t_us), now.height);
  EXPECT_EQ(record.record().at(*height, now.t_us + 9'999), now.height) << "it holds until the next step";
}

TEST(Glide, EndsOnTheGround) {
  Settings low;
  low.height = 100;
  const Flown record = flown(low, 100);
  EXPECT_LT(record.end_us(), 40'000'000);
  EXPECT_GT(record.epochs().back().height, 0);
  EXPECT_THAT(record.simulation().why_failed().value_or(""), testing::HasSubstr("the glide ends at t="));
  EXPECT_EQ(record.record().times_us().back(), record.end_us());
}

}  // namespace
}  // namespace canhil::plant::glide
