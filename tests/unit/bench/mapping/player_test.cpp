// The frames that a mapping plays, and the samples that answers are assigned to. The mapping is a text in the
// test.
#include "bench/mapping/player.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <fstream>
#include <map>

#include "bench/drive/flight.hpp"
#include "bench/faults/in_run.hpp"
#include "bench/mapping/listener.hpp"
#include "bench/world/attitude.hpp"
#include "bench/world/units.hpp"
#include "dbc/parser/codec.hpp"
#include "tests/unit/bench/mapping/read_mapped.hpp"

namespace canhil::mapping {
namespace {

constexpr const char* dbc_text = R"(VERSION ""
BU_: IMU ECU
BO_ 100 Rates: 8 IMU
 SG_ RateZ : 0|32@1- (1,0) [0|0] "rad/s" ECU
 SG_ Count : 32|8@1+ (1,0) [0|0] "" ECU
 SG_ Time : 40|16@1+ (1,0) [0|0] "ms" ECU
 SG_ Mode : 56|8@1+ (1,0) [0|0] "m" ECU
BO_ 2147484000 Turned: 8 IMU
 SG_ AngleZ : 7|32@0- (1,0) [0|0] "deg" ECU
 SG_ Millis : 39|8@0+ (1,0) [0|0] "ms" ECU
 SG_ Course : 47|8@0+ (1.5,0) [0|0] "deg" ECU
BO_ 103 Paged: 8 IMU
 SG_ Page M : 0|8@1+ (1,0) [0|3] "" ECU
 SG_ Gyro m0 : 8|32@1- (1,0) [0|0] "rad/s" ECU
 SG_ Accel m1 : 8|32@1- (1,0) [0|0] "m/s2" ECU
BO_ 101 Answer: 8 ECU
 SG_ Roll : 0|16@1- (0.01,0) [0|0] "" IMU
 SG_ Repeated : 16|4@1+ (1,0) [0|0] "" IMU
BO_ 2566844672 Speed: 8 ECU
 SG_ Roll : 0|16@1- (0.01,0) [0|0] "deg" IMU
SIG_VALTYPE_ 100 RateZ : 1;
SIG_VALTYPE_ 103 Gyro : 1;
SIG_VALTYPE_ 103 Accel : 1;
SIG_VALTYPE_ 2147484000 AngleZ : 1;
)";

constexpr const char* mapping_text = R"(
dbc = "ecu.dbc"
[units]
"Answer.Roll" = "deg"
[[play]]
messages = ["Turned", "Rates"]
every_ms = 20
latency_ms = 3
[play.signals]
"Rates.RateZ" = "-imu.rate.z"
"Turned.AngleZ" = "slave_imu.delta_theta_z"
"Rates.Time" = "time"
"Rates.Mode" = 7
[[hear]]
message = "Answer"
answers = "Rates"
echo = { signal = "Repeated", of = "Rates.Count" }
signals = { Roll = "attitude.roll" }
[[protection]]
messages = ["Rates"]
counter = { signal = "Count" }
)";

std::string scenario_text(const std::string& imu) {
  return fmt::format(R"(
title = "a turn"
duration_s = 1.0
seed = 3
[target]
mapping = "ecu.mapping.toml"
[truth]
latitude_deg = 0.0
longitude_deg = 0.0
height_m = 0.0
trajectory = "spiral"
speed_mps = 5.0
heading_deg = 0.0
turn_period_s = 10.0
[slave_imu]
period_ms = 10
{}
[[check]]
kind = "answers"
answers_at_least = 1
)",
                     imu);
}

Result<scenario::Scenario> read(const std::string& imu = "", std::string mapping = mapping_text) {
  return read_mapped(scenario_text(imu), std::move(mapping), dbc_text);
}

std::string mapping_with(const std::string& text, const std::string& instead) {
  std::string mapping = mapping_text;
  const auto at = mapping.find(text);
  EXPECT_NE(at, std::string::npos) << text;
  return mapping.replace(at, text.size(), instead);
}

// The frames that a run plays until its end.
struct Flown {
  explicit Flown(const scenario::Scenario& scenario)
      : mapping(dynamic_cast<const Mapping&>(*scenario.binding)),
        truth(*drive::make_truth(scenario)),
        conversation(mapping) {
    faults::Faults faults(scenario, 0, mapping.messages);
    Player player(conversation, {.scenario = scenario, .index = 0, .flight = truth, .faults = &faults});
    while (player.due_us() != nodes::never_us) {
      const std::int64_t due_us = player.due_us();
      nodes::Transmission out;
      player.transmit(out);
      clipped.add(out.clipped());
      if (out.frames().empty()) continue;
      due.push_back(due_us);
      for (const Frame& frame : out.frames()) frames.push_back(frame);
    }
    for (const auto& fault : faults.reports()) struck += fault.count;
  }
  [[nodiscard]] double value(std::size_t place, const char* signal) const {
    const Frame& frame = frames[place];
    const dbc::Message* message =
        dbc::find_message(mapping.targets.front().database, frame.id, frame.extended);
    const dbc::Signal& one = *dbc::find_signal(*message, signal);
    return dbc::to_physical(one, dbc::raw_bits(one, frame.payload()));
  }
  const Mapping& mapping;
  world::FlightRecord truth;
  Conversation conversation;
  std::vector<std::int64_t> due;
  std::vector<Frame> frames;
  nodes::Clipped clipped;
  std::uint64_t struck = 0;  // how often faults did
};

TEST(Player, AddsIncrementsUpAndTakesTheMeanOfRates) {
  const auto scenario = read();
  ASSERT_TRUE(scenario) << scenario.error().message;
  const Flown flown(*scenario);
  ASSERT_EQ(flown.due.size(), 49U) << "the last sample's 3 ms are after the end";
  ASSERT_EQ(flown.frames.size(), 98U);
  const auto exact = flown.truth.increments();
  for (std::size_t k = 0; k < flown.due.size(); ++k) {
    EXPECT_EQ(flown.due[k], 20'000 * static_cast<std::int64_t>(k + 1) + 3'000);
    const double turned = exact[2 * k].delta_theta.z() + exact[2 * k + 1].delta_theta.z();
    EXPECT_TRUE(flown.frames[2 * k].extended);
    EXPECT_EQ(flown.value(2 * k, "AngleZ"),
              static_cast<double>(static_cast<float>(turned / world::units::deg)));
    EXPECT_EQ(flown.value(2 * k + 1, "RateZ"), static_cast<double>(static_cast<float>(-turned / 0.02)));
    EXPECT_EQ(flown.value(2 * k + 1, "Time"), 20.0 * static_cast<double>(k + 1));
    EXPECT_EQ(flown.value(2 * k + 1, "Mode"), 7);
    EXPECT_EQ(flown.value(2 * k + 1, "Count"), static_cast<double>(k));
  }
  EXPECT_NEAR(flown.value(1, "RateZ"), -2 * std::numbers::pi / 10, 1e-3);
}

// The time stamps of a recording are irregular, because a frame may have waited for the bus or for the host.
// Each sample is played once, with the rate in its own row; the time since the previous row has no influence.
TEST(Player, PlaysEachRecordedRateWhateverItsStamp) {
  constexpr int samples = 99;
  const std::string file = testing::TempDir() + "canhil_player_test.csv";
  std::ofstream rows(file);
  rows << "t_s,rate_x_radps,rate_y_radps,rate_z_radps,specific_force_x_mps2,specific_force_y_mps2,"
          "specific_force_z_mps2\n";
  constexpr std::array<double, 5> late_ms{-0.1, 3, 17, 7.5, 0};  // row by row
  for (int k = 1; k <= samples; ++k)
    rows << fmt::format("{:.6f},0,0,{},0,0,-9.8\n", 1e-3 * (10 * k + late_ms[k % late_ms.size()]), k / 128.0);
  rows.close();
  const auto scenario =
      read(fmt::format("recorded = \"{}\"", file), mapping_with("every_ms = 20", "every_ms = 10"));
  ASSERT_TRUE(scenario) << scenario.error().message;
  const Flown flown(*scenario);
  ASSERT_EQ(flown.due.size(), samples);
  for (std::size_t k = 0; k < samples; ++k)
    EXPECT_FLOAT_EQ(static_cast<float>(flown.value(2 * k + 1, "RateZ")), static_cast<float>(k + 1) / -128.0F)
        << k;
}

TEST(Player, SaysWhatASignalCouldNotHold) {
  const auto scenario =
      read("", mapping_with("\"Turned.AngleZ\"", "\"Turned.Millis\" = \"time\"\n\"Turned.AngleZ\""));
  ASSERT_TRUE(scenario) << scenario.error().message;
  const Flown flown(*scenario);
  EXPECT_THAT(
      flown.clipped.to_text(),
      testing::ElementsAre("Turned.Millis holds 0 to 255 ms, its node measures 980 (37 times beyond)"))
      << "of 49: from 260 ms on";
  EXPECT_EQ(flown.value(2 * std::size_t{48}, "Millis"), 255);
}

// The heading is a little west of north. The bench's own heading is between -180 and 180 deg.
TEST(Player, SendsAnAngleAsTheEqualAngleThatTheSignalHolds) {
  const auto scenario =
      read("[master_ins]\nperiod_ms = 10\nattitude_bias_deg = [0, 0, 60]",
           mapping_with("\"Rates.Mode\" = 7", "\"Turned.Course\" = \"master_ins.heading\""));
  ASSERT_TRUE(scenario) << scenario.error().message;
  const Flown flown(*scenario);
  EXPECT_THAT(flown.clipped.to_text(), testing::IsEmpty());
  for (std::size_t k = 0; k < flown.due.size(); ++k) {
    const double heading =
        world::euler_from(flown.truth.at(20'000 * static_cast<std::int64_t>(k + 1)).C_bn).heading;
    const double wanted = std::remainder(heading / world::units::deg - 60, 360);
    ASSERT_LT(wanted, 0) << "otherwise this test proves nothing";
    EXPECT_NEAR(flown.value(2 * k, "Course"), wanted + 360, 1);
  }
}

// The flag of a fix is in another message (GpsLongitude) than the height of the fix (GpsLatitude).
TEST(Player, SendsAQuantityAsInvalidIfAFlagOfItsSampleGroupIs) {
  for (const bool valid : {true, false}) {
    const auto scenario =
        read(fmt::format("[gps]\nperiod_ms = 10\ninvalid_percent = {}", valid ? 0 : 100),
             mapping_with("\"Rates.Mode\" = 7",
                          "\"Rates.Mode\" = \"gps.height\"\n[play.invalid]\n\"Rates.Mode\" = 255"));
    ASSERT_TRUE(scenario) << scenario.error().message;
    const Flown flown(*scenario);
    ASSERT_EQ(flown.due.size(), 49U);
    for (std::size_t k = 0; k < flown.due.size(); ++k)
      EXPECT_EQ(flown.value(2 * k + 1, "Mode") == 255, !valid) << k;
  }
}

// Else the target would take a valid height for an invalid one.
TEST(Player, AValidValueThatIsRoundedToTheInvalidOneDoesNotFit) {
  std::string mapping = mapping_with(
      "\"Rates.Mode\" = 7", "\"Rates.Mode\" = \"imu.specific_force.z\"\n[play.invalid]\n\"Rates.Mode\" = 10");
  mapping.replace(mapping.find("[units]\n"), 8, "[units]\n\"Rates.Mode\" = \"m/s2\"\n");
  const auto positive = mapping.find("\"imu.specific_force.z\"");
  const auto scenario = read("", mapping.replace(positive + 1, 0, "-"));
  ASSERT_TRUE(scenario) << scenario.error().message;
  const Flown flown(*scenario);
  EXPECT_THAT(flown.clipped.to_text(), testing::ElementsAre(testing::MatchesRegex(
                                           "Rates.Mode holds .*its node measures 9.7.*49 times beyond.*")));
}

TEST(Player, ALostSampleUsesItsCounterUp) {
  const auto scenario = read("loss_percent = 30");
  ASSERT_TRUE(scenario) << scenario.error().message;
  const Flown flown(*scenario);
  EXPECT_LT(flown.due.size(), 45U);
  EXPECT_GT(flown.due.size(), 20U);
  for (std::size_t k = 0; k < flown.due.size(); ++k) {
    const std::int64_t sample = (flown.due[k] - 3'000) / 20'000 - 1;
    EXPECT_EQ(flown.value(2 * k + 1, "Count"), static_cast<double>(sample));
  }
}

Result<scenario::Scenario> with_fault(const std::string& kind, const std::string& more) {
  return read(fmt::format("[[fault]]\nkind = \"{}\"\nnode = \"slave_imu\"\n{}", kind, more));
}

// A fault that changes nothing on the bus cannot strike: what a check of it says would be about nothing.
TEST(Player, AFaultOfWhatIsNotPlayedIsRefused) {
  const auto refused = [](const std::string& tables, const std::string& mapping = mapping_text) {
    const auto scenario = read(tables, mapping);
    return scenario ? "nothing" : scenario.error().message;
  };
  EXPECT_THAT(refused("[[fault]]\nkind = \"bias\"\nquantity = \"imu.rate.x\"\nby_degps = 1"),
              testing::HasSubstr("'imu.rate.x' is in no message of the bench"));
  EXPECT_THAT(refused("[[fault]]\nkind = \"swapped\"\nquantity = \"imu.rate.z\"\nwith = \"imu.rate.x\""),
              testing::HasSubstr("'imu.rate.x' is in no message of the bench"));
  EXPECT_THAT(refused("[gps]\nperiod_ms = 10\n[[fault]]\nkind = \"silent\"\nnode = \"gps\""),
              testing::HasSubstr("'gps' is in no message of the bench"));
  EXPECT_THAT(refused("[gps]\nperiod_ms = 10\n[[fault]]\nkind = \"invalid\"\nquantity = \"gps.height\"",
                      mapping_with("\"Rates.Mode\" = 7", "\"Rates.Mode\" = \"gps.height\"")),
              testing::HasSubstr("has a validity that no message of the bench carries"));
  const std::string step = "[[fault]]\nkind = \"clock_step\"\nnode = \"slave_imu\"\nby_ms = 5";
  EXPECT_EQ(refused(step), "nothing");
  EXPECT_THAT(refused(step, mapping_with("\"Rates.Time\" = \"time\"\n", "")),
              testing::HasSubstr("'slave_imu' has no time in a message of the bench"));
}

TEST(Player, AFaultThatChangesNoSampleDoesNotStrike) {
  const auto struck = [](const char* at_degps) {
    const auto scenario = read(
        fmt::format("[[fault]]\nkind = \"saturated\"\nquantity = \"imu.rate.z\"\nat_degps = {}", at_degps));
    return Flown(*scenario).struck;
  };
  EXPECT_EQ(struck("37"), 0U) << "the turn has 36 deg/s";
  EXPECT_GE(struck("35"), 98U);
}

// A fault of a sensor acts on samples, so it is the same for every DBC.
TEST(Player, PlaysALateSampleLaterWithItsOwnTime) {
  const auto scenario = with_fault("late", "by_ms = 7\nfrom_s = 0.5\nto_s = 0.5");
  ASSERT_TRUE(scenario) << scenario.error().message;
  const Flown flown(*scenario);
  ASSERT_EQ(flown.due.size(), 49U);
  for (std::size_t k = 0; k < flown.due.size(); ++k) {
    EXPECT_EQ(flown.due[k], 20'000 * static_cast<std::int64_t>(k + 1) + (k == 24 ? 10'000 : 3'000)) << k;
    EXPECT_EQ(flown.value(2 * k + 1, "Time"), 20.0 * static_cast<double>(k + 1)) << k;
    EXPECT_EQ(flown.value(2 * k + 1, "Count"), static_cast<double>(k)) << k;
  }
}

TEST(Player, PlaysASlowSensorWithAllItsIncrements) {
  const auto turned = [](const Flown& flown) {
    double sum = 0;
    for (std::size_t k = 0; k < flown.due.size(); ++k) sum += flown.value(2 * k, "AngleZ");
    return sum;
  };
  const auto right = read(), slow = with_fault("slow", "longer_percent = 100\nfrom_s = 0.485");
  ASSERT_TRUE(right && slow) << slow.error().message;
  const Flown before(*right), after(*slow);
  EXPECT_EQ(before.due.size(), 49U);
  EXPECT_EQ(after.due.size(), 24U + 13U) << "every 40 ms from 490 ms on";
  const double last = 36.0 * 0.99, end = after.value(2 * 36, "AngleZ");
  EXPECT_NEAR(turned(after), last, 0.1) << "36 deg/s to 990 ms";
  EXPECT_NEAR(end, 36.0 * 0.04, 0.01);
}

TEST(Player, CountsOnAfterASilenceAndFromZeroAfterARestart) {
  for (const char* kind : {"silent\"\nto_s = 0.6\n#", "restart\"\nsilent_s = 0.1\n#"}) {
    const auto scenario =
        read(fmt::format("[[fault]]\nfrom_s = 0.5\nnode = \"slave_imu\"\nkind = \"{}", kind));
    ASSERT_TRUE(scenario) << scenario.error().message;
    const Flown flown(*scenario);
    const bool restarts = std::string(kind).starts_with("restart");
    for (std::size_t k = 0; k < flown.due.size(); ++k) {
      EXPECT_FALSE(flown.due[k] > 503'000 && flown.due[k] < 603'000) << flown.due[k];
      EXPECT_EQ(flown.value(2 * k + 1, "Count"), static_cast<double>(restarts && k >= 24 ? k - 24 : k)) << k;
    }
    EXPECT_GT(flown.due.size(), 40U);
  }
}

TEST(Player, PlaysTheTimeThatTheSensorReports) {
  const auto scenario = with_fault("clock_step", "by_ms = 5\nfrom_s = 0.5");
  ASSERT_TRUE(scenario) << scenario.error().message;
  const Flown flown(*scenario);
  for (std::size_t k = 0; k < flown.due.size(); ++k)
    EXPECT_EQ(flown.value(2 * k + 1, "Time"), 20.0 * static_cast<double>(k + 1) + (k < 24 ? 0 : 5)) << k;
}

// Two IMUs in one play: each has its own errors, the samples of one time are sent together, and a fault acts
// on one of them.
TEST(Player, PlaysASecondSensorOfAKind) {
  const std::string mapping = mapping_with("[units]", "[sensors]\nimu_b = \"slave_imu\"\n[units]");
  const std::string with_b = [&] {
    std::string text = mapping;
    const std::string mode = "\"Rates.Mode\" = 7";
    return text.replace(text.find(mode), mode.size(), "\"Turned.Course\" = \"imu_b.delta_theta_z\"");
  }();
  const auto flown_with = [&](const std::string& more, const std::string& keys) {
    return read(fmt::format("[[sensor]]\nname = \"imu_b\"\nkind = \"slave_imu\"\n{}\n{}", keys, more),
                with_b);
  };
  const auto scenario = flown_with("", "period_ms = 20\ngyro_bias_degph = [0, 0, 1.8e6]");
  ASSERT_TRUE(scenario) << scenario.error().message;
  const Flown flown(*scenario);
  ASSERT_EQ(flown.due.size(), 49U);
  for (std::size_t k = 0; k < flown.due.size(); ++k) {
    EXPECT_NEAR(flown.value(2 * k, "AngleZ"), 36 * 0.02, 1e-3) << k;
    EXPECT_NEAR(flown.value(2 * k, "Course"), std::round((36 + 500) * 0.02 / 1.5) * 1.5, 1e-9) << k;
  }
  const auto faulty = flown_with(
      "[[fault]]\nkind = \"changed\"\nquantity = \"imu_b.rate.z\"\nvalue_degps = 150", "period_ms = 20");
  ASSERT_TRUE(faulty) << faulty.error().message;
  const Flown spoilt(*faulty);
  EXPECT_NEAR(spoilt.value(0, "AngleZ"), 36 * 0.02, 1e-3);
  EXPECT_NEAR(spoilt.value(0, "Course"), 3, 1e-9);

  const auto refused = [](const Result<scenario::Scenario>& of) {
    return of ? "nothing" : of.error().message;
  };
  EXPECT_THAT(refused(read("[[sensor]]\nname = \"gps\"\nkind = \"slave_imu\"")),
              testing::HasSubstr("key 'sensor[1].name': 'gps' is a kind"));
  EXPECT_THAT(
      refused(read("[[sensor]]\nname = \"a\"\nkind = \"gps\"\n[[sensor]]\nname = \"a\"\nkind = \"gps\"")),
      testing::HasSubstr("key 'sensor[2].name': 'a' is the name of another sensor"));
  EXPECT_THAT(refused(read("", mapping_with("[units]", "[sensors]\ngps = \"gps\"\n[units]"))),
              testing::HasSubstr("key 'sensors.gps': is a kind"));
  const auto wrong = read("[[sensor]]\nname = \"imu_b\"\nkind = \"gps\"", with_b);
  ASSERT_TRUE(wrong);
  EXPECT_THAT(Player::check(dynamic_cast<const Mapping&>(*wrong->binding), *wrong).error().message,
              testing::HasSubstr("'imu_b' has another kind"));
  const auto uneven = flown_with("", "period_ms = 15");
  ASSERT_TRUE(uneven);
  EXPECT_THAT(drive::make_truth(*uneven).error().message,
              testing::HasSubstr("'imu_b.period_ms': 15 is not a multiple of the 10 ms of the fastest IMU"));
}

// Sensors that canhil.dbc does not carry: the speeds of a car's wheels in a turn of 36 deg/s to the right.
TEST(Player, PlaysASensorWithoutAMessageInCanhilsDbc) {
  std::string mapping = mapping_with("\"Rates.Mode\" = 7", "\"Turned.Course\" = \"dvl.velocity_x\"");
  const std::string units = "[units]\n", angle = "\"slave_imu.delta_theta_z\"";
  mapping.replace(mapping.find(units), units.size(),
                  units + "\"Turned.AngleZ\" = \"m/s\"\n\"Turned.Course\" = \"m/s\"\n");
  mapping.replace(mapping.find(angle), angle.size(), "\"wheels.front_left\"");
  const auto scenario = read(
      "[wheels]\nperiod_ms = 20\ntrack_m = 2\nscale_factor_ppm = 1e5\n"
      "[dvl]\nbias_mps = [1, 0, 0]\nperiod_ms = 20",
      mapping);
  ASSERT_TRUE(scenario) << scenario.error().message;
  const Flown flown(*scenario);
  ASSERT_EQ(flown.due.size(), 49U);
  const double turn = 2 * std::numbers::pi / 10;
  for (std::size_t k = 0; k < flown.due.size(); ++k) {
    EXPECT_NEAR(flown.value(2 * k, "AngleZ"), 1.1 * (5 + turn), 1e-3) << "the left wheel is outside";
    EXPECT_NEAR(flown.value(2 * k, "Course"), 6, 1e-9);
  }
}

// A mapping with two plays for the pages of one message.
std::string with_pages(int second) {
  return mapping_with("[[hear]]", fmt::format(R"([[play]]
messages = ["Paged"]
every_ms = 10
signals = {{ "Paged.Page" = 0, "Paged.Gyro" = "imu.rate.z" }}
[[play]]
messages = ["Paged"]
every_ms = 20
signals = {{ "Paged.Page" = {}, "Paged.Accel" = "-imu.specific_force.z" }}
[[hear]])",
                                              second));
}

TEST(Player, PlaysEachPageOfAMessage) {
  const auto scenario = read("", with_pages(1));
  ASSERT_TRUE(scenario) << scenario.error().message;
  const Flown flown(*scenario);
  std::array<int, 2> sent{};
  for (std::size_t k = 0; k < flown.frames.size(); ++k) {
    if (flown.frames[k].id != 103) continue;
    const bool second = flown.value(k, "Page") == 1;
    ++sent.at(second ? 1 : 0);
    EXPECT_NEAR(flown.value(k, second ? "Accel" : "Gyro"), second ? 9.78 : 2 * std::numbers::pi / 10, 0.01);
  }
  EXPECT_THAT(sent, testing::ElementsAre(100, 50));
  EXPECT_EQ(flown.mapping.plays[1].name, "Paged");
  EXPECT_EQ(flown.mapping.plays[2].name, "Paged Page=1");
  std::string of_first = with_pages(1);  // the first page has the name of the message
  of_first.replace(of_first.find("answers = \"Rates\"\necho"), 22, "answers = \"Paged\"\n#");
  const auto answered = read("", of_first);
  EXPECT_TRUE(answered) << answered.error().message;
  const auto twice = read("", with_pages(0));
  ASSERT_FALSE(twice);
  EXPECT_EQ(twice.error().message,
            "ecu.mapping.toml: Paged has Page=0 in two plays, expected each page once");
}

// The start state is told three times, each time with the same error of 5 deg to one side.
TEST(Player, TellsTheStartStateWithTheErrorsOfTheRun) {
  std::string mapping = mapping_with("[[hear]]", R"([[play]]
messages = ["Paged"]
every_ms = 50
signals = { "Paged.Page" = 0, "Paged.Gyro" = "start.heading" }
[[play]]
messages = ["Paged"]
every_ms = 50
signals = { "Paged.Page" = 1, "Paged.Accel" = "start.heading_sigma" }
[[hear]])");
  mapping.replace(mapping.find("[units]\n"), 8,
                  "[units]\n\"Paged.Gyro\" = \"rad\"\n\"Paged.Accel\" = \"deg\"\n");
  const std::string start = "[start]\nperiod_ms = 50\ntimes = 3\nheading_sigma_deg = 6\n";
  const auto scenario = read(start + "[initial_error]\nheading_magnitude_deg = 5\n", mapping);
  ASSERT_TRUE(scenario) << scenario.error().message;
  const Flown flown(*scenario);
  std::vector<double> errors;
  int sigmas = 0;
  for (std::size_t k = 0; k < flown.frames.size(); ++k) {
    if (flown.frames[k].id != 103) continue;
    if (flown.value(k, "Page") == 1) {
      EXPECT_NEAR(flown.value(k, "Accel"), 6, 1e-6);
      ++sigmas;
    } else {
      const double t_s = 0.05 * static_cast<double>(errors.size());
      errors.push_back(flown.value(k, "Gyro") - 2 * std::numbers::pi / 10 * t_s);
    }
  }
  ASSERT_EQ(errors.size(), 3U);
  EXPECT_EQ(sigmas, 3);
  EXPECT_NEAR(std::abs(errors[0]), 5 * std::numbers::pi / 180, 1e-4);
  for (const double error : errors) EXPECT_NEAR(error, errors[0], 1e-4);
  EXPECT_THAT(read("[initial_error]\nheading_magnitude_deg = 5\n").error().message,
              testing::HasSubstr("expected a table [start] beside it"));
}

// A target whose own task answers every second sample: no sample is owed an answer, and the latest one is the
// cause.
TEST(Listener, ATaskOfItsOwnAnswersTheLatestSample) {
  for (const bool has_task : {false, true}) {
    const auto scenario =
        read("", mapping_with("answers = \"Rates\"\necho = { signal = \"Repeated\", of = \"Rates.Count\" }",
                              has_task ? "answers = \"Rates\"\ntask_ms = 40" : "answers = \"Rates\""));
    ASSERT_TRUE(scenario) << scenario.error().message;
    Conversation all(dynamic_cast<const Mapping&>(*scenario->binding)), said(all.mapping);
    Flown flown(*scenario);
    Listener listener(said, {}, {}, true);
    std::int64_t t_ns = 0;
    int k = 0;
    for (const Sent& sent : flown.conversation.sent[0]) {
      said.add(0, sent);
      for (const Frame& frame : sent.frames) listener.transmitted(frame, t_ns += 1'000'000, 0);
      if (++k % 2 == 0) listener.received({.frame = {.id = 101, .size = 8}, .t_ns = t_ns += 1'000'000});
    }
    const checks::Observations seen = listener.finish();
    EXPECT_EQ(seen.timing.answers[all.mapping.hears[0].of.index].ambiguous.empty(), has_task);
    if (!has_task) continue;
    const auto& values = seen.of<Answers>().values.begin()->second;
    ASSERT_EQ(values.size(), 24U);
    std::int64_t valid_us = 0;
    for (const TimedValue& one : values) EXPECT_EQ(one.t_us, valid_us += 40'000);
    EXPECT_EQ(all.mapping.messages[all.mapping.hears[0].of.index].cycle_time_us, 40'000);
  }
}

TEST(J1939, GroupsAreKnownWithoutPrioritySourceAndDestination) {
  EXPECT_EQ(wire::j1939_group(0x18FEF100), 0xFEF1U) << "a broadcast";
  EXPECT_EQ(wire::j1939_group(0x0CFEF1FF), 0xFEF1U);
  EXPECT_EQ(wire::j1939_group(0x18EA2100), 0xEA00U) << "to the destination 0x21";
  EXPECT_EQ(wire::j1939_group(0x19FEF100), 0x1FEF1U) << "of data page 1";
  const auto scenario = read(
      "",
      mapping_with(
          "message = \"Answer\"\nanswers = \"Rates\"\necho = { signal = \"Repeated\", of = \"Rates.Count\" }",
          "message = \"Speed\"\nany_source = true"));
  ASSERT_TRUE(scenario) << scenario.error().message;
  const auto& mapping = dynamic_cast<const Mapping&>(*scenario->binding);
  const Places places(mapping);
  const std::size_t speed = mapping.hears.front().of.index;
  EXPECT_EQ(places(Frame{.id = 0x18FEF100, .size = 8, .extended = true}), speed);
  EXPECT_EQ(places(Frame{.id = 0x0CFEF122, .size = 8, .extended = true}), speed)
      << "from another, more urgent";
  EXPECT_EQ(places(Frame{.id = 0x18FEF200, .size = 8, .extended = true}), MessagePlaces::nowhere);
  EXPECT_EQ(places(Frame{.id = 0x100, .size = 8}), MessagePlaces::nowhere);
}

TEST(Conversation, FindsTheCauseByWhatIsRepeated) {
  const auto scenario = read();
  ASSERT_TRUE(scenario) << scenario.error().message;
  Flown flown(*scenario);
  const Hear& hear = flown.mapping.hears.front();
  const auto answer = [&](std::uint64_t repeated) {
    Frame frame{.id = 101, .size = 8};
    dbc::put_raw_bits(*hear.echo->repeated, repeated, {frame.data.data(), frame.size});
    return cause_of(flown.conversation, hear, frame.payload());
  };
  // An answer repeats the lowest four bits of the sample count. The newest count whose lowest bits are 3 is
  // 35 (35 mod 16 = 3); it is the count of the 36th sample.
  ASSERT_NE(answer(3), nullptr);
  EXPECT_EQ(answer(3)->valid_us, 36 * 20'000);
  EXPECT_EQ(answer(0)->valid_us, 49 * 20'000) << "48 mod 16";
}

TEST(Mapping, SaysWhatIsWrongInOneLine) {
  const auto refused = [](const std::string& text, const std::string& instead) {
    std::string mapping = mapping_text;
    const auto at = mapping.find(text);
    EXPECT_NE(at, std::string::npos) << text;
    const auto scenario = read("", mapping.replace(at, text.size(), instead));
    return scenario ? std::string("nothing") : scenario.error().message;
  };
  EXPECT_EQ(refused("\"Answer.Roll\" = \"deg\"", ""),
            "ecu.mapping.toml:18: key 'hear[1].signals.Roll': has no unit in the DBC, expected [units] with "
            "\"Answer.Roll\" = one of: rad, mrad, deg");
  EXPECT_EQ(
      refused("answers = \"Rates\"", "answers = \"Turned\""),
      "ecu.mapping.toml:16: key 'hear[1].answers': Turned is not the last message of its play, expected "
      "'Rates'");
  EXPECT_EQ(refused("every_ms = 20", ""),
            "ecu.mapping.toml:5: key 'play[1].every_ms': is missing, expected a number above 0");
  EXPECT_EQ(refused("message = \"Answer\"", "message = \"Rates\""),
            "ecu.mapping.toml:15: key 'hear[1].message': Rates is already used, expected each message "
            "once, or each page of a multiplexed message that the bench sends");
}

}  // namespace
}  // namespace canhil::mapping
