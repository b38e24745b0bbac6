// Where the truth has no value, such as the course at standstill, nothing is judged, and the target is not
// silent.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/checks/evidence.hpp"
#include "bench/checks/kinds/error.hpp"
#include "bench/checks/rule.hpp"
#include "bench/quantities/list.hpp"
#include "bench/world/motion/rest.hpp"

namespace canhil::checks {
namespace {

constexpr std::int64_t second_us = 1'000'000;

// Answers every 100 ms for 10 s. There is a truth up to 2 s, and an answer `silent_s` after that is the next.
Finding judged(double from_s, double to_s, std::int64_t silent_s = 0) {
  quantities::Track track{.quantity = &quantities::attitude_heading,
                          .longest_wait_us = 1.1 * second_us,
                          .answers_end_us = 10 * second_us};
  for (std::int64_t t_us = 0; t_us <= 10 * second_us; t_us += 100'000) {
    if (t_us <= 2 * second_us)
      track.points.push_back({.t_us = t_us, .value = 0.001});
    else if (t_us > (2 + silent_s) * second_us)
      track.without_truth.push_back(t_us);
  }
  static const world::FlightRecord rest{{.start = {}, .motion = world::Rest{}}, 10 * second_us, 100'000};
  const Observations seen;
  Evidence evidence{.seen = seen, .truth = {.flight = rest, .duration_us = 10 * second_us}};
  evidence.tracks.push_back({.estimator = "it", .track = std::move(track)});
  const Error rule{.judged = {.estimator = "it", .quantity = &quantities::attitude_heading},
                   .statistic = Error::Statistic::max,
                   .stretch = {.window = {.from_us = std::llround(from_s * second_us),
                                          .to_us = std::llround(to_s * second_us)}},
                   .below = 0.01,
                   .unit = quantities::attitude_heading.unit};
  return rule.judge(evidence);
}

TEST(NoTruth, IsNotSilence) { EXPECT_EQ(judged(0, 10).outcome, Outcome::pass); }

TEST(NoTruth, InTheWholeWindowIsNotMeasured) {
  const Finding finding = judged(5, 8);
  EXPECT_EQ(finding.outcome, Outcome::not_measured);
  EXPECT_EQ(finding.measured, "the truth has no value there");
}

TEST(NoTruth, DoesNotHideSilence) {
  EXPECT_EQ(judged(0, 10, 3).outcome, Outcome::fail);
  EXPECT_EQ(judged(2, 8, 8).outcome, Outcome::fail);
  EXPECT_EQ(judged(3, 8, 9).outcome, Outcome::fail);
}

TEST(NoTruth, OfAWindowBetweenTwoAnswersIsNotMeasured) {
  EXPECT_EQ(judged(1.01, 1.09).outcome, Outcome::not_measured);
  EXPECT_EQ(judged(1.01, 1.09).measured, "the window is shorter than the time between two answers");
  EXPECT_EQ(judged(1.01, 1.11).outcome, Outcome::pass);
}

TEST(NoTruth, OfAWindowWithinASilenceFails) {
  EXPECT_EQ(judged(4.0, 4.5, 3).outcome, Outcome::fail);
  EXPECT_EQ(judged(4.0, 4.05, 3).outcome, Outcome::fail);
  EXPECT_EQ(judged(9.0, 9.05, 9).outcome, Outcome::fail);
}

}  // namespace
}  // namespace canhil::checks
