// Each error of a scenario gives exactly one line: where, what, what was expected.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>

#include "tests/own_folder.hpp"
#include "tests/unit/bench/scenario/texts.hpp"

namespace canhil::scenario {
namespace {

struct Wrong {
  std::string from;
  std::string to;
  std::string error;  ///< without the file's name
};

class ScenarioError : public testing::TestWithParam<Wrong> {};

TEST_P(ScenarioError, IsOneExactLine) {
  EXPECT_EQ(error_of(with(GetParam().from, GetParam().to)), "s.toml:" + GetParam().error);
}

std::vector<std::string> lines_of(const Error& error) {
  std::vector<std::string> all{error.message};
  all.insert(all.end(), error.more.begin(), error.more.end());
  return all;
}

/// All errors of a text, without the file's name.
std::vector<std::string> errors_of(std::string_view text) {
  const Result<Scenario> result = parse(text, "s.toml", contract);
  if (result) return {};
  std::vector<std::string> all = lines_of(result.error());
  for (std::string& one : all) one.erase(0, std::string("s.toml:").size());
  return all;
}

TEST(ScenarioErrors, AreToldAllIfNoneCanBeAConsequenceOfAnother) {
  const std::string many =
      with("seed = 7", "seed = 7.5", inside("[master_ins]", "perod_ms = 3\nperiods = 4"));
  EXPECT_THAT(errors_of(with("height_m = 1000.0", "height_m = 1e6",
                             with("heading_deg = 90", "heading_deg = true", many))),
              testing::ElementsAre(
                  "3: key 'seed': is not whole, expected a whole number of at least 0",
                  "12: key 'truth.height_m': 1000000 is out of range, expected a number from -1000 to 50000",
                  "13: key 'truth.heading_deg': is a boolean, expected a number from -180 to 360",
                  "15: key 'master_ins.perod_ms': is unknown, expected 'period_ms'"));
}

TEST(ScenarioErrors, EndWithAnErrorThatCanHaveConsequences) {
  const std::string wrong = with("seed = 7", "seed = 7.5", inside("[slave_imu]", "perod_ms = 3"));
  const std::string first = "3: key 'seed': is not whole, expected a whole number of at least 0";
  // [truth] has the keys of its trajectory.
  EXPECT_THAT(errors_of(with("trajectory = \"rest\"\n", "", wrong)), testing::ElementsAre(first));
  EXPECT_THAT(
      errors_of(with("\"rest\"", "\"arrest\"", wrong)),
      testing::ElementsAre(first, testing::StartsWith("9: key 'truth.trajectory': 'arrest' is unknown")));
}

// The unknown key may be the one that defines the name.
TEST(ScenarioErrors, OfANameThatTheFileDefinesAreToldOnlyIfTheyAreTheFirst) {
  const auto after = [](std::string_view text) {
    Section section = Section::parse(text, "s.toml");
    section.table("a").finish();
    section.given_name("b", std::vector<std::string>{});
    section.one_of("c", std::vector<std::string>{"yes"});
    return lines_of(section.error().value());
  };
  EXPECT_THAT(after("a = { wrong = 1 }\nb = \"none\"\nc = \"yes\"\n"),
              testing::ElementsAre(testing::HasSubstr("'a.wrong'")));
  EXPECT_THAT(after("a = {}\nb = \"none\"\nc = \"no\"\n"),
              testing::ElementsAre(testing::HasSubstr("'none'")));
  EXPECT_THAT(after("a = { wrong = 1 }\nb = \"none\"\nc = \"no\"\n"),
              testing::ElementsAre(testing::HasSubstr("'a.wrong'")));
}

TEST(ScenarioErrors, AreToldUpToTwenty) {
  std::string text;
  for (int i = 0; i < 30; ++i) text += fmt::format("key{}_s = -1\n", i);
  Section section = Section::parse(text, "s.toml");
  for (int i = 0; i < 30; ++i) section.number(fmt::format("key{}_s", i), Limits::above(0));
  EXPECT_EQ(section.error()->more.size(), 19U);
}

/// The keys in the order in which they are read: sections that depend on a truth follow the section of this
/// truth.
std::string keys_of_a_file() {
  const auto nodes_of = [](std::string_view samples) {
    std::string keys;
    for (const NodeTable* table : nodes::tables()) {
      const bool is_carried = table->closes != nullptr;  // others are for targets with a mapping
      if (is_carried && table->samples == samples) keys += std::string(table->key) + ", ";
    }
    return keys;
  };
  return "title, duration_s, dbc, seed, target, engagement, " + nodes_of("plant.range") +
         "glide, wind, airframe, " + nodes_of("plant.height") + "plant, truth, initial_error, " +
         nodes_of("") + "node, event, fault, check";
}

const std::string sigma =
    "initial_sigma = { velocity_mps = 1.0, tilt_deg = 2.0, heading_deg = 5.0, position_m = 10.0 }";

INSTANTIATE_TEST_SUITE_P(
    Toml, ScenarioError,
    testing::Values(
        Wrong{"seed = 7", "seed 7", "3: not TOML: Error while parsing key-value pair: expected '=', saw '7'"},
        Wrong{"seed = 7", "seed = 7\nseed = 8",
              "4: not TOML: Error while parsing key-value pair: cannot redefine existing integer 'seed'"}));

INSTANTIATE_TEST_SUITE_P(
    Keys, ScenarioError,
    testing::Values(
        Wrong{"seed = 7", "seed = 7\nzebra_crossing = 1\nape_house = 1",
              "4: key 'zebra_crossing': is unknown, expected one of: " + keys_of_a_file()},
        Wrong{"seed = 7", "seeds = 7", "3: key 'seeds': is unknown, expected 'seed'"},
        Wrong{"[master_ins]", "[master_ins]\nperod_ms = 3",
              "15: key 'master_ins.perod_ms': is unknown, expected 'period_ms'"},
        Wrong{"[slave_imu]", "[slave_imuu]", "15: key 'slave_imuu': is unknown, expected 'slave_imu'"},
        Wrong{"tilt_deg", "tilt", "7: key 'target.initial_sigma.tilt': is unknown, expected 'tilt_deg'"},
        Wrong{"heading_deg = 90", "heading_deg = 90\nspeed_kmph = 3",
              "14: key 'truth.speed_kmph': is unknown, expected one of: trajectory, latitude_deg, "
              "longitude_deg, "
              "height_m, roll_deg, pitch_deg, heading_deg, vibration, sea"},
        Wrong{"[[check]]", "[[check]]\nbelow_mrad = 3",
              "17: key 'check[1].below_mrad': is unknown, expected one of: kind, requirement, "
              "silent_at_most_s, name"},
        Wrong{"seed = 7", "seed = 7\n\"a\\nb\" = 1",
              "4: key 'a\\nb': is unknown, expected one of: " + keys_of_a_file()},
        Wrong{"[truth]", "[target.parameters]\nh2_cases = 1\n[truth]",
              "9: key 'target.parameters.h2_cases': is unknown, expected 'h2_case'"}));

INSTANTIATE_TEST_SUITE_P(
    Missing, ScenarioError,
    testing::Values(
        Wrong{"title = \"A title\"\n", "", "1: key 'title': is missing, expected text on one line"},
        Wrong{"seed = 7\n", "", "1: key 'seed': is missing, expected a whole number of at least 0"},
        Wrong{"duration_s = 20.0\n", "",
              "1: key 'duration_s': is missing, expected a number above 0, at most 86400"},
        Wrong{"[slave_imu]\n", "", "1: key 'slave_imu': is missing, expected a table"},
        Wrong{sigma + "\n", "", "4: key 'target.initial_sigma': is missing, expected a table"},
        Wrong{"algorithm = \"kalman\"\n", "",
              "4: key 'target.algorithm': is missing, expected one of: kalman, robust_h2"},
        Wrong{"height_m = 1000.0\n", "",
              "8: key 'truth.height_m': is missing, expected a number from -1000 to 50000"},
        Wrong{"silent_at_most_s = 0.5\n", "",
              "16: key 'check[1].silent_at_most_s': is missing, expected a number above 0"},
        Wrong{"[[check]]\nkind = \"heartbeat\"\nsilent_at_most_s = 0.5\n", "",
              "1: key 'check': is missing, expected at least one [[check]]"}));

INSTANTIATE_TEST_SUITE_P(
    Types, ScenarioError,
    testing::Values(
        Wrong{"20.0", "\"20\"", "2: key 'duration_s': is a string, expected a number above 0, at most 86400"},
        Wrong{"20.0", "true", "2: key 'duration_s': is a boolean, expected a number above 0, at most 86400"},
        Wrong{"20.0", "2020-01-01",
              "2: key 'duration_s': is a date or time, expected a number above 0, at most 86400"},
        Wrong{"seed = 7", "seed = 7.5", "3: key 'seed': is not whole, expected a whole number of at least 0"},
        Wrong{"seed = 7", "seed = [7]", "3: key 'seed': is an array, expected a whole number of at least 0"},
        Wrong{"\"A title\"", "5", "1: key 'title': is a number, expected text on one line"},
        Wrong{"\"rest\"", "5",
              "9: key 'truth.trajectory': is a number, expected one of: rest, level_acceleration, weave, "
              "s_path, racetrack, spiral, "
              "rest_then_go, legs, waypoints, "
              "recorded, plant, unknown"},
        Wrong{sigma, "initial_sigma = 1", "7: key 'target.initial_sigma': is a number, expected a table"},
        Wrong{"[[check]]", "[check]", "16: key 'check': is a table, expected at least one [[check]]"},
        Wrong{"seed = 7\n", "seed = 7\ncheck = [ 5 ]\n",
              "17: not TOML: Error while parsing table header: cannot redefine existing array 'check' as "
              "array-of-tables"},
        Wrong{"[master_ins]", "[master_ins]\nvelocity_noise_mps = [1, 2]",
              "15: key 'master_ins.velocity_noise_mps': has 2 elements, expected a number, or an array of "
              "three, each of at "
              "least 0"},
        Wrong{"[master_ins]", "[master_ins]\nvelocity_noise_mps = [1, 2, 'x']",
              "15: key 'master_ins.velocity_noise_mps': element 3 is a string, expected a number, or an "
              "array of "
              "three, each of at "
              "least 0"},
        Wrong{"[master_ins]", "[master_ins]\nvelocity_noise_mps = [1, -2.5, 3]",
              "15: key 'master_ins.velocity_noise_mps': element 2 is -2.5, expected a number, or an array of "
              "three, each of at "
              "least 0"},
        Wrong{"[master_ins]", "[master_ins]\nvelocity_noise_mps = 'x'",
              "15: key 'master_ins.velocity_noise_mps': is a string, expected a number of at least 0"}));

INSTANTIATE_TEST_SUITE_P(
    Values, ScenarioError,
    testing::Values(
        Wrong{"20.0", "0.0",
              "2: key 'duration_s': 0 is out of range, expected a number above 0, at most 86400"},
        Wrong{"20.0", "nan",
              "2: key 'duration_s': nan is out of range, expected a number above 0, at most 86400"},
        Wrong{"20.0", "1e9",
              "2: key 'duration_s': 1000000000 is out of range, expected a number above 0, at most 86400"},
        Wrong{"20.0", "0.1234567",
              "2: key 'duration_s': is not whole in microseconds, expected a multiple of 1 us"},
        Wrong{"silent_at_most_s = 0.5", "silent_at_most_s = 1e30",
              "18: key 'check[1].silent_at_most_s': is too long a time, expected at most 100000 s"},
        Wrong{"seed = 7", "seed = -1",
              "3: key 'seed': -1 is out of range, expected a whole number of at least 0"},
        Wrong{"\"A title\"", "\"\"", "1: key 'title': is empty, expected text on one line"},
        Wrong{"\"A title\"", "\"A\\nb\"",
              "1: key 'title': has a line break or tab, expected text on one line"},
        Wrong{"37.0", "90.0",
              "10: key 'truth.latitude_deg': 90 is out of range, expected a number from -89 to 89"},
        Wrong{"tilt_deg = 2.0", "tilt_deg = 0",
              "7: key 'target.initial_sigma.tilt_deg': 0 is out of range, expected a number above 0, at most "
              "90"},
        Wrong{"\"kalman\"", "\"kalmann\"",
              "6: key 'target.algorithm': 'kalmann' is unknown, expected 'kalman'"},
        Wrong{"\"kalman\"", "\"particle\"",
              "6: key 'target.algorithm': 'particle' is unknown, expected one of: kalman, robust_h2"},
        Wrong{"[slave_imu]", "[slave_imu]\ngyro_noise_degprth = -1",
              "16: key 'slave_imu.gyro_noise_degprth': -1 is out of range, expected a number of at least 0"},
        Wrong{"[slave_imu]", "[slave_imu]\ngyro_noise_degprth = inf",
              "16: key 'slave_imu.gyro_noise_degprth': inf is out of range, expected a number of at least 0"},
        Wrong{"[slave_imu]", "[slave_imu]\nperiod_ms = 0",
              "16: key 'slave_imu.period_ms': 0 is out of range, expected a number from 1 to 10000"},
        Wrong{"[truth]", "[target.parameters]\nh2_case = inf\n[truth]",
              "9: key 'target.parameters.h2_case': inf is out of range, expected a number from -3.4e+38 to "
              "3.4e+38"}));

std::string check(std::string_view lines) { return "[[check]]\n" + std::string(lines) + "\n[[check]]"; }

INSTANTIATE_TEST_SUITE_P(
    Checks, ScenarioError,
    testing::Values(
        Wrong{"\"heartbeat\"", "\"hartbeat\"",
              "17: key 'check[1].kind': 'hartbeat' is unknown, expected 'heartbeat'"},
        Wrong{
            "\"heartbeat\"", "\"banana\"",
            "17: key 'check[1].kind': 'banana' is unknown, expected one of: error, convergence, consistency, "
            "sigma, answers, latency, latency_growth, delay, output_period, own_times, heartbeat, counters, "
            "counts_match, protection, bus_load, bus_errors, "
            "wire_response, detected_within, recovers_within, sigma_grows, honest, answering, "
            "flag, response, command, program, miss_distance"},
        Wrong{
            "[[check]]", check("kind = 'error'\nquantity = 'yaw.of.the.body'\nbelow_mrad = 1"),
            "18: key 'check[1].quantity': 'yaw.of.the.body' is unknown, expected one of: misalignment.north, "
            "misalignment.east, misalignment.down, attitude.roll, attitude.pitch, attitude.heading, "
            "velocity.north, velocity.east, velocity.down, velocity.norm"},
        Wrong{"[[check]]",
              check("kind = 'error'\nquantity = 'velocity.norm'\nfrom_s = 5\nto_s = 4\nbelow_mps = 1"),
              "19: key 'check[1].from_s': is not before the end of the window, expected less than 4"},
        Wrong{"[[check]]", check("kind = 'error'\nquantity = 'velocity.norm'\nfrom_s = 20\nbelow_mps = 1"),
              "19: key 'check[1].from_s': is not before the end of the window, expected less than 20"},
        Wrong{"[[check]]", check("kind = 'error'\nquantity = 'velocity.norm'\nto_s = 21\nbelow_mps = 1"),
              "19: key 'check[1].to_s': is after the end of the run, expected at most duration_s = 20"},
        Wrong{"[[check]]",
              check("kind = 'convergence'\nquantity = 'attitude.roll'\nwithin_mrad = 1\nbefore_s = 21"),
              "20: key 'check[1].before_s': is after the end of the run, expected at most duration_s = 20"},
        Wrong{"[[check]]", check("kind = 'latency'\nmessage = 'AlignAtitude'\nbelow_ms = 1"),
              "18: key 'check[1].message': 'AlignAtitude' is unknown, expected 'AlignAttitude'"},
        Wrong{
            "[[check]]", check("kind = 'latency'\nmessage = 'TargetHeartbeat'\nbelow_ms = 1"),
            "18: key 'check[1].message': 'TargetHeartbeat' answers nothing, expected one of: AlignAttitude, "
            "AlignUpdate"},
        Wrong{"[[check]]", check("kind = 'latency'\nmessage = 'AlignUpdate'\nbelow_ms = 1\nquantile = 99"),
              "20: key 'check[1].quantile': 99 is out of range, expected a number above 0, at most 1"},
        Wrong{
            "[[check]]", check("kind = 'consistency'\nquantity = 'innovation.nis'"),
            "16: key 'check[1].mean_between': is missing, expected an array [low, high], each of at least 0"},
        Wrong{"[[check]]", check("kind = 'consistency'\nquantity = 'innovation.nis'\nmean_between = [4, 2]"),
              "19: key 'check[1].mean_between': is descending, expected an array [low, high], each of at "
              "least 0"},
        Wrong{"[[check]]",
              check("kind = 'consistency'\nquantity = 'innovation.nis'\nmean_between = [1, 2]\nprobability = "
                    "0.9"),
              "19: key 'check[1].mean_between': is given beside probability, expected one of the two"},
        Wrong{"[[check]]", check("kind = 'consistency'\nquantity = 'attitude.nees'\nprobability = 0.9"),
              "19: key 'check[1].probability': is for innovations (NIS) only, expected mean_between = [low, "
              "high]"},
        Wrong{
            "[[check]]", check("kind = 'counters'"),
            "16: key 'check[1].frames_lost_at_most': is missing, as are all other limits, expected at least "
            "one limit"},
        Wrong{"[[check]]", check("kind = 'heartbeat'\nsilent_at_most_s = 1"),
              "19: key 'check[2].name': 'heartbeat' is the name of check[1] too, expected another name"}));

TEST(ScenarioFile, ThatCannotBeRead) {
  const auto missing = read_file("/nonexistent/s.toml", contract);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().message,
            "/nonexistent/s.toml: cannot be read (No such file or directory), expected a scenario file");
  const auto folder = read_file(test::own_folder(), contract);
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().message,
            test::own_folder() + ": cannot be read (Is a directory), expected a scenario file");
}

TEST(ScenarioFile, IsReadAsItsText) {
  const std::string path = test::own_folder() + "/scenario_file_is_read.toml";
  std::ofstream(path, std::ios::binary) << valid;
  const auto scenario = read_file(path, contract);
  ASSERT_TRUE(scenario) << scenario.error().message;
  EXPECT_EQ(scenario->file, path);
  EXPECT_EQ(scenario->hash, parsed(valid).hash);
}

const std::string s_path = "\"s_path\"\nspeed_mps = 3\nheading_amplitude_deg = 50\nturn_period_s = 33\n";

INSTANTIATE_TEST_SUITE_P(
    InFlight, ScenarioError,
    testing::Values(
        Wrong{"transfer_alignment", "inflight_alignment",
              "1: key 'ssbl': is missing, expected at least one of the tables [ssbl] and [gps]"},
        Wrong{"\"rest\"", "\"s_path\"\nspeed_mps = 0",
              "10: key 'truth.speed_mps': 0 is out of range, expected a number above 0"},
        Wrong{"\"rest\"", s_path + "dive_depth_m = 100\ndive_period_s = 60",
              "13: key 'truth.dive_depth_m': is too deep for the speed and dive_period_s, expected at most "
              "40.51, a "
              "dive of 45 degrees"},
        Wrong{"[[check]]", check("kind = 'error'\nquantity = 'attitude.roll'\nbelow_mrad = 1\nbelow_deg = 1"),
              "19: key 'check[1].below_mrad': is given beside below_deg, expected one of the two"},
        Wrong{
            "[[check]]", check("kind = 'answers'"),
            "16: key 'check[1].answers_at_least': is missing, as are all other limits, expected at least one "
            "limit"},
        Wrong{
            "[[check]]", check("kind = 'answers'\ngated_fixes = 1\nupdates_at_most = 1"),
            "18: key 'check[1].gated_fixes': is unknown, expected one of: kind, requirement, estimator, "
            "from_s, "
            "to_s, answers_at_least, answers_at_most, answers_before_s, coasting_at_least, coasting_at_most, "
            "coasting_before_s, updates_at_least, updates_at_most, updates_before_s, "
            "degraded_at_least, degraded_at_most, degraded_before_s, name"},
        Wrong{"[[check]]",
              check("kind = 'consistency'\nquantity = 'attitude.heading.nees'\nprobability = 0.9"),
              "19: key 'check[1].probability': is for innovations (NIS) only, expected mean_between = [low, "
              "high]"},
        Wrong{"[[check]]", "[ssbl]\noutlier_percent = 5\n[[check]]",
              "17: key 'ssbl.outlier_percent': is given alone, expected outlier_percent and outlier_m, both "
              "above "
              "0"},
        Wrong{"[[check]]", "[ssbl]\noutlier_m = 5\n[[check]]",
              "17: key 'ssbl.outlier_m': is given alone, expected outlier_percent and outlier_m, both "
              "above 0"},
        Wrong{"[[check]]", "[gps]\noutlier_percent = 1\noutlier_m = 1e9\n[[check]]",
              "18: key 'gps.outlier_m': 1000000000 is out of range, expected a number from 0 to 50000"},
        Wrong{"[[check]]", "[initial_error]\nheading_sigma_deg = 5\nheading_magnitude_deg = 90\n[[check]]",
              "18: key 'initial_error.heading_magnitude_deg': is given beside 'heading_sigma_deg', expected "
              "only one of the two"},
        Wrong{"[[check]]", "[gps]\nloss_percent = 101\n[[check]]",
              "17: key 'gps.loss_percent': 101 is out of range, expected a number from 0 to 100"},
        Wrong{"[[check]]", "[gps]\nnoise = 10\n[[check]]",
              "17: key 'gps.noise': is unknown, expected 'noise_m'"},
        Wrong{"[[check]]", "[ssbl]\nsilence_s = [5, 4]\n[[check]]",
              "17: key 'ssbl.silence_s': is descending, expected an array [low, high], each of at least 0"},
        Wrong{"[slave_imu]", "[slave_imu]\nloss_percent = -1",
              "16: key 'slave_imu.loss_percent': -1 is out of range, expected a number from 0 to 100"},
        Wrong{"[master_ins]", "[initial_error]\nheading_magnitude_deg = 181\n[master_ins]",
              "15: key 'initial_error.heading_magnitude_deg': 181 is out of range, expected a number from 0 "
              "to 180"}));

}  // namespace
}  // namespace canhil::scenario
