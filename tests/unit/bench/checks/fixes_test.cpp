// Checks of what the target made of position fixes, and of what it bridged.
#include "bench/checks/fixes.hpp"

#include <gmock/gmock.h>

#include "bench/checks/judge.hpp"
#include "bench/world/motion/rest.hpp"
#include "dbc/wire/transmit.hpp"

namespace canhil::checks {
namespace {

using messages::FixOutcome;
using testing::HasSubstr;

constexpr std::int64_t second_us = 1'000'000;
constexpr std::int64_t duration_us = 20 * second_us;
constexpr scenario::Window whole{.from_us = 0, .to_us = duration_us};

// 20 s at rest, a fix of the SSBL each second, all of them used; tests spoil it.
class Fixed : public testing::Test {
 protected:
  Fixed() {
    for (std::int64_t t_us = second_us; t_us <= duration_us; t_us += second_us) {
      seen_.sent_fixes.push_back({.source = messages::FixSource::ssbl, .valid_us = t_us});
      seen_.fix_navigation.push_back({.cause_us = t_us, .angles = {}});
      FixAnswer fix{.cause_us = t_us, .navigation_us = t_us, .nis = 3};
      fix.position = start;
      fix.heading_sigma = 0.1;
      seen_.fixes.push_back(fix);
    }
  }
  template <class Rule>
  CheckResult judge(Rule rule) {
    if constexpr (requires { rule.of; }) rule.of = scenario::Aligner::inflight_alignment;
    scenario::Scenario scenario;
    scenario.checks.push_back({.name = "it", .requirement = "", .rule = rule});
    return checks::judge(scenario, {.seen = seen_,
                                    .truth = truth_,
                                    .duration_us = duration_us,
                                    .ended_early = "",
                                    .timing_unfit = ""})
        .checks.at(0);
  }
  void unanswered(std::size_t place, std::size_t count) {
    const auto from = static_cast<std::ptrdiff_t>(place);
    const auto to = static_cast<std::ptrdiff_t>(place + count);
    seen_.fixes.erase(seen_.fixes.begin() + from, seen_.fixes.begin() + to);
  }

  static constexpr world::Position start{.latitude = 0.6, .longitude = 2, .height = 5};
  world::FlightRecord truth_{{.start = start, .motion = world::Rest{}}, duration_us, 20'000};
  Observations seen_;
};

TEST_F(Fixed, PositionErrorByItsAxis) {
  seen_.fixes[10].position = displaced(start, {3, 4, -12});
  const auto outcome = [&](scenario::PositionAxis axis, double below) {
    return judge(scenario::PositionError{.axis = axis, .window = whole, .below = below}).outcome;
  };
  using enum scenario::PositionAxis;
  for (const auto& [axis, size] :
       {std::pair{north, 3.0}, {east, 4.0}, {down, 12.0}, {horizontal, 5.0}, {norm, 13.0}}) {
    EXPECT_EQ(outcome(axis, size + 0.01), Outcome::pass) << scenario::name(axis);
    EXPECT_EQ(outcome(axis, size - 0.01), Outcome::fail) << scenario::name(axis);
  }
  EXPECT_EQ(judge(scenario::PositionError{.window = {0, 10 * second_us}, .below = 1}).outcome, Outcome::pass);
}

TEST_F(Fixed, APositionWithoutAKnownTimeIsNotJudged) {
  seen_.fixes[10].position = displaced(start, {100, 0, 0});
  for (const FixOutcome outcome : {FixOutcome::late, FixOutcome::future, FixOutcome::out_of_order,
                                   FixOutcome::wrong_source, FixOutcome::invalid, FixOutcome::before_start}) {
    seen_.fixes[10].outcome = outcome;
    EXPECT_EQ(judge(scenario::PositionError{.window = whole, .below = 1}).outcome, Outcome::pass);
  }
  seen_.fixes[10].outcome = FixOutcome::gated;
  EXPECT_EQ(judge(scenario::PositionError{.window = whole, .below = 1}).outcome, Outcome::fail);
}

TEST_F(Fixed, FixesThatAreNotAnsweredFail) {
  const scenario::PositionError position{.window = whole, .below = 1};
  const scenario::Consistency consistency{.window = whole, .bound = scenario::MeanBetween{2, 4}};
  unanswered(5, 2);
  EXPECT_EQ(judge(position).outcome, Outcome::pass) << "two in a row may be";
  EXPECT_EQ(judge(consistency).outcome, Outcome::pass);
  unanswered(5, 1);
  EXPECT_EQ(judge(position).outcome, Outcome::fail);
  EXPECT_EQ(judge(position).measured, "no answers to Ssbl before 8 s");
  EXPECT_EQ(judge(consistency).outcome, Outcome::fail);
}

TEST_F(Fixed, FixesThatWereNotSentNeedNoAnswer) {
  unanswered(5, 8);
  auto& sent = seen_.sent_fixes;
  sent.erase(sent.begin() + 5, sent.begin() + 13);
  EXPECT_EQ(judge(scenario::PositionError{.window = whole, .below = 1}).outcome, Outcome::pass);
  EXPECT_EQ(judge(scenario::Consistency{.window = whole, .bound = scenario::MeanBetween{2, 4}}).outcome,
            Outcome::pass);
}

TEST_F(Fixed, NisIsOfTheFixesThatWereUsed) {
  scenario::Consistency rule{.window = whole, .bound = scenario::MeanBetween{2.9, 3.1}};
  seen_.fixes[3].nis = 600;
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
  seen_.fixes[3].outcome = FixOutcome::gated;
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  seen_.fixes[3].outcome = FixOutcome::recovered;
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
}

TEST_F(Fixed, HeadingNeesFailsAnOverconfidentFilter) {
  const scenario::Consistency rule{.statistic = scenario::Statistic::heading_nees,
                                   .window = whole,
                                   .bound = scenario::MeanBetween{0, 1.5}};
  for (NavigationAnswer& answer : seen_.fix_navigation) answer.angles.heading = 0.1;
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  EXPECT_EQ(judge(rule).measured, "mean 1.000 of 19");
  for (FixAnswer& fix : seen_.fixes) fix.heading_sigma = 0.05;
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
}

TEST_F(Fixed, WhatBecameOfFixesIsCounted) {
  for (const std::size_t place : {3, 7, 8}) seen_.fixes[place].outcome = FixOutcome::gated;
  scenario::Fixes rule{.window = whole,
                       .counts = {{.outcome = "gated", .at_least = 3, .at_most = 3}},
                       .repairs_at_most = {},
                       .handed_over_before_us = {}};
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  EXPECT_EQ(judge(rule).measured, "gated 3");
  EXPECT_EQ(judge(rule).expected, "gated >= 3, gated <= 3");
  rule.counts[0].at_least = 4;
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
  rule.counts[0] = {.outcome = "gated", .at_least = {}, .at_most = 2};
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
  rule.window.to_us = 8 * second_us;  // one of them is later
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  rule.counts[0] = {.outcome = "accepted", .at_least = 6, .at_most = 6};
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
}

TEST_F(Fixed, RepairsAndHandoverAreThoseOfTheWholeRun) {
  scenario::Fixes rule{.window = whole, .counts = {}, .repairs_at_most = 2, .handed_over_before_us = {}};
  seen_.fixes.back().repairs = 2;
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  seen_.fixes.back().repairs = 3;
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
  rule = {.window = whole, .counts = {}, .repairs_at_most = {}, .handed_over_before_us = 6 * second_us};
  EXPECT_EQ(judge(rule).measured, "heading never resolved");
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
  seen_.fixes[5].handed_over = true;  // at 6 s
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
  seen_.fixes[4].handed_over = true;
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
}

TEST_F(Fixed, SilenceNeverPasses) {
  seen_.fixes.clear();
  seen_.fix_navigation.clear();
  EXPECT_EQ(judge(scenario::PositionError{.window = whole, .below = 1}).measured, "no answers");
  EXPECT_EQ(judge(scenario::Fixes{.window = whole,
                                  .counts = {{.outcome = "gated", .at_least = {}, .at_most = 3}},
                                  .repairs_at_most = 0,
                                  .handed_over_before_us = {}})
                .outcome,
            Outcome::fail);
  EXPECT_EQ(judge(scenario::Coasting{.window = whole, .at_least = {}, .at_most = 0}).outcome, Outcome::fail);
}

TEST_F(Fixed, CoastingAnswersAreCounted) {
  for (const std::size_t place : {3, 7}) seen_.fix_navigation[place].coasting = true;
  EXPECT_EQ(judge(scenario::Coasting{.window = whole, .at_least = 2, .at_most = 2}).outcome, Outcome::pass);
  EXPECT_EQ(judge(scenario::Coasting{.window = whole, .at_least = 3, .at_most = {}}).outcome, Outcome::fail);
  EXPECT_EQ(judge(scenario::Coasting{.window = whole, .at_least = {}, .at_most = 1}).outcome, Outcome::fail);
  EXPECT_EQ(judge(scenario::Coasting{.window = {0, 5 * second_us}, .at_least = {}, .at_most = 1}).outcome,
            Outcome::pass);
}

TEST_F(Fixed, BarsInDegreesAreReportedInDegrees) {
  seen_.fix_navigation[5].angles.heading = 0.0349066;  // 2 deg
  const scenario::AttitudeError rule{.axis = scenario::AttitudeAxis::heading,
                                     .window = whole,
                                     .below = 3 * world::units::deg,
                                     .unit = scenario::degrees};
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  EXPECT_THAT(judge(rule).measured, HasSubstr("max 2.000 deg"));
  EXPECT_THAT(judge(rule).expected, HasSubstr("< 3 deg"));
}

}  // namespace
}  // namespace canhil::checks
