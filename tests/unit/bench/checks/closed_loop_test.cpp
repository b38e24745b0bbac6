// The checks of a closed loop: the response of a true value, and the times of commands.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "bench/checks/evidence.hpp"
#include "bench/checks/kinds/command.hpp"
#include "bench/checks/kinds/response.hpp"
#include "bench/world/flight_record.hpp"
#include "bench/world/plant_record.hpp"
#include "bench/world/truth_values.hpp"

namespace canhil::checks {
namespace {

using testing::HasSubstr;
using enum Response::Statistic;

constexpr std::int64_t step_us = 10'000, end_us = 10'000'000;
constexpr double pi = std::numbers::pi;

// 10 s of a plant whose output 'x' follows a function of time, with a command every 20 ms that answers the
// measurement 5 ms before.
class ClosedLoop {
 public:
  template <class X>
  explicit ClosedLoop(X x) : record_({{.name = "plant.x"}}) {
    for (std::int64_t t_us = 0; t_us <= end_us; t_us += step_us)
      record_.add(t_us, std::array<double, 1>{x(1e-6 * static_cast<double>(t_us))});
    record_.commands.push_back({.input = "rudder", .delay_us = 0, .step_us = step_us});
    for (std::int64_t t_us = 20'000; t_us <= end_us; t_us += 20'000)
      record_.commands[0].given.push_back({.t_us = t_us, .value = 1, .cause_us = t_us - 5000});
  }
  world::CommandRecord& command() { return record_.commands[0]; }
  template <class Rule>
  Finding judge(const Rule& rule, std::string timing_unfit = std::string(virtual_time)) {
    return rule.judge({.seen = seen,
                       .truth = {.flight = flight_, .duration_us = end_us, .plants = {&record_}},
                       .timing_unfit = std::move(timing_unfit)});
  }
  Observations seen;

 private:
  world::FlightRecord flight_{{.start = {}, .motion = world::Rest{}}, end_us, step_us};
  world::PlantRecord record_;
};

Response response(Response::Statistic statistic, double below) {
  return {.value = world::find_truth_value("plant.x"),
          .statistic = statistic,
          .setpoint = 1,
          .band = 0.02,
          .below = below,
          .window = {.from_us = 0, .to_us = end_us}};
}

// The step response of a system of second order, damping 0.4, natural frequency 3 rad/s. Its overshoot is
// exp(-pi d / sqrt(1 - d^2)).
constexpr double damping = 0.4, natural = 3;
double second_order(double t) {
  const double root = std::sqrt(1 - damping * damping), w = natural * root;
  return 1 - std::exp(-damping * natural * t) * (std::cos(w * t) + damping / root * std::sin(w * t));
}

TEST(Response, TheOvershootIsThatOfTheory) {
  const double theory = std::exp(-pi * damping / std::sqrt(1 - damping * damping));
  ClosedLoop loop(second_order);
  EXPECT_EQ(loop.judge(response(overshoot, theory + 1e-4)).outcome, Outcome::pass);
  EXPECT_EQ(loop.judge(response(overshoot, theory - 1e-4)).outcome, Outcome::fail);
  EXPECT_THAT(loop.judge(response(overshoot, 1)).measured, HasSubstr("25.4 % of the step"));
  ClosedLoop down([](double t) { return 2 - second_order(t); });
  EXPECT_EQ(down.judge(response(overshoot, theory - 1e-4)).outcome, Outcome::fail);
}

TEST(Response, TheSettlingTimeIsThatOfTheory) {
  double settled = 0;  // a fine search
  for (double t = 0; t < 10; t += 1e-4) {
    if (std::abs(second_order(t) - 1) > 0.02) settled = t;
  }
  ClosedLoop loop(second_order);
  EXPECT_EQ(loop.judge(response(settling_time, settled + 0.011)).outcome, Outcome::pass);
  EXPECT_EQ(loop.judge(response(settling_time, settled - 0.011)).outcome, Outcome::fail);
}

TEST(Response, WhatDoesNotSettleFails) {
  ClosedLoop loop([](double t) { return 1 + 0.1 * std::sin(t); });
  const Finding finding = loop.judge(response(settling_time, 20));
  EXPECT_EQ(finding.outcome, Outcome::fail);
  EXPECT_THAT(finding.measured, HasSubstr("not settled: 0.0544 off at the end"));
}

TEST(Response, TheSteadyErrorIsTheLargestOfTheWindow) {
  ClosedLoop loop(second_order);
  Response rule = response(steady_error, 1e-4);
  EXPECT_EQ(loop.judge(rule).outcome, Outcome::fail);
  rule.window.from_us = 9'000'000;
  EXPECT_EQ(loop.judge(rule).outcome, Outcome::pass);
}

// An angle that turns through 180 degrees.
TEST(Response, AnglesTakeTheShortWay) {
  ClosedLoop loop([](double t) { return 3.0 + 0.2 * second_order(t) - (t > 5 ? 2 * pi : 0); });
  Response rule = response(steady_error, 0.01);
  rule.setpoint = 3.2;
  rule.window.from_us = 4'000'000;
  EXPECT_EQ(loop.judge(rule).outcome, Outcome::fail) << "a plain number";
  rule.turns = true;
  EXPECT_EQ(loop.judge(rule).outcome, Outcome::pass);
}

// Nothing passes for want of evidence.
TEST(Response, NeedsAStepACommandAndATruth) {
  ClosedLoop at_setpoint([](double) { return 1.0; });
  EXPECT_EQ(at_setpoint.judge(response(overshoot, 1)).outcome, Outcome::not_measured);
  EXPECT_EQ(ClosedLoop([](double t) { return 1 - 1e-16 + 1e-3 * std::min(t, 1.0); })
                .judge(response(overshoot, 1))
                .outcome,
            Outcome::not_measured)
      << "a rounding is no step";
  EXPECT_EQ(at_setpoint.judge(response(settling_time, 1)).outcome, Outcome::not_measured);
  EXPECT_EQ(at_setpoint.judge(response(steady_error, 1)).outcome, Outcome::pass);
  at_setpoint.command().given = {};
  const Finding without = at_setpoint.judge(response(steady_error, 1));
  EXPECT_EQ(without.outcome, Outcome::fail);
  EXPECT_EQ(without.measured, "no command of 'rudder' came");
  ClosedLoop loop(second_order);
  Response rule = response(steady_error, 1);
  rule.value = world::find_truth_value("plant.depth");
  EXPECT_EQ(loop.judge(rule).outcome, Outcome::not_measured);
  EXPECT_THAT(loop.judge(rule).measured, HasSubstr("the truth has no plant.depth"));
}

// A host that sends its samples late as a rule makes the loop worse: the device is not blamed.
TEST(Response, AHostThatIsLateIsNoFault) {
  ClosedLoop loop([](double) { return 5.0; });
  for (int i = 0; i < 100; ++i) loop.seen.timing.lateness.add(1e6);
  EXPECT_EQ(loop.judge(response(steady_error, 1), "").outcome, Outcome::fail) << "1 ms of a step of 10 ms";
  for (int i = 0; i < 100; ++i) loop.seen.timing.lateness.add(30e6);
  const Finding late = loop.judge(response(steady_error, 1), "");
  EXPECT_EQ(late.outcome, Outcome::not_measured);
  EXPECT_EQ(loop.judge(response(steady_error, 10), "").outcome, Outcome::not_measured)
      << "another loop passed";
  EXPECT_THAT(late.measured, HasSubstr("the bench itself was 30"));
}

CommandTime command(CommandTime::Statistic statistic, std::int64_t below_us) {
  return {.input = "rudder",
          .statistic = statistic,
          .below_us = below_us,
          .window = {.from_us = 0, .to_us = end_us}};
}

TEST(CommandTime, TheAgeIsTheTimeSinceTheNewestCommand) {
  ClosedLoop loop(second_order);
  using enum CommandTime::Statistic;
  EXPECT_EQ(loop.judge(command(age, 21'000)).outcome, Outcome::pass);
  EXPECT_EQ(loop.judge(command(age, 9000)).outcome, Outcome::fail);
  Spool<world::Given> gap;  // no command from 3 to 4 s
  for (const world::Given& one : loop.command().given) {
    if (one.t_us < 3'000'000 || one.t_us > 4'000'000) gap.push_back(one);
  }
  loop.command().given = gap;
  const Finding finding = loop.judge(command(age, 500'000));
  EXPECT_EQ(finding.outcome, Outcome::fail);
  EXPECT_THAT(finding.measured, HasSubstr("1030.000 ms")) << "from 2.98 s to the step at 4.01 s";
  loop.command().given = {};
  EXPECT_EQ(loop.judge(command(age, 500'000)).measured, "no command of 'rudder' came");
}

TEST(CommandTime, TheDelayIsFromTheMeasurementToTheEffect) {
  ClosedLoop loop(second_order);
  using enum CommandTime::Statistic;
  for (int i = 0; i < 100; ++i) loop.seen.timing.lateness.add(1e4);
  EXPECT_EQ(loop.judge(command(delay, 6000), "").outcome, Outcome::pass);
  EXPECT_EQ(loop.judge(command(delay, 4000), "").outcome, Outcome::fail);
  loop.command().delay_us = 60'000;
  EXPECT_EQ(loop.judge(command(delay, 40'000), "").outcome, Outcome::fail);
  EXPECT_THAT(loop.judge(command(delay, 40'000), "").measured, HasSubstr("65.000 ms of 500"));
}

// An answer takes no virtual time: a short delay proves nothing, a long one does.
TEST(CommandTime, InVirtualTimeADelayCannotPass) {
  ClosedLoop loop(second_order);
  using enum CommandTime::Statistic;
  EXPECT_EQ(loop.judge(command(delay, 6000)).outcome, Outcome::not_measured);
  EXPECT_EQ(loop.judge(command(delay, 4000)).outcome, Outcome::fail);
}

}  // namespace
}  // namespace canhil::checks
