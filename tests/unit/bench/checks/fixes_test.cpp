// Checks of how the target used position fixes, and of the gaps that it bridged.

#include <gmock/gmock.h>

#include "bench/checks/kinds/answers.hpp"
#include "bench/checks/kinds/consistency.hpp"
#include "bench/estimators/inflight_alignment/answers.hpp"
#include "bench/estimators/inflight_alignment/quantities.hpp"
#include "bench/world/units.hpp"
#include "dbc/wire/transmit.hpp"
#include "tests/unit/bench/checks/judged.hpp"
#include "tests/unit/bench/edited.hpp"

namespace canhil::checks {
namespace {

using namespace estimators;

using messages::FixOutcome;
using testing::HasSubstr;

constexpr std::int64_t second_us = 1'000'000;
constexpr std::int64_t duration_us = 20 * second_us;
constexpr scenario::Window whole{.from_us = 0, .to_us = duration_us};

// A run of 20 s at rest with an SSBL fix each second; the target uses all fixes. The tests change this run.
class Fixed : public testing::Test {
 protected:
  Fixed() {
    for (std::int64_t t_us = second_us; t_us <= duration_us; t_us += second_us) {
      seen_.of<InflightAnswers>().sent.push_back({.source = messages::FixSource::ssbl, .valid_us = t_us});
      seen_.of<InflightAnswers>().navigation.push_back({.cause_us = t_us, .angles = {}});
      FixAnswer fix{.cause_us = t_us, .navigation_us = t_us, .nis = 3};
      fix.position = start;
      fix.attitude_sigma.z() = 0.1;
      seen_.of<InflightAnswers>().fixes.push_back(fix);
    }
  }
  template <class Rule>
  CheckResult judge(const Rule& rule) {
    return judged(rule, seen_, {.flight = truth_, .duration_us = duration_us});
  }
  void unanswered(std::size_t index, std::size_t count) {
    const auto from = static_cast<std::ptrdiff_t>(index);
    const auto to = static_cast<std::ptrdiff_t>(index + count);
    test::Edited(seen_.of<InflightAnswers>().fixes).erase(from, to);
  }

  static constexpr world::Position start{.latitude = 0.6, .longitude = 2, .height = 5};
  world::FlightRecord truth_{{.start = start, .motion = world::Rest{}}, duration_us, 20'000};
  Observations seen_;
};

constexpr const char* estimator = "inflight_alignment";

Error position(double below = 1, const scenario::Window& window = whole) {
  return error_of(estimator, quantities::position_norm, window, below);
}
Consistency consistency(const quantities::Quantity& quantity, double low, double high) {
  return {.judged = {.estimator = estimator, .quantity = &quantity},
          .window = whole,
          .bound = MeanBetween{low, high}};
}
Answers counted(Answers::Count count, const scenario::Window& window = whole) {
  return {.estimator = estimator, .window = window, .counts = {std::move(count)}};
}

TEST_F(Fixed, PositionErrorByItsComponent) {
  seen_.of<InflightAnswers>().fixes[10].position = displaced(start, {3, 4, -12});
  using namespace quantities;
  for (const auto& [quantity, size] : {std::pair{&position_north, 3.0},
                                       {&position_east, 4.0},
                                       {&position_down, 12.0},
                                       {&position_horizontal, 5.0},
                                       {&position_norm, 13.0}}) {
    EXPECT_EQ(judge(error_of(estimator, *quantity, whole, size + 0.01)).outcome, Outcome::pass)
        << quantity->name;
    EXPECT_EQ(judge(error_of(estimator, *quantity, whole, size - 0.01)).outcome, Outcome::fail)
        << quantity->name;
  }
  EXPECT_EQ(judge(position(1, {0, 10 * second_us})).outcome, Outcome::pass);
}

TEST_F(Fixed, APositionWithoutAKnownTimeIsNotJudged) {
  seen_.of<InflightAnswers>().fixes[10].position = displaced(start, {100, 0, 0});
  for (const FixOutcome outcome : {FixOutcome::late, FixOutcome::future, FixOutcome::out_of_order,
                                   FixOutcome::wrong_source, FixOutcome::invalid, FixOutcome::before_start}) {
    seen_.of<InflightAnswers>().fixes[10].outcome = outcome;
    EXPECT_EQ(judge(position()).outcome, Outcome::pass);
  }
  seen_.of<InflightAnswers>().fixes[10].outcome = FixOutcome::gated;
  EXPECT_EQ(judge(position()).outcome, Outcome::fail);
}

TEST_F(Fixed, FixesThatAreNotAnsweredFail) {
  const Consistency nis = consistency(quantities::innovation_nis, 2, 4);
  unanswered(5, 2);
  EXPECT_EQ(judge(position()).outcome, Outcome::pass) << "two in a row may be";
  EXPECT_EQ(judge(nis).outcome, Outcome::pass);
  unanswered(5, 1);
  EXPECT_EQ(judge(position()).outcome, Outcome::fail);
  EXPECT_EQ(judge(position()).measured, "no answers to Ssbl before 8 s");
  EXPECT_EQ(judge(nis).outcome, Outcome::fail);
}

TEST_F(Fixed, FixesThatWereNotSentNeedNoAnswer) {
  unanswered(5, 8);
  auto& sent = seen_.of<InflightAnswers>().sent;
  test::Edited(sent).erase(5, 13);
  EXPECT_EQ(judge(position()).outcome, Outcome::pass);
  EXPECT_EQ(judge(consistency(quantities::innovation_nis, 2, 4)).outcome, Outcome::pass);
}

TEST_F(Fixed, NisIsOfTheFixesThatWereUsed) {
  const Consistency rule = consistency(quantities::innovation_nis, 2.9, 3.1);
  seen_.of<InflightAnswers>().fixes[3].nis = 600;
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
  seen_.of<InflightAnswers>().fixes[3].outcome = FixOutcome::gated;
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  seen_.of<InflightAnswers>().fixes[3].outcome = FixOutcome::recovered;
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
}

TEST_F(Fixed, HeadingNeesFailsAnOverconfidentFilter) {
  const Consistency rule = consistency(quantities::heading_nees, 0, 1.5);
  for (NavigationAnswer& answer : test::Edited(seen_.of<InflightAnswers>().navigation))
    answer.angles.heading = 0.1;
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  EXPECT_EQ(judge(rule).measured, "mean 1.000 of 19");
  for (FixAnswer& fix : test::Edited(seen_.of<InflightAnswers>().fixes)) fix.attitude_sigma.z() = 0.05;
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
}

TEST_F(Fixed, WhatBecameOfFixesIsCounted) {
  for (const std::size_t index : {3, 7, 8})
    seen_.of<InflightAnswers>().fixes[index].outcome = FixOutcome::gated;
  EXPECT_EQ(judge(counted({.mark = "gated", .at_least = 3, .at_most = 3})).outcome, Outcome::pass);
  EXPECT_EQ(judge(counted({.mark = "gated", .at_least = 3, .at_most = 3})).measured, "gated 3");
  EXPECT_EQ(judge(counted({.mark = "gated", .at_least = 3, .at_most = 3})).expected,
            "gated >= 3, gated <= 3 from 0 to 20 s");
  EXPECT_EQ(judge(counted({.mark = "gated", .at_least = 4, .at_most = 3})).outcome, Outcome::fail);
  const Answers::Count two{.mark = "gated", .at_most = 2};
  EXPECT_EQ(judge(counted(two)).outcome, Outcome::fail);
  const scenario::Window early{.from_us = 0, .to_us = 8 * second_us};
  EXPECT_EQ(judge(counted(two, early)).outcome, Outcome::pass) << "one of them is later";
  EXPECT_EQ(judge(counted({.mark = "accepted", .at_least = 6, .at_most = 6}, early)).outcome, Outcome::pass);
}

TEST_F(Fixed, ARepairIsCountedWhereItCameAndTheHandoverWhereItFirstWas) {
  const Answers::Count none{.mark = "repaired", .at_most = 0};
  EXPECT_EQ(judge(counted(none)).outcome, Outcome::pass);
  seen_.of<InflightAnswers>().fixes[15].repaired = true;  // the fix at 16 s
  EXPECT_EQ(judge(counted(none)).measured, "repaired 1");
  EXPECT_EQ(judge(counted(none)).outcome, Outcome::fail);
  EXPECT_EQ(judge(counted(none, {.from_us = 0, .to_us = 15 * second_us})).outcome, Outcome::pass);
  const Answers::Count resolved{.mark = "handed_over", .before_us = 6 * second_us};
  EXPECT_EQ(judge(counted(resolved)).measured, "never handed_over");
  EXPECT_EQ(judge(counted(resolved)).outcome, Outcome::fail);
  for (std::size_t index = 5; index < 20; ++index)
    seen_.of<InflightAnswers>().fixes[index].handed_over = true;  // from 6 s on
  EXPECT_EQ(judge(counted(resolved)).outcome, Outcome::fail);
  seen_.of<InflightAnswers>().fixes[4].handed_over = true;
  EXPECT_EQ(judge(counted(resolved)).outcome, Outcome::pass);
  EXPECT_EQ(judge(counted(resolved)).measured, "handed_over at 5 s");
}

TEST_F(Fixed, SilenceNeverPasses) {
  seen_.of<InflightAnswers>().fixes = {};
  seen_.of<InflightAnswers>().navigation = {};
  EXPECT_EQ(judge(position()).measured, "no answers");
  EXPECT_EQ(judge(counted({.mark = "gated", .at_most = 3})).outcome, Outcome::fail);
  EXPECT_EQ(judge(counted({.mark = "coasting", .at_most = 0})).measured, "no answers");
}

TEST_F(Fixed, CoastingAnswersAreCounted) {
  for (const std::size_t index : {3, 7}) seen_.of<InflightAnswers>().navigation[index].coasting = true;
  EXPECT_EQ(judge(counted({.mark = "coasting", .at_least = 2, .at_most = 2})).outcome, Outcome::pass);
  EXPECT_EQ(judge(counted({.mark = "coasting", .at_least = 3})).outcome, Outcome::fail);
  EXPECT_EQ(judge(counted({.mark = "coasting", .at_most = 1})).outcome, Outcome::fail);
  EXPECT_EQ(judge(counted({.mark = "coasting", .at_most = 1}, {0, 5 * second_us})).outcome, Outcome::pass);
}

TEST_F(Fixed, BarsInDegreesAreReportedInDegrees) {
  seen_.of<InflightAnswers>().navigation[5].angles.heading = 0.0349066;  // 2 deg
  Error rule = error_of(estimator, quantities::attitude_heading, whole, 3 * world::units::deg);
  rule.unit = quantities::degrees;
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  EXPECT_THAT(judge(rule).measured, HasSubstr("max 2.000 deg"));
  EXPECT_THAT(judge(rule).expected, HasSubstr("< 3 deg"));
}

}  // namespace
}  // namespace canhil::checks
