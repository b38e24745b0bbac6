// LOS rates, their consistency and the miss distance, compared with an engagement.

#include <gmock/gmock.h>

#include "bench/checks/kinds/answers.hpp"
#include "bench/checks/kinds/consistency.hpp"
#include "bench/estimators/los_rate/answers.hpp"
#include "bench/estimators/los_rate/miss_distance.hpp"
#include "bench/estimators/los_rate/quantities.hpp"
#include "tests/unit/bench/checks/fly_past.hpp"
#include "tests/unit/bench/checks/judged.hpp"
#include "tests/unit/bench/edited.hpp"

namespace canhil::checks {
namespace {

using namespace estimators;

using messages::LosRateOutcome;
using testing::HasSubstr;

// Each sample of the fly-past is answered without error; the tests change the run.
class Engaged : public FlyPast {
 protected:
  Engaged() {
    for (const Flown::Sample& epoch : flight_.epochs) {
      LosAnswer answer;
      answer.cause_us = epoch.t_us;
      answer.outcome = LosRateOutcome::updated;
      answer.rate = epoch.los_rate;
      answer.nis = 2;
      seen_.of<LosAnswers>().push_back(answer);
      seen_.stimuli["Seeker"].add(epoch.t_us);
    }
  }
  template <class Rule>
  CheckResult judge(const Rule& rule) {
    estimators::Truth known = truth();
    if (!present_) known.plants.clear();
    return judged(rule, seen_, known);
  }
  LosAnswer& answer_at(double to_go) {
    return seen_.of<LosAnswers>()[static_cast<std::size_t>(std::lround((5 - to_go) * 100)) - 1];
  }
  static Error error_rule(const quantities::Quantity& quantity, Error::Statistic statistic) {
    Error rule = error_of("los_rate", quantity, {.from_us = 0, .to_us = duration_us}, 2e-3, statistic);
    rule.stretch.to_go_s = {1, 2};
    return rule;
  }

  bool present_ = true;
  Observations seen_;
};

using enum Error::Statistic;
using estimators::MissDistance;
using quantities::los_rate_both;
using quantities::los_rate_pitch;
using quantities::los_rate_yaw;

TEST_F(Engaged, LosRateErrorByPlaneAndStatistic) {
  answer_at(1.5).rate.yaw += 3e-3;
  EXPECT_EQ(judge(error_rule(los_rate_yaw, max)).outcome, Outcome::fail);
  EXPECT_EQ(judge(error_rule(los_rate_both, max)).measured, "max 3.000 mrad/s of 100");
  EXPECT_EQ(judge(error_rule(los_rate_pitch, max)).outcome, Outcome::pass);
  EXPECT_EQ(judge(error_rule(los_rate_yaw, rms)).measured, "RMS 0.300 mrad/s of 100") << "one of 100";
  for (LosAnswer& answer : test::Edited(seen_.of<LosAnswers>())) answer.rate.pitch += 2.1e-3;
  EXPECT_EQ(judge(error_rule(los_rate_pitch, rms)).outcome, Outcome::fail);
}

TEST_F(Engaged, TheLastAnswerIsJudgedInEachPlane) {
  for (double world::Planes<double>::*plane : {&world::Planes<double>::pitch, &world::Planes<double>::yaw}) {
    answer_at(1.0).rate.*plane += 3e-3;  // the last answer of the window
    EXPECT_EQ(judge(error_rule(los_rate_both, final)).measured, "final 3.000 mrad/s of 100");
    EXPECT_EQ(judge(error_rule(los_rate_both, final)).outcome, Outcome::fail);
    answer_at(1.0).rate.*plane -= 3e-3;
  }
  answer_at(1.01).rate.pitch += 3e-3;
  EXPECT_EQ(judge(error_rule(los_rate_both, final)).outcome, Outcome::pass) << "it is not the last";
}

TEST_F(Engaged, ASampleThatIsAnsweredTwiceCountsOnce) {
  std::vector<LosAnswer> few;
  for (const LosAnswer& answer : seen_.of<LosAnswers>()) {
    if (answer.cause_us % 30'000 == 0) few.insert(few.end(), 2, answer);
  }
  seen_.of<LosAnswers>() = LosAnswers(few);
  EXPECT_EQ(judge(error_rule(los_rate_both, rms)).measured, "answers to 33 of 100 samples");
}

TEST_F(Engaged, TheWindowIsOfTheTimeToGo) {
  answer_at(2.5).rate.yaw += 1;
  answer_at(0.5).rate.yaw += 1;
  EXPECT_EQ(judge(error_rule(los_rate_both, max)).outcome, Outcome::pass);
  answer_at(1.0).rate.yaw += 1;
  EXPECT_EQ(judge(error_rule(los_rate_both, max)).outcome, Outcome::fail) << "its end is in";
}

TEST_F(Engaged, MissingAnswersFail) {
  const auto rule = error_rule(los_rate_both, rms);
  std::erase_if(*test::Edited(seen_.of<LosAnswers>()),
                [](const LosAnswer& answer) { return answer.cause_us % 20'000 == 0; });
  EXPECT_EQ(judge(rule).outcome, Outcome::pass) << "half of the samples may be lost";
  std::erase_if(*test::Edited(seen_.of<LosAnswers>()),
                [](const LosAnswer& answer) { return answer.cause_us == 3'510'000; });
  EXPECT_THAT(judge(rule).measured, HasSubstr("answers to 49 of 100 samples"));
  seen_.of<LosAnswers>() = {};
  EXPECT_THAT(judge(rule).measured, HasSubstr("no answers"));
  flight_.epochs = {};
  EXPECT_THAT(judge(rule).measured, HasSubstr("no samples there"));
}

TEST_F(Engaged, EachSampleIsOwedAnAnswerInWhateverOrderTheSamplesWereSent) {
  auto& owed = seen_.timing.owed[message_index<messages::LosRateTarget>()];
  for (std::size_t i = 0; i < flight_.epochs.size(); ++i)
    owed.push_back(
        {.valid_us = flight_.epochs[std::min(i ^ 1U, flight_.epochs.size() - 1)].t_us, .came = i % 4 != 0});
  const CheckResult found = judge(error_rule(los_rate_both, rms));
  EXPECT_EQ(found.measured, "LosRateTarget: answers to 75 of 100 samples");
  EXPECT_FALSE(found.judgement.measurement.value) << "the RMS of those that came is not that of the window";
  EXPECT_TRUE(found.judgement.criterion.upper);
}

TEST_F(Engaged, AnswersThatAreNoEstimateTellNoRate) {
  for (LosAnswer& answer : test::Edited(seen_.of<LosAnswers>())) answer.outcome = LosRateOutcome::waiting;
  EXPECT_THAT(judge(error_rule(los_rate_both, max)).measured, HasSubstr("no answers"));
}

TEST_F(Engaged, Miss) {
  EXPECT_EQ(judge(MissDistance{.below = 0.51}).outcome, Outcome::pass);
  EXPECT_EQ(judge(MissDistance{.below = 0.5}).outcome, Outcome::fail);
  flight_.miss_n.reset();
  EXPECT_THAT(judge(MissDistance{.below = 1}).measured, HasSubstr("did not pass"));
  present_ = false;
  EXPECT_EQ(judge(MissDistance{.below = 1}).outcome, Outcome::fail);
}

TEST_F(Engaged, ConsistencyIsOfTwoDegreesOfFreedomUntilThePassage) {
  const Consistency rule{.judged = {.estimator = "los_rate", .quantity = &quantities::los_nis},
                         .window = {.from_us = 0, .to_us = duration_us},
                         .bound = Probability{.value = 0.99}};
  EXPECT_EQ(judge(rule).outcome, Outcome::pass) << judge(rule).measured;
  for (LosAnswer& answer : test::Edited(seen_.of<LosAnswers>())) answer.nis = 3;
  EXPECT_EQ(judge(rule).outcome, Outcome::fail) << "consistent with three";
  for (LosAnswer& answer : test::Edited(seen_.of<LosAnswers>())) {
    answer.nis = answer.cause_us > 2'000'000 ? 0 : 2;
    if (answer.cause_us > 2'000'000) answer.outcome = LosRateOutcome::coasting;
  }
  EXPECT_THAT(judge(rule).measured, HasSubstr("no answers from 2")) << "a coast gives no statistic";
}

TEST_F(Engaged, Coasting) {
  const Answers rule{.estimator = "los_rate",
                     .window = {.from_us = 0, .to_us = duration_us},
                     .counts = {{.mark = "coasting", .at_most = 0}}};
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  answer_at(2).outcome = LosRateOutcome::coasting;
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
}

}  // namespace
}  // namespace canhil::checks
