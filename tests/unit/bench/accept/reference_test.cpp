// Tests the allowed deviation of a target's answers from the reference.
#include "bench/accept/reference.hpp"

#include <gmock/gmock.h>

#include "bench/accept/profile.hpp"
#include "bench/observe/values.hpp"
#include "dbc/wire/transmit.hpp"

namespace canhil::accept {
namespace {

using messages::AlignAttitude;
using messages::TargetHeartbeat;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double heading_step_deg = 0.003;

// Collects the answers of a made-up flight. The test sets the heading and the flag `coasting` of each answer.
class Flown {
 public:
  Flown& attitude(double heading_deg, int coasting = 0) {
    sync();
    hear(to_frame(AlignAttitude{.roll_deg = 1,
                                .pitch_deg = 2,
                                .heading_deg = heading_deg,
                                .coasting = static_cast<std::uint8_t>(coasting)},
                  0));
    return *this;
  }
  /// An instant without an answer.
  Flown& pass() {
    sync();
    return *this;
  }
  template <class Message>
  Flown& hear(const Message& message) {
    return hear(to_frame(message, 0));
  }
  Answers answers;

 private:
  Flown& hear(const Frame& frame) {
    answers.received({.frame = frame});
    return *this;
  }
  void sync() {
    answers.transmitted(to_frame(messages::Sync{.time_us = static_cast<std::uint64_t>(t_us_ += 10'000)}, 0),
                        0, 0);
  }
  std::int64_t t_us_ = 0;
};

void fly(Flown& flight, double off_deg, int coasting = 3) {
  for (int i = 0; i < 100; ++i) flight.attitude(0.03 * i + off_deg, i < coasting ? 1 : 0);
}

Reference of(double rounding_deg) {
  Flown rounded, unrounded;
  fly(rounded, 0);
  fly(unrounded, rounding_deg);
  return make_reference(rounded.answers, unrounded.answers, 5);
}

std::string departure_of(const Reference& reference, double off_deg, int coasting = 3, double share = 1) {
  Flown flight;
  fly(flight, off_deg, coasting);
  return departure(reference, flight.answers, share);
}

// Only answers that both flights have at the same time are compared, and headings along the smaller arc.
TEST(Response, IsTheMeanDifferenceOfAnswersAtTheSameTime) {
  Flown there, here;
  there.attitude(179).attitude(10).attitude(20);
  here.attitude(-179);
  here.pass().attitude(23);
  const Series& series = *there.answers.find("AlignAttitude");
  EXPECT_NEAR(*mean_difference(*here.answers.find("AlignAttitude"), series, "heading_deg"), (2 + 3) / 2.0,
              heading_step_deg);
  EXPECT_NEAR(*mean_difference(series, *here.answers.find("AlignAttitude"), "heading_deg"), -2.5,
              heading_step_deg);
  EXPECT_FALSE(mean_difference(series, series, "none"));
  EXPECT_FALSE(
      mean_difference(series, Series{.signals = series.signals, .t_s = {}, .values = {}}, "heading_deg"));
}

TEST(Response, BeginsAtTheFirstAnswerThatDiffers) {
  const auto heading = [](std::initializer_list<double> headings_deg) {
    Flown flown;
    for (const double deg : headings_deg) {
      flown.attitude(deg);
      flown.pass();
    }
    return *flown.answers.find("AlignAttitude");
  };
  const Series there = heading({10, 11, 12});
  const Series late = heading({10, 11, 13}), shorter = heading({10, 11});
  EXPECT_EQ(first_difference(late, there, "heading_deg"), there.t_s[2]);
  EXPECT_EQ(first_difference(shorter, there, "heading_deg"), there.t_s[2]);
  EXPECT_FALSE(first_difference(there, there, "heading_deg"));
  EXPECT_FALSE(first_difference(late, there, "roll_deg"));
  EXPECT_FALSE(first_difference(late, there, "none"));
}

TEST(Reference, IsMetByTheSameAnswers) { EXPECT_THAT(departure_of(of(0), 0), IsEmpty()); }

TEST(Reference, AllowsTwoStepsAtAnInstantButNotInTheMean) {
  const Reference reference = of(0);
  EXPECT_THAT(departure_of(reference, heading_step_deg),
              HasSubstr("AlignAttitude.heading_deg over the flight"));
  Flown one;
  for (int i = 0; i < 100; ++i) one.attitude(0.03 * i + (i == 99 ? 2 * heading_step_deg : 0), i < 3 ? 1 : 0);
  EXPECT_THAT(departure(reference, one.answers), IsEmpty());
  Flown two;
  for (int i = 0; i < 100; ++i) two.attitude(0.03 * i + (i == 99 ? 4 * heading_step_deg : 0), i < 3 ? 1 : 0);
  EXPECT_THAT(departure(reference, two.answers), HasSubstr("AlignAttitude.heading_deg at t=1 s: 2.982 deg"));
}

TEST(Reference, AllowsFourTimesWhatRoundingDid) {
  const Reference reference = of(10 * heading_step_deg);
  EXPECT_THAT(departure_of(reference, 39 * heading_step_deg), IsEmpty());
  EXPECT_THAT(departure_of(reference, 45 * heading_step_deg), HasSubstr("heading_deg"));
  EXPECT_THAT(departure_of(reference, 60 * heading_step_deg, 3, 2), IsEmpty());
}

TEST(Reference, HoldsFlagsToOneAnswer) {
  const Reference reference = of(0);
  EXPECT_THAT(departure_of(reference, 0, 4), IsEmpty());
  EXPECT_THAT(departure_of(reference, 0, 6), HasSubstr("AlignAttitude.coasting over the flight: mean 0.06"));
}

TEST(Reference, CountsMessages) {
  const Reference reference = of(0);
  Flown none;
  EXPECT_EQ(departure(reference, none.answers), "AlignAttitude: 0 answers, 100 in the reference");
  Flown more;
  fly(more, 0);
  more.hear(TargetHeartbeat{});
  EXPECT_EQ(departure(reference, more.answers), "TargetHeartbeat: 1 answers, none in the reference");
}

TEST(Reference, AnglesGoTheShorterWayRound) {
  Flown a, b;
  for (int i = 0; i < 10; ++i) {
    a.attitude(179.999);
    b.attitude(i % 2 == 0 ? 179.999 : -179.999);
  }
  const Reference reference = make_reference(a.answers, b.answers, 3);
  EXPECT_LT(reference.front().rounding[2], 0.01);
  EXPECT_THAT(departure(reference, b.answers), IsEmpty());
}

TEST(Difference, IsOfTwoFlightsThatAreToAgree) {
  Flown a, b, c;
  fly(a, 0);
  fly(b, 2 * heading_step_deg);
  fly(c, 0, 4);
  a.hear(TargetHeartbeat{.algorithm = messages::Algorithm::kalman});
  b.hear(TargetHeartbeat{.algorithm = messages::Algorithm::robust_h2});
  EXPECT_THAT(difference(a.answers, b.answers, 3, 0), IsEmpty());
  EXPECT_THAT(difference(a.answers, b.answers, 1, 0), HasSubstr("AlignAttitude.heading_deg at t="));
  EXPECT_THAT(difference(a.answers, c.answers, 3, 0), HasSubstr("AlignAttitude.coasting"));
  EXPECT_THAT(difference(a.answers, Flown().answers, 3, 0), HasSubstr("100 answers in one, 0 in the other"));
}

// Headings run from -180 to 180 deg, the direction of the wind from 0 to 360 deg.
TEST(Distance, OfDirectionsIsTheShorterWayRound) {
  const auto between = [](const MessageInfo& message, std::string_view name, double a, double b) {
    return distance(*observe::signal_of(message, name), a, b);
  };
  EXPECT_NEAR(between(AlignAttitude::info, "heading_deg", -179.5, 179.5), 1, 1e-9);
  EXPECT_NEAR(between(messages::WindSpeed::info, "wind_from_deg", 0.5, 359.5), 1, 1e-9);
  EXPECT_NEAR(between(messages::FinDeflections::info, "elevator_deg", -40, 40), 80, 1e-9);
}

}  // namespace
}  // namespace canhil::accept
