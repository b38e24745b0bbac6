// Wind answers compared with the truth of a glider.

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "bench/checks/kinds/answers.hpp"
#include "bench/checks/kinds/consistency.hpp"
#include "bench/estimators/wind/answers.hpp"
#include "bench/estimators/wind/quantities.hpp"
#include "dbc/wire/transmit.hpp"
#include "tests/unit/bench/checks/judged.hpp"
#include "tests/unit/bench/edited.hpp"
#include "tests/unit/bench/plant/glide/flown.hpp"

namespace canhil::checks {
namespace {

using namespace estimators;

using messages::WindOutcome;
using enum Error::Statistic;
using quantities::wind_cross;
using quantities::wind_down;
using quantities::wind_norm;
using testing::HasSubstr;
using world::Vector3;

constexpr std::int64_t duration_us = 10'000'000;
constexpr scenario::Window whole{.from_us = 0, .to_us = duration_us};

plant::glide::Settings heading_east() {
  plant::glide::Settings plan;
  plan.heading = 1.5707963267948966;
  return plan;
}

// 10 s of a glide to the east with perfect answers every 20 ms; the tests change the answers.
class Winds : public testing::Test {
 protected:
  Winds() {
    for (std::int64_t t_us = 20'000; t_us <= duration_us; t_us += 20'000) {
      seen_.stimuli["GliderNav"].add(t_us);
      WindAnswer answer{.cause_us = t_us, .started = true, .outcome = WindOutcome::updated};
      answer.wind_n = glide_.at(t_us).wind_n;
      answer.speed = answer.wind_n.head<2>().norm();
      answer.from = std::atan2(-answer.wind_n.y(), -answer.wind_n.x());
      answer.sigma = Vector3::Ones();
      answer.nis = 9;
      seen_.of<WindAnswers>().push_back(answer);
    }
  }
  template <class Rule>
  CheckResult judge(const Rule& rule) {
    return judged(rule, seen_, {.flight = rest_, .duration_us = duration_us, .plants = {&glide_.record()}});
  }
  CheckResult error(const quantities::Quantity& quantity, Error::Statistic statistic, double below) {
    return judge(error_of("wind", quantity, whole, below, statistic));
  }
  CheckResult consistency(const quantities::Quantity& quantity,
                          std::variant<MeanBetween, Probability> bound) {
    return judge(
        Consistency{.judged = {.estimator = "wind", .quantity = &quantity}, .window = whole, .bound = bound});
  }

  plant::glide::Flown glide_{heading_east(), duration_us};
  TrueAir air_ = TrueAir::find({&glide_.record()}, true_air).value();
  world::FlightRecord rest_{{.start = {}, .motion = world::Rest{}}, duration_us, 20'000};
  Observations seen_;
};

TEST_F(Winds, ErrorsAreAlongAndAcrossTheAirVelocity) {
  seen_.of<WindAnswers>()[100].wind_n += Vector3(0, 3, 0);   // an error to the east: along the track
  seen_.of<WindAnswers>()[200].wind_n += Vector3(-2, 0, 0);  // an error to the south: to the right
  seen_.of<WindAnswers>()[300].wind_n += Vector3(0, 0, -1);
  const auto errors = wind_errors(seen_.of<WindAnswers>(), air_);
  EXPECT_NEAR(errors[100].along_track, 3, 0.01);  // the glider weathercocks by a fraction of a degree
  EXPECT_NEAR(errors[100].cross_track, 0, 0.1);
  EXPECT_NEAR(errors[200].cross_track, 2, 0.01);
  EXPECT_NEAR(errors[300].error_n.z(), -1, 1e-12);
}

TEST_F(Winds, TheLargestAndTheMeanErrorAreJudged) {
  EXPECT_EQ(error(wind_norm, max, 1e-6).outcome, Outcome::pass);
  seen_.of<WindAnswers>()[100].wind_n.z() -= 5;
  EXPECT_EQ(error(wind_norm, max, 4.9).outcome, Outcome::fail);
  EXPECT_EQ(error(wind_down, max, 5.1).outcome, Outcome::pass);
  EXPECT_EQ(error(wind_down, mean, 0.009).outcome, Outcome::fail);  // the mean is 5 / 500
  EXPECT_EQ(error(wind_down, mean, 0.011).outcome, Outcome::pass);
  EXPECT_EQ(error(wind_cross, max, 1e-6).outcome, Outcome::pass);
}

TEST_F(Winds, SpeedAndDirectionAreJudgedAsTheTargetReportsThem) {
  using quantities::wind_from, quantities::wind_speed;
  constexpr double degree = std::numbers::pi / 180;
  WindAnswer& answer = seen_.of<WindAnswers>()[100];
  answer.from += 2 * std::numbers::pi;  // the same direction
  EXPECT_EQ(error(wind_speed, max, 1e-6).outcome, Outcome::pass);
  EXPECT_EQ(error(wind_from, max, 1e-6).outcome, Outcome::pass);
  answer.speed += 0.5;
  EXPECT_EQ(error(wind_speed, max, 0.49).outcome, Outcome::fail);
  EXPECT_EQ(error(wind_speed, max, 0.51).outcome, Outcome::pass);
  answer.from += std::numbers::pi;  // where it blows to
  EXPECT_EQ(error(wind_from, max, 179 * degree).outcome, Outcome::fail);
}

TEST_F(Winds, SilenceAndNansNeverPass) {
  seen_.of<WindAnswers>()[100].wind_n.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error(wind_norm, mean, 1e9).outcome, Outcome::fail);
  EXPECT_EQ(error(wind_norm, max, 1e9).outcome, Outcome::fail);
  test::Edited(seen_.of<WindAnswers>()).erase(90, 150);  // removes 1.2 s of answers
  EXPECT_THAT(error(wind_norm, max, 1).measured, HasSubstr("no answers from 1.8 to 3.02 s"));
  seen_.of<WindAnswers>() = {};
  EXPECT_EQ(error(wind_norm, max, 1).measured, "no answers");
  EXPECT_EQ(judge(Answers{.estimator = "wind", .window = whole, .counts = {}}).outcome, Outcome::fail);
}

TEST_F(Winds, AFilterThatWaitsHasNoError) {
  for (WindAnswer& answer : test::Edited(seen_.of<WindAnswers>())) answer.started = false;
  EXPECT_TRUE(wind_errors(seen_.of<WindAnswers>(), air_).empty());
}

TEST_F(Winds, NeesTakesTheCorrelationIn) {
  seen_.of<WindAnswers>()[0].wind_n += Vector3(1, 2, 3);
  seen_.of<WindAnswers>()[0].sigma = {1, 2, 3};
  EXPECT_NEAR(nees_of(seen_.of<WindAnswers>(), air_)[0].value, 3, 1e-9);
  seen_.of<WindAnswers>()[0].correlation = {0.5, 0, 0};
  EXPECT_NEAR(nees_of(seen_.of<WindAnswers>(), air_)[0].value, 2.0 / 1.5 + 1,
              1e-9);  // (1 + 1 - 2 r) / (1 - r^2), plus 1 for down
}

TEST_F(Winds, ACovarianceThatIsNoneExplainsNothing) {
  seen_.of<WindAnswers>()[0].wind_n += Vector3(1, -1, 0);
  // Not positive definite: no three quantities have these correlations.
  seen_.of<WindAnswers>()[0].correlation = {0.9, 0.9, -0.9};
  EXPECT_TRUE(std::isinf(nees_of(seen_.of<WindAnswers>(), air_)[0].value));
  EXPECT_EQ(consistency(quantities::wind_nees, MeanBetween{.low = 0, .high = 1e9}).outcome, Outcome::fail);
}

TEST_F(Winds, SilenceIsTwoPeriodsOfTheNavigationIfThatIsLonger) {
  seen_.stimuli.clear();
  for (std::int64_t t_us = 0; t_us <= duration_us; t_us += 1'000'000) seen_.stimuli["GliderNav"].add(t_us);
  std::erase_if(*test::Edited(seen_.of<WindAnswers>()),
                [](const WindAnswer& answer) { return answer.cause_us % 1'000'000 != 0; });
  std::erase_if(*test::Edited(seen_.of<WindAnswers>()),
                [](const WindAnswer& answer) { return answer.cause_us == 3'000'000; });
  EXPECT_EQ(error(wind_norm, max, 1).outcome, Outcome::pass) << "one was lost";
  std::erase_if(*test::Edited(seen_.of<WindAnswers>()),
                [](const WindAnswer& answer) { return answer.cause_us == 4'000'000; });
  EXPECT_THAT(error(wind_norm, max, 1).measured, HasSubstr("no answers from 2 to 5 s"));
}

TEST_F(Winds, NisIsOfNineDegreesOfFreedom) {
  const auto consistent = [&] {
    return consistency(quantities::wind_nis, Probability{.value = 0.999}).outcome;
  };
  EXPECT_EQ(consistent(), Outcome::pass);
  for (WindAnswer& answer : test::Edited(seen_.of<WindAnswers>())) answer.nis = 3;
  EXPECT_EQ(consistent(), Outcome::fail);
  for (WindAnswer& answer : test::Edited(seen_.of<WindAnswers>())) answer.outcome = WindOutcome::coasting;
  EXPECT_TRUE(nis_of(seen_.of<WindAnswers>()).empty());
}

TEST_F(Winds, AnswersAreCountedByOutcomeAndFlag) {
  for (std::size_t i = 0; i < 7; ++i) seen_.of<WindAnswers>()[i].fins_late = true;
  for (std::size_t i = 0; i < 3; ++i) seen_.of<WindAnswers>()[i].outcome = WindOutcome::coasting;
  const auto counted = [&](const char* mark, std::int64_t least, std::int64_t most) {
    return judge(Answers{.estimator = "wind",
                         .window = whole,
                         .counts = {{.mark = mark, .at_least = least, .at_most = most}}})
        .outcome;
  };
  EXPECT_EQ(counted("coasting", 3, 3), Outcome::pass);
  EXPECT_EQ(counted("coasting", 0, 2), Outcome::fail);
  EXPECT_EQ(counted("updated", 498, 600), Outcome::fail);
  EXPECT_EQ(counted("fins_late", 7, 7), Outcome::pass);
  EXPECT_EQ(counted("outside", 1, 7), Outcome::fail);
}

}  // namespace
}  // namespace canhil::checks
