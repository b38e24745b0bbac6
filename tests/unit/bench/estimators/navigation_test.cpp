
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "bench/estimators/transfer_alignment/answers.hpp"
#include "bench/quantities/track.hpp"
#include "bench/world/motion/rest.hpp"

namespace canhil::estimators {
namespace {

using testing::SizeIs;
using world::Vector3;

world::FlightRecord at_rest(double heading = 0) {
  return {
      {.start = {}, .motion = world::Rest{{.roll = 0, .pitch = 0, .heading = heading}}}, 1'000'000, 10'000};
}

TEST(NavigationErrors, AreEstimatedLessTrueAndWrapped) {
  const auto truth = at_rest(std::numbers::pi - 0.01);
  checks::Observations seen;
  seen.of<TransferAnswers>().navigation.push_back(
      {.cause_us = 10'000,
       .angles = {.roll = 0.02, .pitch = 0, .heading = -std::numbers::pi + 0.01},
       .v_eb_n = Vector3(0, 3, 0)});
  seen.of<TransferAnswers>().navigation.push_back(
      {.cause_us = 1'010'000, .angles = {}});  // after the end of the truth
  const auto errors = seen.of<TransferAnswers>().navigation.errors(truth);
  ASSERT_THAT(errors, SizeIs(1));
  EXPECT_NEAR(errors[0].angles.heading, 0.02, 1e-12);
  EXPECT_NEAR(errors[0].angles.roll, 0.02, 1e-12);
  EXPECT_NEAR(errors[0].v_eb_n.y(), 3, 1e-12);
}

// The errors are kept from one call to the next, so they must follow the answers and the truth.
TEST(NavigationErrors, FollowTheAnswersAndTheTruth) {
  const auto north = at_rest(0), east = at_rest(std::numbers::pi / 2);
  NavigationAnswers navigation;
  const auto heading = [&](const auto& truth) { return navigation.errors(truth).front().angles.heading; };
  navigation.push_back({.cause_us = 20'000, .angles = {.roll = 0, .pitch = 0, .heading = 0.1}});
  EXPECT_NEAR(heading(north), 0.1, 1e-12);
  EXPECT_EQ(&navigation.errors(north).front(), &navigation.errors(north).front());
  EXPECT_NEAR(heading(east), 0.1 - std::numbers::pi / 2, 1e-12);
  navigation.push_back({.cause_us = 10'000, .angles = {.roll = 0, .pitch = 0, .heading = 0.2}});  // late
  ASSERT_THAT(navigation.errors(east), SizeIs(2));
  EXPECT_NEAR(heading(east), 0.2 - std::numbers::pi / 2, 1e-12);
  navigation.back().angles.heading = 0.3;
  EXPECT_NEAR(navigation.errors(east).back().angles.heading, 0.3 - std::numbers::pi / 2, 1e-12);
}

TEST(AttitudeNees, IsTheSquareOfTheErrorInUnitsOfItsCovariance) {
  EXPECT_NEAR(nees({0.01, -0.04, 0.15}, {0.01, 0.02, 0.05}, Vector3::Zero()), 1 + 4 + 9, 1e-9);
}

TEST(AttitudeNees, KnowsWhichCorrelationIsWhich) {
  // For a strongly correlated pair, a phi along the principal axis is likely, a phi across it is unlikely.
  const double r = 0.96;
  for (int pair = 0; pair < 3; ++pair) {
    Vector3 correlation = Vector3::Zero();
    correlation(pair) = r;  // north-east, north-down, east-down
    const int i = pair == 2 ? 1 : 0;
    const int j = pair == 0 ? 1 : 2;
    Vector3 along = Vector3::Zero();
    along(i) = along(j) = 1;
    Vector3 across = along;
    across(j) = -1;
    EXPECT_NEAR(nees(along, Vector3::Ones(), correlation), 2 / (1 + r), 1e-9);
    EXPECT_NEAR(nees(across, Vector3::Ones(), correlation), 2 / (1 - r), 1e-9);
  }
}

TEST(AttitudeNees, TakesTheFirstAnswerThatKnewOfTheUpdate) {
  const auto truth = at_rest(0);
  TransferAnswers answers;
  for (const std::int64_t t_us : {10'000, 20'000, 30'000, 40'000, 2'000'000})  // the last one after the truth
    answers.navigation.push_back(
        {.cause_us = t_us, .angles = {.roll = 0, .pitch = 0, .heading = 1e-6 * static_cast<double>(t_us)}});
  answers.filter.push_back(
      {.cause_us = 10'000, .navigation_us = 10'000, .attitude_sigma = Vector3::Constant(0.01)});
  const auto value = [&] { return nees_of(answers, truth)[0].value; };
  EXPECT_NEAR(value(), 4, 1e-6);
  answers.filter[0].navigation_us = 30'000;  // the fix arrived late, so earlier answers do not include it
  EXPECT_NEAR(value(), 16, 1e-6);
  answers.filter[0].navigation_us = 40'000;
  EXPECT_THAT(nees_of(answers, truth), SizeIs(0));
}

TEST(AttitudeNees, ACovarianceThatIsNoneExplainsNothing) {
  EXPECT_TRUE(std::isinf(nees(Vector3::Zero(), {0.01, 0, 0.05}, Vector3::Zero())));
}

std::optional<std::int64_t> entered(const Spool<NavigationError>& errors, double within) {
  return quantities::entered_for_good_us(errors, within,
                                         [](const NavigationError& e) { return e.angles.heading; });
}

TEST(Convergence, IsWhenTheErrorEntersTheBandForGood) {
  Spool<NavigationError> errors;
  for (const double heading : {0.5, 0.05, 0.2, -0.1, 0.05, -0.09})
    errors.push_back({.t_us = static_cast<std::int64_t>(errors.size()), .angles = {.heading = heading}});
  EXPECT_EQ(entered(errors, 0.1), 3);
  EXPECT_EQ(entered(errors, 1), 0);
  EXPECT_EQ(entered(errors, 0.08), std::nullopt);
  EXPECT_EQ(entered({}, 1), std::nullopt);
  errors.push_back({.t_us = 6, .angles = {.heading = std::nan("")}});
  EXPECT_EQ(entered(errors, 1), std::nullopt);
}

}  // namespace
}  // namespace canhil::estimators
