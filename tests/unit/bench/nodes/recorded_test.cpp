// Nodes that send recorded samples, from CSV rows and from logged frames.
#include "bench/nodes/recorded.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>

#include "bench/nodes/registry.hpp"
#include "bench/sensors/air_data.hpp"
#include "bench/sensors/dvl.hpp"
#include "bench/sensors/gps.hpp"
#include "bench/sensors/slave_imu.hpp"
#include "bench/sensors/wheels.hpp"
#include "bench/world/motion/rest.hpp"
#include "dbc/logs/candump.hpp"
#include "messages/canhil.hpp"
#include "tests/own_folder.hpp"
#include "tests/unit/bench/nodes/made.hpp"

namespace canhil::nodes {
namespace {

using namespace sensors;

using namespace messages;
using scenario::read_table;

constexpr std::int64_t second_us = 1'000'000;

world::FlightRecord one_second() { return {{.start = {}, .motion = world::Rest{}}, second_us, 10'000}; }

Result<RecordedSamples> samples_of(const sensors::Kind& sensor, const std::string& csv,
                                   std::int64_t period_us = 10'000, std::int64_t gap_us = 200'000) {
  return read_table(csv, "x.csv", columns_of(bound(sensor).table)).and_then([&](const scenario::Table& rows) {
    return read_samples(bound(sensor).table, rows, 0, gap_us, period_us, second_us);
  });
}

std::string error_of(const Result<RecordedSamples>& samples) {
  return samples ? "no error" : samples.error().message;
}

std::vector<Frame> sent(Node& node, std::vector<std::int64_t>* due = nullptr) {
  std::vector<Frame> frames;
  Transmission out;
  for (; node.due_us() != never_us; out.clear()) {
    if (due != nullptr) due->push_back(node.due_us());
    node.transmit(out);
    frames.insert(frames.end(), out.frames().begin(), out.frames().end());
  }
  return frames;
}

std::vector<Frame> sent(const sensors::Kind& sensor, RecordedSamples samples,
                        std::vector<std::int64_t>* due = nullptr) {
  const world::FlightRecord flight = one_second();
  static const scenario::Scenario any;
  const RecordedSettings own{.recorded_from = "x.csv",
                             .samples = std::make_shared<const RecordedSamples>(std::move(samples))};
  const auto node = make({bound(sensor).table, own}, {.scenario = any, .flight = flight});
  return sent(*node, due);
}

/// 100 rows per second, all with the same values.
std::string imu_rows(const std::string& names, const std::string& values) {
  std::string csv = "t_s," + names + "\n";
  for (int i = 0; i <= 100; ++i) csv += fmt::format("{:.2f},{}\n", 0.01 * i, values);
  return csv;
}

const std::string rate_names =
    "rate_x_degps,rate_y_degps,rate_z_degps,specific_force_x_g,specific_force_y_mps2,specific_force_z_mps2";

TEST(RecordedImu, RatesBecomeIncrementsWhoseSumIsKept) {
  const auto samples = samples_of(slave_imu, imu_rows(rate_names, "1,0,-2,0.1,0,-9.8"));
  ASSERT_TRUE(samples) << samples.error().message;
  std::vector<std::int64_t> due;
  const auto frames = sent(slave_imu, *samples, &due);
  ASSERT_EQ(frames.size(), 300U) << "the sample at 0 is of a time before the run";
  EXPECT_EQ(due.front(), 10'000);
  EXPECT_EQ(due.back(), second_us);
  double theta = 0, v = 0;
  for (const Frame& frame : frames) {
    if (frame.id == SlaveImuDeltaTheta::info.id)
      theta += from_frame<SlaveImuDeltaTheta>(frame).delta_theta_x_rad;
    if (frame.id == SlaveImuDeltaV::info.id) v += from_frame<SlaveImuDeltaV>(frame).delta_v_x_mps;
  }
  EXPECT_NEAR(theta, 3.14159265 / 180, 1.01e-6) << "half a step, however many samples";
  EXPECT_NEAR(v, 0.980665, 1.01e-5);
  const auto status = from_frame<SlaveImuStatus>(frames.back());
  EXPECT_EQ(status.interval_us, 10'000);
  EXPECT_EQ(status.time_of_validity_us, second_us);
  EXPECT_EQ(status.temperature_degc, 25);
  EXPECT_EQ(from_frame<SlaveImuDeltaTheta>(frames[0]).gyro_validity, Validity::valid);
}

TEST(RecordedImu, AMissingSampleLeavesAGapAndNoLongerInterval) {
  std::string csv = imu_rows(rate_names, "1,0,0,0,0,0");
  const std::size_t at = csv.find("0.50,");
  csv.erase(at, csv.find('\n', at) + 1 - at);
  const auto samples = samples_of(slave_imu, csv);
  ASSERT_TRUE(samples) << samples.error().message;
  EXPECT_EQ(samples->size(), 99U);
  EXPECT_EQ((*samples)[49].interval_us, 10'000) << "of the sample after the gap";
}

TEST(RecordedImu, WhatIsWrongIsOneLine) {
  const std::string names =
      "delta_theta_x_rad,delta_theta_y_rad,delta_theta_z_rad,delta_v_x_mps,delta_v_y_mps,delta_v_z_mps";
  EXPECT_EQ(error_of(samples_of(slave_imu, imu_rows("rate_x_degps", "1"))),
            "x.csv:1: column 'delta_theta_y_rad': is missing, expected it or 'delta_theta_y_deg', "
            "'delta_theta_y_mrad', "
            "or 'rate_y_radps', its rate");
  EXPECT_EQ(error_of(samples_of(slave_imu, imu_rows(names + ",rate_z_radps", "0,0,0,0,0,0,0"))),
            "x.csv:1: column 'rate_z_radps': is given beside 'delta_theta_z_rad', expected one of the two");
  EXPECT_EQ(error_of(samples_of(slave_imu, imu_rows(names, "0,0,0.2,0,0,0"))),
            "x.csv:3: column 'delta_theta_z_rad': 0.2 rad does not fit into signal delta_theta_z_rad, "
            "expected -0.131 to "
            "0.131");
  EXPECT_EQ(error_of(samples_of(slave_imu,
                                "t_s," + names + "\n0.01,0,0,0,0,0,0\n0.5,0,0,0,0,0,0\n1,0,0,0,0,0,0\n")),
            "x.csv:3: column 't_s': no sample from 0.01 to 0.5 s of the run, expected at most 0.2 s without "
            "(key 'gap_s'; "
            "'from_s' says where the run begins)");
  EXPECT_EQ(error_of(samples_of(slave_imu, "x\n1\n")),
            "x.csv:1: column 't_s': is missing, expected it or 't_ms', 't_us'");
}

TEST(RecordedGps, TakesItsSignalsByNameAndWrapsAngles) {
  const std::string csv =
      "t_s,latitude_deg,longitude_deg,height_m,horizontal_sigma_m,vertical_sigma_m,position_validity\n"
      "0.5,37.5,233,100,2,3,0\n1.0,37.6,234,101,2,3,1\n";
  const auto samples = samples_of(gps, csv, 500'000, second_us);
  ASSERT_TRUE(samples) << samples.error().message;
  const auto frames = sent(gps, *samples);
  ASSERT_EQ(frames.size(), 6U);
  EXPECT_NEAR(from_frame<GpsLatitude>(frames[0]).latitude_deg, 37.5, 1e-6);
  const auto first = from_frame<GpsLongitude>(frames[1]);
  EXPECT_NEAR(first.longitude_deg, -127, 1e-6);
  EXPECT_EQ(first.satellites, 9);
  EXPECT_EQ(first.position_validity, static_cast<Validity>(0));
  EXPECT_EQ(from_frame<GpsLongitude>(frames[4]).position_validity, static_cast<Validity>(1));
  EXPECT_EQ(from_frame<GpsTime>(frames[2]).time_of_validity_us, 500'000U);
}

// For every kind of node, recorded samples have a column for the time and a column for each signal of the
// node.
TEST(Recorded, EveryKindOfNodeHasColumns) {
  for (const Kind* kind : all()) {
    const auto columns = columns_of(kind->table);
    EXPECT_EQ(columns.front(), "t_s");
    EXPECT_GE(columns.size(), 2U) << kind->table.key;
    for (const SampleSignal& signal : kind->signals) {
      const bool measured = signal.role == sensors::Role::value || signal.role == sensors::Role::validity;
      EXPECT_EQ(std::ranges::count(columns, signal.info.name), measured ? 1 : 0) << signal.info.name;
    }
    for (const sensors::Output& output : kind->table.sensor->outputs.values)
      EXPECT_EQ(std::ranges::count(columns, output.rate_column), output.rate.empty() ? 0 : 1) << output.name;
  }
}

// A sensor that canhil.dbc does not carry has columns in SI.
TEST(Recorded, ASensorWithoutAMessageHasColumnsToo) {
  EXPECT_THAT(
      columns_of(bound(wheels).table),
      testing::ElementsAre("t_s", "front_left_mps", "front_right_mps", "rear_left_mps", "rear_right_mps"));
  EXPECT_THAT(columns_of(bound(dvl).table), testing::Contains("velocity_validity"));
  EXPECT_THAT(columns_of(bound(air_data).table),
              testing::IsSupersetOf({"static_pressure_pa", "temperature_k", "angle_of_attack_rad"}));
  std::string csv = "t_s,rear_right_mps,rear_left_mps,front_right_mps,front_left_mps\n";
  for (int k = 1; k <= 100; ++k) csv += fmt::format("{},4,3,2,{}\n", 0.01 * k, k);
  const auto samples = samples_of(wheels, csv);
  ASSERT_TRUE(samples) << samples.error().message;
  ASSERT_EQ(samples->size(), 100U);
  EXPECT_EQ(samples->at(9).valid_us, 100'000);
  EXPECT_THAT(std::span(samples->at(9).values).first(4), testing::ElementsAre(10, 2, 3, 4));
}

class Log {
 public:
  void sync(std::int64_t t_us) { add(to_frame(Sync{.time_us = static_cast<std::uint64_t>(t_us)}, 0)); }
  void add(const Frame& frame) {
    text_ += format_log_line({.t_ns = t_ns_ += 1000, .interface = "can0", .frame = frame}) + "\n";
  }
  void imu(std::int64_t t_us) {
    add(to_frame(SlaveImuDeltaTheta{.delta_theta_x_rad = 1e-3}, 5));
    add(to_frame(SlaveImuDeltaV{}, 5));
    add(to_frame(
        SlaveImuStatus{.time_of_validity_us = static_cast<std::uint32_t>(t_us), .interval_us = 10'000}, 5));
  }
  Result<LoggedGroup> read(std::int64_t end_us) const {
    const std::string path = test::own_folder() + "/recorded_nodes.log";
    std::ofstream(path) << text_;
    return read_frames(bound(slave_imu).table, path, end_us).map_error([&](const Error& error) {
      return Error{error.message.substr(error.message.find("recorded_nodes"))};
    });
  }

 private:
  std::string text_;
  std::int64_t t_ns_ = 1'600'000'000'000'000'000;
};

TEST(RecordedLog, FramesAreSentAsTheyWereBetweenTheSameSyncs) {
  Log log;
  log.sync(0);
  for (int k = 1; k <= 100; ++k) {
    log.imu(k * 10'000L);
    log.add(to_frame(GpsTime{}, 3));
    log.sync(k * 10'000L);
  }
  log.imu(second_us + 10'000);
  const auto group = log.read(second_us);
  ASSERT_TRUE(group) << group.error().message;
  EXPECT_EQ(group->median_us, 10'000);
  ASSERT_EQ(group->frames.frames.size(), 300U) << "GPS is another node; after the last Sync there is no time";
  const world::FlightRecord flight = one_second();
  static const scenario::Scenario any;
  const auto node = make_frames({&group->frames}, {.scenario = any, .flight = flight});
  std::vector<std::int64_t> due;
  const auto frames = sent(*node, &due);
  ASSERT_EQ(frames.size(), 300U);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_GT(due[i], static_cast<std::int64_t>(i / 3) * 10'000) << "after the Sync before";
    EXPECT_LE(due[i], static_cast<std::int64_t>(i / 3 + 1) * 10'000);
  }
  EXPECT_EQ(e2e::counter(frames[0].payload()), 5) << "not a counter of this run";
}

// A fault of a sensor acts on samples, so the frames of a log become samples again. Packed once more, they
// are the frames of the log; what the log lacks is a gap in the counters.
TEST(RecordedLog, ItsFramesBecomeSamplesAgain) {
  const world::FlightRecord flight = one_second();
  SlaveImuSettings settings;
  settings.errors.gyro.noise.setConstant(1e-3);
  settings.errors.gyro.bias.value.setConstant(1e-3);
  const auto frames = sent(*made(slave_imu, settings, flight));
  ASSERT_EQ(frames.size(), 300U);
  Log log;
  log.sync(0);
  std::vector<Frame> kept;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::size_t sample = i / 3;
    const bool lost = sample == 50 || i == 3 * std::size_t{70} + 1;
    if (!lost) log.add(frames[i]);
    if (sample != 50 && sample != 70) kept.push_back(frames[i]);
    if (i % 3 == 2) log.sync(static_cast<std::int64_t>(sample + 1) * 10'000);
  }
  const auto group = log.read(second_us);
  ASSERT_TRUE(group) << group.error().message;
  const RecordedSettings own{.recorded_from = "x.log",
                             .frames = std::make_shared<const RecordedFrames>(group->frames)};
  static const scenario::Scenario any;
  const NodeSettings node{bound(slave_imu).table, own};
  const auto sensor = make_logged(node, {.scenario = any, .flight = flight});
  for (int k = 1; k <= 100; ++k) {
    const std::int64_t due_us = sensor->due_us();
    const sensors::Sample sample = sensor->measure();
    const bool lost = k == 51 || k == 71;
    EXPECT_EQ(sample.fate == sensors::Sample::Fate::lost, lost) << k;
    EXPECT_EQ(sample.valid_us, (lost ? k + 1 : k) * 10'000) << k;
    EXPECT_TRUE(due_us > sample.valid_us - 10'000 && due_us <= sample.valid_us) << due_us;
  }
  EXPECT_EQ(sensor->due_us(), never_us);
  EXPECT_EQ(sent(*make(node, {.scenario = any, .flight = flight})), kept);
}

TEST(RecordedLog, OfNoRunIsRefused) {
  Log none, short_one, two;
  none.imu(10'000);
  EXPECT_EQ(none.read(second_us).error().message,
            "recorded_nodes.log: has no Sync, expected the log of a run, which has a time base");
  short_one.sync(0);
  short_one.sync(10'000);
  EXPECT_EQ(short_one.read(second_us).error().message,
            "recorded_nodes.log: has 0 samples of SlaveImu, expected those of a run");
  short_one.imu(20'000);
  short_one.imu(30'000);
  short_one.sync(30'000);
  EXPECT_EQ(short_one.read(second_us).error().message,
            "recorded_nodes.log: ends at 0.03 s of its time base, expected the 1 s of the run");
  two.sync(20'000);
  two.sync(10'000);
  EXPECT_EQ(two.read(second_us).error().message,
            "recorded_nodes.log: Sync goes from 0.02 s back to 0.01 s, expected the log of one run");
}

}  // namespace
}  // namespace canhil::nodes
