// A recorded flight of a scenario: which part of the file is used, and one line per error of the file.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "bench/scenario/table.hpp"
#include "bench/world/units.hpp"
#include "tests/own_folder.hpp"
#include "tests/unit/bench/scenario/texts.hpp"

namespace canhil::scenario {
namespace {

using world::units::deg;
using Row = std::vector<std::string>;

const Row header{"t_s",
                 "latitude_deg",
                 "longitude_deg",
                 "height_m",
                 "velocity_north_mps",
                 "velocity_east_mps",
                 "velocity_down_mps",
                 "roll_deg",
                 "pitch_deg",
                 "heading_deg"};

/// The rows of a recorded flight, at 50 Hz. The flight goes north at 10 m/s for 21 s, and the heading turns
/// slowly through north. The file's clock begins at 5 s.
std::vector<Row> rows() {
  std::vector<Row> all{header};
  for (int i = 0; i <= 1050; ++i) {
    const double t = 0.02 * i;
    const double north_radius = world::meridian_radius(37 * deg) + 1000;
    all.push_back({fmt::format("{:.2f}", 5 + t), fmt::format("{:.10f}", 37 + 10 * t / north_radius / deg),
                   "127", "1000", "10", "0", "0", "0", "1", fmt::format("{:.3f}", std::fmod(355 + t, 360))});
  }
  return all;
}

std::string text_of(const std::vector<Row>& all) {
  std::string text;
  for (const Row& row : all) text += fmt::format("{}\n", fmt::join(row, ","));
  return text;
}

std::string folder() { return test::own_folder(); }

Result<Scenario> read(const std::string& csv, const std::string& keys = "from_s = 5") {
  std::ofstream(folder() + "/f.csv") << csv;
  std::string text = with("trajectory = \"rest\"", "trajectory = \"recorded\"\nfile = \"f.csv\"\n" + keys);
  for (const std::string line :
       {"latitude_deg = 37.0\n", "longitude_deg = 127.0\n", "height_m = 1000.0\n", "heading_deg = 90\n"})
    text = with(line, "", text);
  return parse(text, "s.toml", contract, {}, folder());
}

/// The part of the error message that follows "s.toml:10: key 'truth.file': FOLDER/".
std::string complaint(const std::function<void(std::vector<Row>&)>& change,
                      const std::string& keys = "from_s = 5") {
  std::vector<Row> all = rows();
  change(all);
  const auto result = read(text_of(all), keys);
  if (result) return "no error";
  const std::string& message = result.error().message;
  const std::string start = "s.toml:10: key 'truth.file': " + folder() + "/";
  return message.starts_with(start) ? message.substr(start.size()) : message;
}

TEST(RecordedFlight, BeginsAtItsTimeAndCrossesNorth) {
  const auto scenario = read(text_of(rows()));
  ASSERT_TRUE(scenario) << scenario.error().message;
  EXPECT_NEAR(scenario->truth.start.latitude, 37 * deg, 1e-9);
  const world::Movement start = movement(scenario->truth.motion, 0),
                        later = movement(scenario->truth.motion, 5);
  EXPECT_NEAR(world::euler_from(start.C_bn).heading, -5 * deg, 1e-9);
  EXPECT_NEAR(world::euler_from(later.C_bn).heading, 0, 1e-9);
  EXPECT_NEAR(later.omega_nb_b.norm(), 1 * deg, 1e-6) << "no jump where the heading wraps";
  EXPECT_TRUE(scenario->truth_is_known());
}

TEST(RecordedFlight, TakesEachQuantityInAnyUnit) {
  std::vector<Row> all = rows();
  all[0] = {"t_us",
            "latitude_deg",
            "longitude_rad",
            "height_m",
            "velocity_north_kmph",
            "velocity_east_mps",
            "velocity_down_mps",
            "roll_mrad",
            "pitch_rad",
            "heading_deg"};
  for (std::size_t i = 1; i < all.size(); ++i) {
    all[i][0] = fmt::format("{}", 5'000'000 + 20'000 * (i - 1));
    all[i][2] = fmt::format("{:.12f}", 127 * deg);
    all[i][4] = "36";
    all[i][8] = fmt::format("{:.12f}", 1 * deg);
  }
  const auto scenario = read(text_of(all));
  ASSERT_TRUE(scenario) << scenario.error().message;
  const auto original = read(text_of(rows()));
  for (const double t : {0.0, 7.77, 20.0}) {
    EXPECT_LT(
        (movement(scenario->truth.motion, t).v_eb_n - movement(original->truth.motion, t).v_eb_n).norm(),
        1e-9);
    EXPECT_LT((movement(scenario->truth.motion, t).C_bn - movement(original->truth.motion, t).C_bn).norm(),
              1e-11);
  }
}

// A changed row changes the hash of the scenario, so a campaign resumes only with the same data.
TEST(RecordedFlight, IsPartOfTheHash) {
  std::vector<Row> all = rows();
  const auto first = read(text_of(all));
  all[7][9] += "1";
  const auto second = read(text_of(all));
  ASSERT_TRUE(first && second);
  EXPECT_NE(first->hash, second->hash);
  EXPECT_NE(first->recordings_hash, 0U);
}

struct Wrong {
  const char* name;
  std::function<void(std::vector<Row>&)> change;
  std::string complaint;
  std::string keys = "from_s = 5";
};

class WrongFlight : public testing::TestWithParam<Wrong> {};
TEST_P(WrongFlight, IsOneLine) {
  EXPECT_EQ(complaint(GetParam().change, GetParam().keys), GetParam().complaint);
}

const auto put = [](std::size_t row, std::size_t column, const std::string& text) {
  return [=](std::vector<Row>& all) { all[row][column] = text; };
};
const auto without = [](std::initializer_list<std::size_t> columns) {
  return [places = std::vector<std::size_t>(columns)](std::vector<Row>& all) {
    for (Row& row : all)
      // Clang 14 cannot compile std::views::reverse. NOLINTNEXTLINE(modernize-loop-convert)
      for (auto place = places.rbegin(); place != places.rend(); ++place)
        row.erase(row.begin() + static_cast<std::ptrdiff_t>(*place));
  };
};

INSTANTIATE_TEST_SUITE_P(
    Files, WrongFlight,
    testing::Values(
        Wrong{"missing", without({8}),
              "f.csv:1: column 'pitch_deg': is missing, expected it or 'pitch_rad', 'pitch_mrad'"},
        Wrong{"velocity", without({5}),
              "f.csv:1: column 'velocity_east_mps': is missing, expected it or 'velocity_east_kmph' (the "
              "velocity "
              "cannot be had from positions: their rounding would be accelerations)"},
        Wrong{
            "half_a_position", without({2}),
            "f.csv:1: column 'longitude_deg': is missing, expected it or 'longitude_rad', 'longitude_mrad'"},
        Wrong{"twice", put(0, 7, "pitch_rad"),
              "f.csv:1: column 'pitch_rad': is given beside 'pitch_deg', expected one of the two"},
        Wrong{"no_number", put(100, 9, "nord"),
              "f.csv:101: column 'heading_deg': 'nord' is not a number, expected one"},
        Wrong{"empty", put(100, 9, ""), "f.csv:101: column 'heading_deg': '' is not a number, expected one"},
        Wrong{"not_finite", put(100, 4, "nan"),
              "f.csv:101: column 'velocity_north_mps': 'nan' is not a number, expected one"},
        Wrong{"short_row", [](std::vector<Row>& all) { all[100].pop_back(); },
              "f.csv:101: has 9 values, expected 10, one for each column"},
        Wrong{"no_rows", [](std::vector<Row>& all) { all.resize(1); }, "f.csv: has no rows, expected some"},
        Wrong{"same_time", put(100, 0, "6.96"),
              "f.csv:101: column 't_s': 6.96 s does not come after 6.96 s, the time of the row before, "
              "expected times "
              "that ascend by at least 1 us"},
        Wrong{"gap", [](std::vector<Row>& all) { all.erase(all.begin() + 100, all.begin() + 112); },
              "f.csv:101: column 't_s': comes 0.26 s after the row before, expected at most 0.2 s (key "
              "'gap_s')"},
        Wrong{"late", put(0, 0, "t_s"),
              "f.csv:2: column 't_s': the first row comes 1 s after the time that 'from_s' says, expected a "
              "row at or "
              "before it",
              "from_s = 4"},
        Wrong{
            "ends", put(0, 0, "t_s"),
            "f.csv:1052: column 't_s': the last row is at 19 s of the run, expected rows to its end at 20 s",
            "from_s = 7"},
        Wrong{"latitude", put(100, 1, "89.5"),
              "f.csv:101: column 'latitude_deg': 89.5 deg is out of range, expected -89 to 89"},
        Wrong{"turn", put(100, 7, "30"),
              "f.csv:101: column 'heading_deg': the attitude turns by 30.0 deg within 0.02 s of the row "
              "before, expected "
              "at most 1000 deg/s, and 45 deg from row to row"},
        Wrong{"jerk", put(100, 6, "25"),
              "f.csv:101: column 'velocity_north_mps': the velocity changes by 25 m/s within 0.02 s of the "
              "row before, "
              "expected at most 1000 m/s2"},
        Wrong{"jump", put(100, 1, "37.001"),
              "f.csv:101: column 'latitude_deg': velocity and positions contradict each other: the way by "
              "the velocities "
              "passes 91 m from this position, expected at most 5 (key 'agree_within_m')"},
        Wrong{"sign",
              [](std::vector<Row>& all) {
                for (std::size_t i = 1; i < all.size(); ++i) all[i][4] = "-10";
              },
              "f.csv:2: column 'velocity_north_mps': velocity and positions contradict each other: over 10 s "
              "they differ "
              "by 20 m/s, expected at most 0.5 (key 'agree_within_m')"},
        Wrong{"start_too", put(0, 0, "t_s"),
              "s.toml:11: key 'truth.height_m': is given, and the file has positions, expected it only for a "
              "file without them",
              "height_m = 3\nfrom_s = 5"},
        Wrong{"no_start", without({1, 2, 3}),
              "s.toml:8: key 'truth.latitude_deg': is missing, expected a number from -89 to 89"}),
    [](const auto& one) { return std::string(one.param.name); });

TEST(RecordedFlight, WithoutPositionsStartsWhereTheScenarioSays) {
  std::vector<Row> all = rows();
  without({1, 2, 3})(all);
  const auto scenario =
      read(text_of(all), "from_s = 5\nlatitude_deg = -10\nlongitude_deg = 20\nheight_m = 30");
  ASSERT_TRUE(scenario) << scenario.error().message;
  EXPECT_NEAR(scenario->truth.start.latitude, -10 * deg, 1e-12);
  EXPECT_EQ(scenario->truth.start.height, 30);
}

TEST(RecordedFlight, WithoutAFileIsRefused) {
  const std::string text = with("trajectory = \"rest\"", "trajectory = \"recorded\"\nfile = \"none.csv\"");
  EXPECT_EQ(error_of(text),
            "s.toml:10: key 'truth.file': none.csv: cannot be read (No such file or directory), expected a "
            "CSV file");
}

TEST(Table, TakesWindowsLineEndsSpacesAndFurtherColumns) {
  const std::vector<std::string> names{"t_s", "roll_deg"};
  const auto table =
      read_table("\xEF\xBB\xBF mode , roll_rad,t_ms\r\nclimb, 0.5 ,20\r\nturn,1,30\r\n", "x.csv", names);
  ASSERT_TRUE(table) << table.error().message;
  ASSERT_EQ(table->rows(), 2U);
  EXPECT_DOUBLE_EQ(table->value(1, 0), 0.03);
  EXPECT_DOUBLE_EQ(table->value(0, 1), 0.5 / deg);
}

}  // namespace
}  // namespace canhil::scenario
