// The record of a plant: its values by time and by name.
#include "bench/world/plant_record.hpp"

#include <gtest/gtest.h>

#include <array>

#include "bench/world/flight_record.hpp"
#include "bench/world/truth_values.hpp"
#include "bench/world/units.hpp"

namespace canhil::world {
namespace {

using units::deg;

PlantRecord record_of(std::vector<PlantRecord::Column> columns, std::vector<double> first,
                      std::vector<double> second) {
  PlantRecord record(std::move(columns));
  record.add(0, first);
  record.add(10'000, second);
  return record;
}

TEST(PlantRecord, HoldsWhatStepsAndInterpolatesTheRest) {
  const PlantRecord record =
      record_of({{.name = "plant.speed"}, {.name = "plant.gear", .steps = true}}, {1, 1}, {3, 2});
  EXPECT_EQ(record.at(0, 5'000), 2);
  EXPECT_EQ(record.at(1, 9'999), 1);
  EXPECT_EQ(record.at(1, 10'000), 2);
  EXPECT_FALSE(record.at(0, 10'001));
  EXPECT_FALSE(record.at(0, -1));
  EXPECT_EQ(record.row(10'000), 1);
  EXPECT_FALSE(record.row(5'000));
  EXPECT_FALSE(record.row(15'000));
}

TEST(PlantRecord, ColumnsAreThoseOfTheFirstRecordThatHasAll) {
  const PlantRecord one = record_of({{.name = "plant.speed"}}, {1}, {1});
  const PlantRecord other = record_of({{.name = "plant.gear"}, {.name = "plant.speed"}}, {2, 3}, {4, 5});
  const auto both = PlantColumns<2>::find({&one, &other}, {"plant.speed", "plant.gear"});
  ASSERT_TRUE(both);
  EXPECT_EQ(&both->record(), &other);
  EXPECT_EQ(both->at(10'000), (std::array{5.0, 4.0}));
  EXPECT_FALSE(both->at(10'001));
  EXPECT_FALSE((PlantColumns<2>::find({&one, &other}, {"plant.speed", "plant.height"})));
}

// What a plant shows under the name of a true value is this value; the rest of its motion follows from it.
TEST(PlantRecord, ReplacesTheTruthOfItsNames) {
  const PlantRecord record = record_of({{.name = "velocity.north"},
                                        {.name = "velocity.east"},
                                        {.name = "velocity.down"},
                                        {.name = "attitude.roll"},
                                        {.name = "attitude.pitch"},
                                        {.name = "attitude.heading"},
                                        {.name = "wind.north"}},
                                       {3, 4, 0, 0, 0, 90 * deg, 7}, {3, 4, 0, 0, 0, 90 * deg, 7});
  const FlightRecord rest({.start = {.height = 12}, .motion = Rest{}}, 10'000, 10'000);
  const auto value = [&](std::string_view name, const PlantRecords& plants) {
    return find_truth_value(name)->at({.flight = rest, .plants = plants}, 10'000);
  };
  EXPECT_EQ(value("velocity.north", {&record}), 3);
  EXPECT_EQ(value("attitude.heading", {&record}), 90 * deg);
  EXPECT_NEAR(value("velocity.x", {&record}).value(), 4, 1e-12) << "the nose points to the east";
  EXPECT_EQ(value("ground_speed", {&record}), 5);
  EXPECT_EQ(value("wind.north", {&record}), 7);
  EXPECT_EQ(value("position.height", {&record}), 12) << "the plant does not show it";
  EXPECT_EQ(value("velocity.north", {}), 0);
  EXPECT_FALSE(value("wind.north", {}));
}

}  // namespace
}  // namespace canhil::world
