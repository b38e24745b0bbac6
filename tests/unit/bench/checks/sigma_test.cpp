// The check of the sigmas that a target sends.
#include "bench/checks/kinds/sigma.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "bench/quantities/list.hpp"
#include "tests/unit/bench/checks/judged.hpp"
#include "tests/unit/bench/edited.hpp"

namespace canhil::checks {
namespace {

// 4 s of answers, ten per second, with sigmas from 0.2 to 0.3 mrad; the tests change the sigmas.
class SigmaCheck : public testing::Test {
 protected:
  static constexpr std::int64_t second_us = 1'000'000;

  SigmaCheck() {
    track_.quantity = &quantities::attitude_heading;
    track_.longest_wait_us = static_cast<double>(second_us);
    track_.answers_end_us = 4 * second_us;
    for (int k = 1; k <= 40; ++k)
      track_.points.push_back({.t_us = k * second_us / 10, .value = 1, .sigma = k == 21 ? 0.3e-3 : 0.2e-3});
  }
  [[nodiscard]] Finding judge(double low_mrad, double high_mrad, std::int64_t from_us = 0) const {
    static const world::FlightRecord rest{{.start = {}, .motion = world::Rest{}}, 4 * second_us, 10'000};
    const Observations seen;
    const Evidence evidence{.seen = seen, .truth = {.flight = rest}, .tracks = {{"one", track_}}};
    return Sigma{.judged = {.estimator = "one", .quantity = &quantities::attitude_heading},
                 .stretch = {.window = {.from_us = from_us, .to_us = 4 * second_us}},
                 .low = low_mrad * 1e-3,
                 .high = high_mrad * 1e-3,
                 .unit = quantities::mrad}
        .judge(evidence);
  }
  quantities::Track track_;
};

TEST_F(SigmaCheck, EachSigmaOfTheWindowLiesBetween) {
  EXPECT_EQ(judge(0.15, 0.35).outcome, Outcome::pass);
  EXPECT_EQ(judge(0.15, 0.35).measured, "0.200 to 0.300 mrad of 40");
  EXPECT_EQ(judge(0.15, 0.35).expected.text, "sigma between 0.15 and 0.35 mrad from 0 to 4 s");
  EXPECT_EQ(judge(0.15, 0.25).outcome, Outcome::fail) << "one is above";
  EXPECT_EQ(judge(0.25, 0.35).outcome, Outcome::fail) << "all but one are below";
  EXPECT_EQ(judge(0.15, 0.25, 3 * second_us).outcome, Outcome::pass) << "the one is before the window";
}

TEST_F(SigmaCheck, HalfOrTwiceASigmaFails) {
  for (const double factor : {0.5, 2.0}) {
    for (auto& point : test::Edited(track_.points)) point.sigma = factor * 0.2e-3;
    EXPECT_EQ(judge(0.14, 0.28).outcome, Outcome::fail) << factor;
  }
}

TEST_F(SigmaCheck, WhatIsNotReportedOrNoNumberNeverPasses) {
  track_.points[30].sigma = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(judge(0, 9).outcome, Outcome::fail);
  track_.points[30].sigma.reset();
  EXPECT_EQ(judge(0, 9).outcome, Outcome::fail);
  EXPECT_EQ(judge(0, 9).measured, "1 of 40 answers have no sigma");
  test::Edited(track_.points).erase(20, 35);
  EXPECT_EQ(judge(0, 9).measured, "no answers from 2 to 3.6 s");
  track_.points = {};
  EXPECT_EQ(judge(0, 9).measured, "no answers");
  EXPECT_EQ(judge(0, 9).outcome, Outcome::fail);
}

}  // namespace
}  // namespace canhil::checks
