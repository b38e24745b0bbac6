// Which runs count as diverged, and whose warnings as too late.
#include "bench/campaign/divergence.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/bench/campaign/runs.hpp"

namespace canhil::campaign {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr const Quantity& heading = quantities::attitude_heading;
constexpr const Quantity& trusted = quantities::trusted_over_sigma;

TEST(Divergence, CountsFaultsAndWhatIsBeyondAtTheEnd) {
  std::vector runs{run_with(0, {9, 1}), run_with(1, {1, -9}), run_with(2, {1, nan}), run_with(3, {1}),
                   run_with(4, {})};
  runs[3].ending.kind = drive::Ending::Kind::target_fault;
  const auto found = divergence(runs, heading, 2);
  EXPECT_EQ(found.faulted, 1U);
  EXPECT_EQ(found.beyond, 3U);
  EXPECT_EQ(found.runs, 5U);
}

// A filter whose covariance is no longer a number has diverged, wherever its heading is.
TEST(Divergence, CountsRunsWithoutAFiniteNees) {
  std::vector runs{run_with(0, {1, 1}), run_with(1, {1, 1}), run_with(2, {1, 1})};
  runs[1].samples = Samples(runs[0].samples.layout());
  add(runs[1].samples, 100'000, {{&heading, 1}, {&quantities::attitude_nees, inf}});
  add(runs[1].samples, 200'000, {{&heading, 1}, {&quantities::attitude_nees, 3}});
  runs[2].samples = Samples(runs[0].samples.layout());
  add(runs[2].samples, 100'000, {{&heading, 1}, {&quantities::attitude_nees, 3}});
  add(runs[2].samples, 200'000, {{&heading, 1}, {&quantities::attitude_nees, inf}});
  EXPECT_EQ(divergence(runs, heading, 2).beyond, 1U) << "at the end";
  EXPECT_EQ(divergence(runs, heading, 2, 0).beyond, 2U) << "at any time";
}

/// An answer: its error over sigma, and whether it warns.
struct Answered {
  double over_sigma;
  bool warns = false;
};

/// A run of 2 s with answers at 0.1 s, 0.2 s ..., which are fresh for 0.3 s; the last one is repeated to the
/// end if it is `held`.
RunSeries warning(std::vector<Answered> answers, bool held = true) {
  RunSeries series{.run = 0, .ending = {}, .samples = Samples(estimators::wind.layout)};
  series.freshness = {.age_limit_us = 300'000, .end_us = 2'000'000};
  if (held) answers.resize(20, answers.back());
  std::int64_t t_us = 0;
  for (const auto& [over_sigma, warns] : answers)
    add(series.samples, t_us += 100'000,
        {{&quantities::error_over_sigma, over_sigma}, {&quantities::degraded, warns ? 1 : 0}});
  return series;
}

Divergence within_200_ms(const RunSeries& run, std::int64_t from_us = 0) {
  return divergence(std::vector{run}, trusted, 5, from_us, 200'000);
}

TEST(Warning, MustComeInTime) {
  EXPECT_EQ(within_200_ms(warning({{1}, {6}, {6}, {6}, {0}})).beyond, 0U) << "at 0.4 s it is allowed";
  EXPECT_EQ(within_200_ms(warning({{1}, {6}, {6}, {6}, {6}, {0}})).beyond, 1U);
  EXPECT_EQ(within_200_ms(warning({{1}, {6}, {6}, {6, true}})).beyond, 0U);
  EXPECT_EQ(within_200_ms(warning({{1}, {4}})).beyond, 0U) << "never beyond";
  EXPECT_EQ(within_200_ms(warning({{6}, {6}, {6}, {6}, {0}}), 200'000).beyond, 0U)
      << "the first one from 0.2 s";
}

// The time runs from the first error, also if the target warned then.
TEST(Warning, MustLastAsLongAsTheError) {
  EXPECT_EQ(within_200_ms(warning({{6, true}, {6, true}, {6, true}, {6}})).beyond, 1U);
  EXPECT_EQ(within_200_ms(warning({{6}, {6, true}, {0}, {0}, {7}, {0}})).beyond, 1U) << "it comes back";
  EXPECT_EQ(within_200_ms(warning({{6, true}, {6, true}, {6, true}, {4}})).beyond, 0U);
}

TEST(Warning, IsNotSilence) {
  EXPECT_EQ(within_200_ms(warning({{6}}, false)).beyond, 1U);
  EXPECT_EQ(within_200_ms(warning({{6, true}}, false)).beyond, 1U) << "nobody knows how it went on";
  EXPECT_EQ(within_200_ms(warning({}, false)).beyond, 1U);
  EXPECT_EQ(within_200_ms(warning({{1}, {1}}, false)).beyond, 0U) << "never beyond";
}

TEST(Warning, MustConcernNumbers) {
  EXPECT_EQ(within_200_ms(warning({{1}, {inf}, {1}})).beyond, 1U) << "also within the time";
  EXPECT_EQ(within_200_ms(warning({{1}, {nan}, {1}})).beyond, 1U);
  EXPECT_EQ(within_200_ms(warning({{1}, {inf, true}, {1}})).beyond, 0U) << "it warns";
  RunSeries run = warning({{1}, {1}});
  add(run.samples, 2'100'000, {{&quantities::wind_nees, inf}});
  EXPECT_EQ(within_200_ms(run).beyond, 1U);
}

TEST(Warning, CannotBeJudgedAtTheEnd) {
  std::vector<Answered> answers(20, {1});
  answers[18] = answers[19] = {6};
  const Divergence late = within_200_ms(warning(answers));
  EXPECT_EQ(late.beyond, 0U);
  EXPECT_EQ(late.ever_above, 1U);
  EXPECT_EQ(late.too_late, 1U);
  const Divergence in_time = within_200_ms(warning({{6, true}}));
  EXPECT_EQ(in_time.ever_above, 1U);
  EXPECT_EQ(in_time.too_late, 0U);
  EXPECT_EQ(within_200_ms(warning({{1}})).ever_above, 0U);
}

TEST(Warning, OfARunThatEndedEarlyIsOfNoUse) {
  EXPECT_EQ(divergence(std::vector{ended_with(4, {1, 1})}, trusted, 5, 0, 200'000).faulted, 1U);
}

}  // namespace
}  // namespace canhil::campaign
