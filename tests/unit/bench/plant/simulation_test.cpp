// A plant in a run: when commands act, and the flight that follows.
#include "bench/plant/simulation.hpp"

#include <gmock/gmock.h>

#include <array>
#include <atomic>
#include <cmath>
#include <vector>

#include "bench/world/attitude.hpp"
#include "bench/world/stoppable.hpp"

namespace canhil::plant {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Shows its input, and a heading that turns at the rate of the input.
class Turntable final : public Plant {
 public:
  explicit Turntable(std::int64_t fails_us) : fails_us_(fails_us) {}
  [[nodiscard]] std::span<const double> outputs() const override { return outputs_; }
  Result<void> step(std::int64_t from_us, std::int64_t to_us, std::span<const double> inputs) override {
    if (to_us == fails_us_) return failure("the turntable broke");
    outputs_[0] += inputs[0] * 1e-6 * static_cast<double>(to_us - from_us);
    outputs_[1] = inputs[0];
    if (inputs[0] > 1000) outputs_[1] = std::nan("");
    return {};
  }

 private:
  std::int64_t fails_us_;
  std::array<double, 2> outputs_{};
};

class TurntablePlan final : public Plan {
 public:
  TurntablePlan() {
    inputs = {{.name = "rate", .si = "rad/s"}};
    outputs = {{.name = "attitude.heading", .si = "rad", .turns = true}, {.name = "held", .si = "rad/s"}};
    step_us = 10'000;
  }
  [[nodiscard]] Result<std::unique_ptr<Plant>> make(const Draw& /*draw*/) const override {
    return std::make_unique<Turntable>(fails_us);
  }
  std::int64_t fails_us = -1;
};

class Flown {
 public:
  explicit Flown(Command command = {.from = "rate.command"}, std::int64_t fails_us = -1) {
    auto plan = std::make_shared<TurntablePlan>();
    plan->fails_us = fails_us;
    setup_.kind = "turntable";
    setup_.plan = plan;
    setup_.start = {0.5};
    setup_.commands = {command};
    setup_.motion[2] = *scenario::Expression::parse("plant.attitude.heading");
    simulation_ = std::move(*Simulation::begin(
        setup_, {}, {.start = {.latitude = 0.8}, .duration_us = 100'000, .interval_us = 10'000}));
  }
  Simulation* operator->() { return simulation_.get(); }
  // The input that acted in each step.
  [[nodiscard]] std::vector<double> held() const {
    std::vector<double> all;
    const world::PlantRecord& record = simulation_->record();
    for (std::size_t i = 1; i < record.times_us().size(); ++i) all.push_back(record.value(1, i));
    return all;
  }

 private:
  Setup setup_;
  std::unique_ptr<Simulation> simulation_;
};

// A command acts from the first step on that begins at or after its arrival.
TEST(PlantSimulation, ACommandActsFromTheNextStepOn) {
  Flown flown;
  flown->give(0, {.t_us = 10'000, .value = 1});
  flown->give(0, {.t_us = 25'000, .value = 2});
  flown->advance(50'000);
  EXPECT_THAT(flown.held(), ElementsAre(0.5, 1, 1, 2, 2));
}

// When somebody looks at the flight does not change it.
TEST(PlantSimulation, ItDependsOnTheArrivalOfCommandsAlone) {
  Flown one, other;
  for (std::int64_t t_us = 0; t_us <= 100'000; t_us += 1000) {
    one->advance(t_us);
    if (t_us == 12'000 || t_us == 40'000) {
      one->give(0, {.t_us = t_us, .value = 1e-4 * static_cast<double>(t_us)});
      other->advance(t_us);
      other->give(0, {.t_us = t_us, .value = 1e-4 * static_cast<double>(t_us)});
    }
  }
  other->advance(100'000);
  EXPECT_EQ(one.held(), other.held());
  for (std::size_t i = 0; i < one->flight()->epochs().size(); ++i)
    EXPECT_EQ(one->flight()->epochs()[i].C_bn, other->flight()->epochs()[i].C_bn);
}

TEST(PlantSimulation, ADelayAddsToTheArrival) {
  Flown flown({.from = "rate.command", .delay_us = 15'000});
  flown->give(0, {.t_us = 10'000, .value = 1});
  flown->advance(50'000);
  EXPECT_THAT(flown.held(), ElementsAre(0.5, 0.5, 0.5, 1, 1));
}

TEST(PlantSimulation, AfterATimeoutTheInputChanges) {
  Flown flown({.from = "rate.command", .timeout_us = 20'000, .after_timeout = -1.0});
  flown->give(0, {.t_us = 0, .value = 1});
  flown->give(0, {.t_us = 60'000, .value = 2});
  flown->advance(80'000);
  EXPECT_THAT(flown.held(), ElementsAre(1, 1, 1, -1, -1, -1, 2, 2));
  const world::CommandRecord& record = flown->record().commands.front();
  EXPECT_THAT(std::vector(record.missing_us.begin(), record.missing_us.end()),
              ElementsAre(30'000, 40'000, 50'000));
}

TEST(PlantSimulation, AValueThatIsNoneIsNoCommand) {
  Flown flown;
  flown->give(0, {.t_us = 0, .value = 1});
  flown->give(0, {.t_us = 5000, .value = std::nan("")});
  flown->advance(30'000);
  EXPECT_THAT(flown.held(), ElementsAre(1, 1, 1));
  EXPECT_EQ(flown->record().commands.front().invalid, 1U);
}

// The gyros measure the turn, except at the first step, before which nothing is known.
TEST(PlantSimulation, TheCarrierTurnsWithThePlant) {
  Flown flown;
  flown->give(0, {.t_us = 0, .value = 2});
  flown->advance(100'000);
  const world::FlightRecord& flight = *flown->flight();
  ASSERT_EQ(flight.increments().size(), 10U);
  double turned = 0;
  for (std::size_t i = 0; i < flight.increments().size(); ++i) {
    turned += flight.increments()[i].delta_theta.z();
    EXPECT_NEAR(turned, world::euler_from(flight.epochs()[i + 1].C_bn).heading, 1e-5)
        << i;  // the Earth turns too
  }
  EXPECT_NEAR(turned, 0.2, 1e-5);
  EXPECT_EQ(flight.known_until_us(), 100'000);
}

TEST(PlantSimulation, AFailureStopsItWithItsReason) {
  Flown flown({.from = "rate.command"}, 30'000);
  flown->advance(20'000);
  EXPECT_FALSE(flown->why_failed());
  flown->advance(60'000);
  EXPECT_EQ(flown->why_failed(), "the turntable broke");
  EXPECT_EQ(flown->record().times_us().size(), 3U);
  EXPECT_EQ(flown->flight()->known_until_us(), 60'000) << "whoever looks finds a flight that stands still";
}

TEST(PlantSimulation, AnOutputThatIsNotFiniteIsAFailure) {
  Flown flown;
  flown->give(0, {.t_us = 0, .value = 2000});
  flown->advance(60'000);
  ASSERT_TRUE(flown->why_failed());
  EXPECT_THAT(*flown->why_failed(),
              HasSubstr("the plant 'turntable' has no finite value of 'held' at t=0.010 s"));
}

// A signal that ends the command may come between two transmissions: the next sensor still looks at the
// flight.
TEST(PlantSimulation, TheFlightIsCompleteIfTheRunIsInterrupted) {
  Flown flown;
  const std::atomic<bool> stop = true;
  const world::Stoppable stoppable(stop);
  flown->advance(50'000);
  ASSERT_EQ(flown->flight()->epochs().size(), 6U);
  EXPECT_EQ(flown->flight()->at(50'000).t_us, 50'000);
}

}  // namespace
}  // namespace canhil::plant
