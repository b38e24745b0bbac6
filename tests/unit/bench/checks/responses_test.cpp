// Checks of the required responses to faults: what passes and what fails. Silence does not pass.
#include <gmock/gmock.h>

#include <limits>

#include "bench/checks/kinds/answering.hpp"
#include "bench/checks/kinds/detected_within.hpp"
#include "bench/checks/kinds/honest.hpp"
#include "bench/checks/kinds/recovers_within.hpp"
#include "bench/checks/kinds/sigma_grows.hpp"
#include "bench/drive/contract.hpp"
#include "bench/estimators/transfer_alignment/answers.hpp"
#include "bench/estimators/transfer_alignment/quantities.hpp"
#include "bench/estimators/transfer_alignment/transfer_alignment.hpp"
#include "dbc/files/text_file.hpp"
#include "tests/unit/bench/checks/judged.hpp"
#include "tests/unit/bench/edited.hpp"

namespace canhil::checks {
namespace {

using namespace estimators;

using testing::HasSubstr;

constexpr std::int64_t second_us = 1'000'000, duration_us = 20 * second_us;
constexpr scenario::Window faulty{.from_us = 8 * second_us, .to_us = 10 * second_us};

// 20 s at rest with perfect answers, ten per second, and a fault from 8 to 10 s; the tests set the
// consequences of the fault.
class Disturbed : public testing::Test {
 protected:
  Disturbed() {
    for (std::int64_t t_us = 100'000; t_us <= duration_us; t_us += 100'000) {
      answers().navigation.push_back({.cause_us = t_us, .angles = {}});
      answers().filter.push_back({.cause_us = t_us,
                                  .navigation_us = t_us - 100'000,
                                  .nis = 3,
                                  .attitude_sigma = world::Vector3::Constant(1e-3)});
      seen_.complaints.hear(messages::TargetHeartbeat{}, t_us);
    }
  }
  TransferAnswers& answers() { return seen_.of<TransferAnswers>(); }
  static std::size_t place(double t_s) { return static_cast<std::size_t>(std::lround(t_s * 10)) - 1; }
  void degraded(double from_s, double to_s) {
    for (std::size_t i = place(from_s); i <= place(to_s); ++i) answers().filter[i].degraded = true;
  }
  template <class Rule>
  CheckResult judge(const Rule& rule) {
    return judged(rule, seen_, {.flight = truth_, .duration_us = duration_us});
  }

  static constexpr const Estimator* one = &transfer_alignment;
  const Disturbance fault_{.fault = "it", .window = faulty, .valid_from_us = faulty.from_us};
  world::FlightRecord truth_{{.start = {}, .motion = world::Rest{}}, duration_us, 10'000};
  Observations seen_;
};

TEST_F(Disturbed, DetectedByTheFirstSignThatIsNew) {
  const DetectedWithin rule{.disturbance = fault_, .within_us = second_us, .by = {}};
  EXPECT_EQ(judge(rule).outcome, Outcome::fail) << "nobody said anything";
  EXPECT_EQ(judge(rule).measured, "no sign");
  degraded(8.5, 9);
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  EXPECT_EQ(judge(rule).measured, "after 0.500 s: degraded in an answer");
  EXPECT_EQ(judge(rule).expected, "a sign within 1 s of fault 'it'");
}

TEST_F(Disturbed, DetectedTooLateFails) {
  degraded(9.5, 9.8);
  EXPECT_EQ(judge(DetectedWithin{.disturbance = fault_, .within_us = second_us, .by = {}}).outcome,
            Outcome::fail);
  EXPECT_EQ(judge(DetectedWithin{.disturbance = fault_, .within_us = 2 * second_us, .by = {}}).outcome,
            Outcome::pass);
}

TEST_F(Disturbed, WhatWasSaidJustBeforeIsNoDetection) {
  degraded(7, 12);
  for (const std::vector<std::string>& by : {std::vector<std::string>(), {"degraded"}}) {
    const CheckResult result = judge(DetectedWithin{.disturbance = fault_, .within_us = second_us, .by = by});
    EXPECT_EQ(result.outcome, Outcome::not_measured);
    EXPECT_EQ(result.measured, "already present before it: degraded in an answer");
  }
}

TEST_F(Disturbed, DetectedByHeartbeatOrCounterToo) {
  const DetectedWithin any{.disturbance = fault_, .within_us = second_us, .by = {}};
  const DetectedWithin counted{.disturbance = fault_, .within_us = second_us, .by = {"bad_crc"}};
  seen_.complaints.hear(messages::TargetCounters{.bad_crc = 3}, 2 * second_us);
  seen_.complaints.hear(messages::TargetCounters{.bad_crc = 3}, 8'200'000);
  EXPECT_EQ(judge(counted).outcome, Outcome::fail) << "it was counted before";
  seen_.complaints.hear(messages::TargetHeartbeat{.error_input_lost = 1}, 8'600'000);
  EXPECT_EQ(judge(any).measured, "after 0.600 s: input_lost in a heartbeat");
  EXPECT_EQ(judge(counted).outcome, Outcome::fail) << "it is another sign";
  seen_.complaints.hear(messages::TargetCounters{.bad_crc = 4}, 8'700'000);
  EXPECT_EQ(judge(counted).measured, "after 0.700 s: bad_crc in a counter");
}

TEST_F(Disturbed, RecoversWhenTheSignsAreGoneForGood) {
  const RecoversWithin rule{.disturbance = fault_,
                            .within_us = second_us,
                            .by = {},
                            .answering = always_reported(transfer_alignment)};
  EXPECT_EQ(judge(rule).outcome, Outcome::not_measured) << "there was nothing to recover from";
  degraded(8.5, 10.6);
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  EXPECT_EQ(judge(rule).measured, "last sign 0.600 s after: degraded in an answer");
  degraded(15, 15);
  EXPECT_EQ(judge(rule).outcome, Outcome::fail) << "it came back";
}

TEST_F(Disturbed, RecoversWithASmallErrorAndNotBySilence) {
  RecoversWithin rule{.disturbance = fault_,
                      .within_us = second_us,
                      .by = {},
                      .error = Subject{.estimator = "transfer_alignment",
                                       .quantity = &quantities::velocity_north,
                                       .text = "velocity.north"},
                      .below = 0.1,
                      .unit = quantities::mps,
                      .answering = always_reported(transfer_alignment)};
  answers().navigation[place(10.5)].v_eb_n = {0.3, 0, 0};
  EXPECT_EQ(judge(rule).outcome, Outcome::pass) << judge(rule).measured;
  EXPECT_THAT(judge(rule).measured, HasSubstr("below from 0.500 s after"));
  answers().navigation[place(14)].v_eb_n = {0.3, 0, 0};
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
  std::erase_if(*test::Edited(answers().navigation),
                [](const auto& answer) { return answer.cause_us > 12 * second_us; });
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
  EXPECT_THAT(judge(rule).measured, HasSubstr("no answers from 12 to 20 s"));
}

TEST_F(Disturbed, SigmaGrowsThroughTheFault) {
  SigmaGrows rule{.judged = {.estimator = "transfer_alignment", .quantity = &quantities::attitude_heading},
                  .fault = "it",
                  .window = faulty};
  EXPECT_EQ(judge(rule).outcome, Outcome::fail) << "it stands still";
  for (std::size_t i = place(8); i <= place(10); ++i)
    answers().filter[i].attitude_sigma.z() = 1e-3 * (1 + 0.1 * static_cast<double>(i - place(8)));
  EXPECT_EQ(judge(rule).outcome, Outcome::pass) << judge(rule).measured;
  EXPECT_THAT(judge(rule).measured, HasSubstr("1.000 to "));
  rule.by = 4;
  EXPECT_EQ(judge(rule).outcome, Outcome::fail) << "not as much as asked";
  rule.by = 1;
  const auto in_it = [](const auto& answer) {
    return answer.cause_us > faulty.from_us && answer.cause_us <= faulty.to_us;
  };
  std::erase_if(*test::Edited(answers().filter), in_it);
  std::erase_if(*test::Edited(answers().navigation), in_it);
  EXPECT_EQ(judge(rule).measured, "no sigma is reported in it");
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
}

TEST_F(Disturbed, HonestUnlessSureAndWrong) {
  const Honest rule{.estimators = {one}, .named = {}};
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  answers().navigation[place(9)].angles.heading = 4.9e-3;
  EXPECT_EQ(judge(rule).outcome, Outcome::pass) << judge(rule).measured;
  answers().navigation[place(9)].angles.heading = 8e-3;
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
  EXPECT_THAT(judge(rule).measured, HasSubstr("8.00 sigma at"));
  degraded(8.5, 9.5);
  EXPECT_EQ(judge(rule).outcome, Outcome::pass) << "it says so";
  degraded(0.1, 20);
  answers().filter = {};
  EXPECT_EQ(judge(rule).outcome, Outcome::fail) << "silence is no honesty";
}

TEST_F(Disturbed, AnsweringWithNumbersAndWithoutAGap) {
  const Answering rule{.judged = always_reported(transfer_alignment)};
  seen_.faults.push_back({.name = "it", .window = faulty, .valid_from_us = faulty.from_us, .count = 1});
  EXPECT_EQ(judge(rule).outcome, Outcome::pass) << judge(rule).measured;
  const Observations sound = seen_;
  std::erase_if(*test::Edited(answers().navigation),
                [](const auto& answer) { return within(faulty, answer.cause_us); });
  EXPECT_EQ(judge(rule).outcome, Outcome::pass) << "a fault may leave nothing to be answered";
  std::erase_if(*test::Edited(answers().navigation), [](const auto& answer) {
    return within({faulty.to_us, 12 * second_us}, answer.cause_us);
  });
  EXPECT_EQ(judge(rule).outcome, Outcome::fail) << "after it there is";
  EXPECT_THAT(judge(rule).measured, HasSubstr("no answers"));
  seen_ = sound;
  answers().navigation[place(5)].v_eb_n.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(judge(rule).measured,
            "velocity.north: 1 of 200 answers are not a number (NaN or infinite), first at 5 s");
  seen_ = sound;
  seen_.from_target.front().wrong_crc = 1;
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
  seen_ = sound;
  seen_.complaints.end(22 * second_us);
  EXPECT_EQ(judge(rule).measured, "no heartbeat from 20 to 22 s");
  seen_ = Observations();
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
}

TEST(Without, CutsStretchesOut) {
  const auto left = without({.from_us = 0, .to_us = 10}, {{4, 6}, {-2, 1}, {5, 7}, {9, 12}});
  ASSERT_EQ(left.size(), 2U);
  EXPECT_EQ(left[0].from_us, 1);
  EXPECT_EQ(left[0].to_us, 4);
  EXPECT_EQ(left[1].from_us, 7);
  EXPECT_EQ(left[1].to_us, 9);
}

// The error message when a scenario with this check is read, "" if there is none.
std::string error_of_check(const std::string& check) {
  static const std::string flight = *read_text_file(SOURCE_DIR "/bench/flights/transfer_alignment_quick.toml",
                                                    "a scenario file", 1U << 20U);
  const auto read = drive::parse_scenario(flight + R"(
[[fault]]
name = "master away"
kind = "lost"
messages = ["MasterInsVelocityNE"]
from_s = 1
to_s = 1.5
[[check]]
)" + check,
                                          "it.toml");
  return read ? "" : read.error().message;
}

TEST(ResponseChecks, AreReadWithTheFaultThatTheyName) {
  EXPECT_EQ(
      error_of_check("kind = 'detected_within'\nfault = 'master away'\nwithin_s = 1\nby = ['degraded']"), "");
  EXPECT_EQ(error_of_check("kind = 'detected_within'\nfrom_s = 1\nwithin_s = 1"), "");
  EXPECT_EQ(error_of_check("kind = 'recovers_within'\nfault = 'master away'\nwithin_s = 1\n"
                           "quantity = 'attitude.heading'\nbelow_mrad = 3"),
            "");
  EXPECT_EQ(
      error_of_check("kind = 'sigma_grows'\nquantity = 'attitude.heading'\nfault = 'master away'\nby = 1.1"),
      "");
  EXPECT_EQ(error_of_check("kind = 'honest'"), "");
  EXPECT_EQ(error_of_check("kind = 'answering'"), "");
}

TEST(ResponseChecks, RefuseWhatCannotBe) {
  EXPECT_THAT(error_of_check("kind = 'detected_within'\nfault = 'gps away'\nwithin_s = 1"),
              HasSubstr("'gps away' is unknown, expected one of: master away"));
  EXPECT_THAT(error_of_check("kind = 'detected_within'\nfault = 'master away'\nfrom_s = 3\nwithin_s = 1"),
              HasSubstr("from_s': has no effect beside fault"));
  EXPECT_THAT(error_of_check("kind = 'detected_within'\nfault = 'master away'\nwithin_s = 100"),
              HasSubstr("within_s': after 1 s ends after the run, expected less than"));
  EXPECT_THAT(error_of_check("kind = 'detected_within'\nfrom_s = 1\nwithin_s = 1\nby = ['degrade']"),
              HasSubstr("'degrade' is unknown, expected 'degraded'"));
  EXPECT_THAT(error_of_check("kind = 'sigma_grows'\nquantity = 'attitude.heading'\nby = 0.5"),
              HasSubstr("by': 0.5 is out of range"));
  EXPECT_THAT(error_of_check("kind = 'honest'\nestimator = 'wind'"), HasSubstr("'wind' is unknown"));
}

}  // namespace
}  // namespace canhil::checks
