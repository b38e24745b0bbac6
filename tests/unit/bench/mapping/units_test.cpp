#include "bench/quantities/wire_unit.hpp"

#include <gtest/gtest.h>

#include "bench/world/units.hpp"

namespace canhil::quantities {
namespace {

TEST(WireUnits, AreKnownInTheSpellingsOfDbcFiles) {
  using world::units::deg;
  for (const char* spelling :
       {"deg/s", "°/s", "deg/sec", "Deg/s", "degrees/s", "degree/sec", "º/s", "deg / s"}) {
    const auto unit = wire_unit(spelling);
    ASSERT_TRUE(unit) << spelling;
    EXPECT_EQ(unit->si, "rad/s");
    EXPECT_EQ(unit->factor, deg);
  }
  for (const char* spelling : {"m/s^2", "m/s2", "m/s²", "m/s/s", "m/sec^2", "m/s**2"}) {
    const auto unit = wire_unit(spelling);
    ASSERT_TRUE(unit) << spelling;
    EXPECT_EQ(unit->si, "m/s^2");
    EXPECT_EQ(unit->factor, 1);
  }
  EXPECT_EQ(wire_unit("g")->factor, 9.80665);
  EXPECT_EQ(wire_unit("G")->factor, 9.80665);
  EXPECT_DOUBLE_EQ(wire_unit("km/h")->factor, 1 / 3.6);
  EXPECT_DOUBLE_EQ(wire_unit("kph")->factor, 1 / 3.6);
  EXPECT_EQ(wire_unit("us")->factor, 1e-6);
  EXPECT_EQ(wire_unit("µs")->factor, 1e-6);
  EXPECT_EQ(wire_unit("mm")->factor, 1e-3);
  EXPECT_EQ(wire_unit("hPa")->si, "Pa");
  EXPECT_DOUBLE_EQ(wire_unit("mG", "T")->factor, 1e-7);  // milligauss
  EXPECT_DOUBLE_EQ(wire_unit("Gauss")->factor, 1e-4);
  EXPECT_EQ(wire_unit("dps")->factor, wire_unit("deg/s")->factor);
  EXPECT_EQ(wire_unit("mbar")->factor, 100);
  EXPECT_EQ(wire_unit("kPa")->factor, 1000);
  EXPECT_EQ(wire_unit("uT")->factor, 1e-6);
  EXPECT_EQ(wire_unit("nT")->si, "T");
  EXPECT_EQ(wire_unit("K")->factor, 1);
}

TEST(WireUnits, ThatNobodyKnowsAreNone) {
  for (const char* text : {"", "rpm", "degC", "%", "d", "deg/s/s/s"}) EXPECT_FALSE(wire_unit(text)) << text;
}

}  // namespace
}  // namespace canhil::quantities
