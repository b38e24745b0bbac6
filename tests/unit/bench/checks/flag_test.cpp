// The check of a flag: it must be set, or clear, where it should be.
#include "bench/checks/kinds/flag.hpp"

#include <gmock/gmock.h>

#include <vector>

#include "bench/checks/evidence.hpp"
#include "bench/checks/rule.hpp"
#include "bench/world/motion/rest.hpp"

namespace canhil::checks {
namespace {

using testing::HasSubstr;

constexpr std::int64_t second_us = 1'000'000;
std::vector<std::int64_t> answered, is_set;  // times of the answers, and of those with the flag

std::vector<estimators::Mark> marks(const Observations& /*seen*/) {
  const auto spool = [](const std::vector<std::int64_t>& times) {
    Spool<std::int64_t> all;
    for (const std::int64_t t_us : times) all.push_back(t_us);
    return all;
  };
  return {{.name = "answers", .t_us = spool(answered)}, {.name = "out", .t_us = spool(is_set)}};
}

// Answers every 100 ms for 10 s; the flag is set in those for which `set(t)` holds.
template <class Set>
Finding judged(Flag rule, Set set) {
  answered.clear();
  is_set.clear();
  for (std::int64_t t_us = 100'000; t_us <= 10 * second_us; t_us += 100'000) {
    answered.push_back(t_us);
    if (set(1e-6 * static_cast<double>(t_us))) is_set.push_back(t_us);
  }
  static const quantities::Layout layout;
  const estimators::Estimator it{.name = "it",
                                 .facts = {},
                                 .layout = layout,
                                 .of_runs = {},
                                 .reception = nullptr,
                                 .samples = nullptr,
                                 .tracks = nullptr,
                                 .marks = marks,
                                 .results = nullptr,
                                 .closing = {},
                                 .freshness = nullptr};
  const estimators::Estimator* const all[] = {&it};
  static const world::FlightRecord rest{{.start = {}, .motion = world::Rest{}}, 10 * second_us, 100'000};
  rule.estimator = "it";
  rule.flag = "out";
  Observations seen;
  seen.faults.push_back({.name = "struck", .window = {}, .count = 1});
  seen.faults.push_back({.name = "missed", .window = {}, .count = 0});
  return rule.judge({.seen = seen, .truth = {.flight = rest}, .estimators = all});
}
constexpr scenario::Window from_4_to_6_s{.from_us = 4 * second_us, .to_us = 6 * second_us};

TEST(Flag, MustBeSetInEveryAnswer) {
  const Flag rule{.window = from_4_to_6_s};
  EXPECT_EQ(judged(rule, [](double t) { return t > 3.9; }).outcome, Outcome::pass);
  const Finding late = judged(rule, [](double t) { return t > 4.25; });
  EXPECT_EQ(late.outcome, Outcome::fail);
  EXPECT_EQ(late.measured, "set in 18 of 21 answers, not at 4 s");
  EXPECT_EQ(judged(rule, [](double t) { return t < 5; }).outcome, Outcome::fail);
  EXPECT_EQ(judged(rule, [](double) { return false; }).outcome, Outcome::fail);
}

TEST(Flag, MustBeClear) {
  const Flag rule{.window = from_4_to_6_s, .set = false};
  EXPECT_EQ(judged(rule, [](double t) { return t < 3.95 || t > 6.05; }).outcome, Outcome::pass);
  EXPECT_EQ(judged(rule, [](double t) { return t > 5.95; }).outcome, Outcome::fail);
}

TEST(Flag, MayHaveAShare) {
  const Flag rule{.window = from_4_to_6_s, .share = 0.8};
  EXPECT_EQ(judged(rule, [](double t) { return t > 4.25; }).outcome, Outcome::pass);
  EXPECT_EQ(judged(rule, [](double t) { return t > 4.45; }).outcome, Outcome::fail);
}

TEST(Flag, BecomesSetAsOftenAsItShould) {
  const Flag rule{.window = from_4_to_6_s, .share = 0, .starts = std::pair(1, 1)};
  EXPECT_EQ(judged(rule, [](double t) { return t > 5; }).outcome, Outcome::pass);
  EXPECT_EQ(judged(rule, [](double) { return true; }).outcome, Outcome::fail) << "it was set before";
  EXPECT_EQ(judged(rule, [](double t) { return t > 4.45 && (t < 4.95 || t > 5.45); }).outcome, Outcome::fail);
  EXPECT_EQ(judged(rule, [](double) { return false; }).outcome, Outcome::fail);
}

TEST(Flag, OfAFaultThatDidNotStrikeIsNotMeasured) {
  Flag rule{.window = from_4_to_6_s};
  rule.fault = "struck";
  EXPECT_EQ(judged(rule, [](double) { return true; }).outcome, Outcome::pass);
  rule.fault = "missed";
  EXPECT_EQ(judged(rule, [](double) { return true; }).outcome, Outcome::not_measured);
}

TEST(Flag, WithoutAnswersFails) {
  const Flag rule{.window = {.from_us = 11 * second_us, .to_us = 12 * second_us}, .set = false};
  const Finding finding = judged(rule, [](double) { return false; });
  EXPECT_EQ(finding.outcome, Outcome::fail);
  EXPECT_THAT(finding.measured, HasSubstr("no answers"));
}

}  // namespace
}  // namespace canhil::checks
