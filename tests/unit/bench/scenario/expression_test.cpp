// Expressions over the truth, against the truth itself.
#include "bench/scenario/expression.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "bench/world/flight_record.hpp"
#include "bench/world/units.hpp"

namespace canhil::scenario {
namespace {

using testing::HasSubstr;
using world::units::deg;

const world::FlightRecord& flight() {
  static const world::FlightRecord record(
      {.start = {.latitude = 50 * deg, .longitude = 8 * deg, .height = 2000},
       .motion =
           world::Spiral{.speed = 60, .heading = 70 * deg, .period = 60, .roll = 20 * deg, .depth = {}}},
      20'000'000, 10'000);
  return record;
}

std::optional<double> value(const std::string& text, std::int64_t t_us = 7'123'456) {
  const auto parsed = Expression::parse(text);
  EXPECT_TRUE(parsed) << text << ": " << (parsed ? "" : parsed.error().what);
  if (!parsed) return std::nullopt;
  return parsed->at({.flight = flight()}, t_us);
}

TEST(Expression, HasTheValuesOfTheTruth) {
  const world::Truth at = flight().at(7'123'456);
  EXPECT_EQ(value("velocity.north"), at.v_eb_n.x());
  EXPECT_EQ(value("position.height"), at.position.height);
  EXPECT_EQ(value("rate.z * 2"), at.omega_ib_b.z() * 2);
  EXPECT_DOUBLE_EQ(value("velocity.x").value(), (at.C_bn.transpose() * at.v_eb_n).x());
  EXPECT_DOUBLE_EQ(value("velocity.z").value(), (at.C_bn.transpose() * at.v_eb_n).z());
  EXPECT_DOUBLE_EQ(value("course").value(), std::atan2(at.v_eb_n.y(), at.v_eb_n.x()));
  EXPECT_DOUBLE_EQ(value("sqrt(velocity.north^2 + velocity.east^2) - ground_speed").value(), 0);
}

TEST(Expression, HasTimeConstantsAndConditions) {
  EXPECT_DOUBLE_EQ(value("t").value(), 7.123456);
  EXPECT_DOUBLE_EQ(value("90 * deg / pi").value(), 0.5);
  EXPECT_DOUBLE_EQ(value("2 * g").value(), 2 * 9.80665);
  EXPECT_EQ(value("t >= 7 && t != 8 ? 1 : -1"), 1);
  EXPECT_EQ(value("t == 7 ? 1 : -1"), -1);
  EXPECT_EQ(value("!(t == 7) && !0"), 1);
  EXPECT_EQ(value("!t"), 0);
  EXPECT_EQ(value("t!=8"), 1);
}

TEST(Expression, HasNoValueWithoutTruth) {
  EXPECT_EQ(value("1 / (t - t)"), std::nullopt);
  EXPECT_EQ(value("wind.north + 1"), std::nullopt);              // the run has no glide
  EXPECT_EQ(value("velocity.north", 20'000'001), std::nullopt);  // after the flight
}

TEST(Expression, SaysWhatIsWrong) {
  const auto wrong = [](const std::string& text) {
    const auto parsed = Expression::parse(text);
    return parsed ? "" : parsed.error().what + ", expected " + parsed.error().expected;
  };
  EXPECT_EQ(wrong("2 * velocty.north"), "'velocty.north' is no true value, expected 'velocity.north'");
  EXPECT_THAT(wrong("quite_another"), HasSubstr("one of: t, attitude.roll"));
  EXPECT_THAT(wrong("2 * (t"), HasSubstr("is no expression"));
  EXPECT_THAT(wrong("2 *"), HasSubstr("is no expression"));
  EXPECT_THAT(wrong("t, 2"), HasSubstr("has 2 values"));
  EXPECT_THAT(wrong("t = 2"), HasSubstr("assigns a value"));
  EXPECT_THAT(wrong("\"text\""), HasSubstr("is no expression"));
  EXPECT_THAT(wrong(std::string(100'000, '(')), HasSubstr("is no expression"));
  EXPECT_EQ(wrong("t <= 2"), "");
}

}  // namespace
}  // namespace canhil::scenario
