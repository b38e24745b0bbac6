// Runs with recorded data, as a user starts them: replayed logs of runs, CSV files, a flight without truth.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "dbc/logs/candump.hpp"
#include "dbc/wire/message.hpp"
#include "messages/canhil.hpp"
#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// The text with the lines of a TOML table replaced; a comment may follow the table's header.
std::string with_table(const std::string& text, const std::string& table, const std::string& lines) {
  const std::size_t at = text.find("\n[" + table + "]") + 1;
  const std::size_t header_end = text.find('\n', at), end = text.find("\n[", header_end);
  if (at == 0) ADD_FAILURE() << "there is no [" << table << "]";
  return at == 0 ? text : text.substr(0, header_end + 1) + lines + text.substr(end);
}

/// The line of a TOML table that begins with this word, including the line end. Empty if the table has no
/// such line.
std::string line_of(const std::string& text, const std::string& table, const std::string& word) {
  const std::size_t at = text.find("\n[" + table + "]");
  const std::size_t end = text.find("\n[", at + 1), found = text.find("\n" + word, at);
  return found < end ? text.substr(found + 1, text.find('\n', found + 1) - found) : "";
}

std::string write(const std::string& name, const std::string& text) {
  std::string path = scratch(name);
  std::ofstream(path) << text;
  return path;
}

/// The text of a scenario whose target is not told the data sheets of the sensors: recorded sensors have
/// none.
std::string without_data_sheets(const std::string& name) {
  std::string text = read(scenario(name));
  for (const std::string header : {"\n[target]\n", "\n[[target]]\n"}) {
    for (std::size_t at = text.find(header); at != std::string::npos; at = text.find(header, at + 1))
      text.insert(at + header.size(), "data_sheets = \"withheld\"\n");
  }
  return text;
}

struct Case {
  std::string scenario;
  std::vector<std::string> nodes;
  friend void PrintTo(const Case& one, std::ostream* out) { *out << one.scenario; }
};

class LogFlownAgain : public testing::TestWithParam<Case> {};

// In lockstep the target receives the same frames in the same order and returns the same bits.
TEST_P(LogFlownAgain, GivesTheSameAnswers) {
  const std::string name = GetParam().scenario;
  const std::string log = scratch(name + ".log"), again = scratch(name + ".again.log");
  std::string text = without_data_sheets(name);
  const Ended first =
      hil_bench(fmt::format("run {} --lockstep --bus {} --log {}", write(name + ".toml", text), bus(), log));
  ASSERT_NE(first.code, 2) << first.err;
  for (const std::string& node : GetParam().nodes)
    text = with_table(text, node,
                      line_of(text, node, "period_ms") +
                          fmt::format("recorded = \"{}\"\n", std::filesystem::path(log).filename().string()));
  const std::string own = write(name + ".again.toml", text);
  const Ended second = hil_bench(fmt::format("run {} --lockstep --bus {} --log {}", own, bus(), again));
  ASSERT_NE(second.code, 2) << second.err;
  const Ended none = hil_bench(fmt::format("diverge {} {}", log, again));
  EXPECT_EQ(none.code, 0) << none.out;
  EXPECT_GT(target_frames(log).size(), 500U);

  // If one increment in the middle of the log is changed, the answers must change.
  auto reader = LogReader::open(log);
  ASSERT_TRUE(reader);
  std::string changed;
  std::size_t samples = 0;
  for (auto entry = reader->next(); entry && *entry; entry = reader->next()) {
    LogEntry& one = **entry;
    if (one.frame.id == messages::SlaveImuDeltaV::info.id && ++samples == 100) {
      auto message = from_frame<messages::SlaveImuDeltaV>(one.frame);
      message.delta_v_y_mps += 0.1;
      one.frame = to_frame(message, e2e::counter(one.frame.payload()));
    }
    changed += format_log_line(one) + "\n";
  }
  write(name + ".log", changed);
  const std::string other = scratch(name + ".other.log");
  EXPECT_NE(hil_bench(fmt::format("run {} --lockstep --bus {} --log {}", own, bus(), other)).code, 2);
  const Ended differs = hil_bench(fmt::format("diverge {} {}", again, other));
  EXPECT_EQ(differs.code, 1) << differs.out << differs.err;
}

INSTANTIATE_TEST_SUITE_P(Scenarios, LogFlownAgain,
                         testing::Values(Case{"transfer_alignment_quick", {"master_ins", "slave_imu"}},
                                         Case{"all_four",
                                              {"master_ins", "slave_imu", "ssbl", "gps", "seeker",
                                               "glider_nav", "fins"}}),
                         [](const auto& one) { return one.param.scenario; });

/// The IMU and master samples of a log as CSV files, as a user would have them.
struct Csv {
  std::string imu =
      "t_s,delta_theta_x_rad,delta_theta_y_rad,delta_theta_z_rad,delta_v_x_mps,delta_v_y_mps,"
      "delta_v_z_mps\n";
  std::string master =
      "t_ms,velocity_north_mps,velocity_east_mps,velocity_down_mps,roll_deg,pitch_deg,"
      "heading_rad,latitude_deg,longitude_deg,height_m\n";
};

Csv csv_of(const std::string& log) {
  using namespace messages;
  Csv csv;
  auto reader = LogReader::open(log);
  EXPECT_TRUE(reader);
  SlaveImuDeltaTheta theta;
  SlaveImuDeltaV v;
  MasterInsVelocityNE horizontal;
  MasterInsAttitude attitude;
  MasterInsLatitude latitude;
  MasterInsLongitude longitude;
  for (auto entry = reader->next(); entry && *entry; entry = reader->next()) {
    const Frame& frame = (*entry)->frame;
    const auto is = [&](const MessageInfo& info) { return frame.id == info.id; };
    if (is(SlaveImuDeltaTheta::info)) theta = from_frame<SlaveImuDeltaTheta>(frame);
    if (is(SlaveImuDeltaV::info)) v = from_frame<SlaveImuDeltaV>(frame);
    if (is(MasterInsVelocityNE::info)) horizontal = from_frame<MasterInsVelocityNE>(frame);
    if (is(MasterInsAttitude::info)) attitude = from_frame<MasterInsAttitude>(frame);
    if (is(MasterInsLatitude::info)) latitude = from_frame<MasterInsLatitude>(frame);
    if (is(MasterInsLongitude::info)) longitude = from_frame<MasterInsLongitude>(frame);
    if (is(SlaveImuStatus::info))
      csv.imu += fmt::format("{},{:.6f},{:.6f},{:.6f},{:.5f},{:.5f},{:.5f}\n",
                             1e-6 * from_frame<SlaveImuStatus>(frame).time_of_validity_us,
                             theta.delta_theta_x_rad, theta.delta_theta_y_rad, theta.delta_theta_z_rad,
                             v.delta_v_x_mps, v.delta_v_y_mps, v.delta_v_z_mps);
    if (is(MasterInsVelocityD::info)) {
      const auto down = from_frame<MasterInsVelocityD>(frame);
      csv.master +=
          fmt::format("{},{},{},{},{},{},{:.9f},{:.7f},{:.7f},{:.1f}\n", 1e-3 * down.time_of_validity_us,
                      horizontal.velocity_north_mps, horizontal.velocity_east_mps, down.velocity_down_mps,
                      attitude.roll_deg, attitude.pitch_deg, attitude.heading_deg * 3.14159265358979 / 180,
                      latitude.latitude_deg, longitude.longitude_deg, latitude.height_m);
    }
  }
  return csv;
}

// A flight with the samples of an earlier run as CSV files: the answers are the same bits, whatever the units
// of the columns are.
TEST(RecordedData, TheSamplesOfARunAsCsvFilesGiveTheSameAnswers) {
  const std::string log = scratch("csv.log"), again = scratch("csv.again.log");
  std::string text = without_data_sheets("transfer_alignment_quick");
  ASSERT_NE(
      hil_bench(fmt::format("run {} --lockstep --bus {} --log {}", write("csv.first.toml", text), bus(), log))
          .code,
      2);
  const Csv csv = csv_of(log);
  write("imu.csv", csv.imu);
  write("master.csv", csv.master);
  text = with_table(text, "slave_imu", "recorded = \"imu.csv\"\n");
  text = with_table(text, "master_ins", "recorded = \"master.csv\"\n");
  const std::string own = write("csv.toml", text);
  const Ended second = hil_bench(fmt::format("run {} --lockstep --bus {} --log {}", own, bus(), again));
  ASSERT_NE(second.code, 2) << second.err;
  const Ended none = hil_bench(fmt::format("diverge {} {}", log, again));
  EXPECT_EQ(none.code, 0) << none.out;
}

// Without a truth, the NIS can be judged, but errors cannot.
TEST(RecordedData, WithoutATruthErrorsAreNotMeasuredAndConsistencyIs) {
  const std::string log = scratch("unknown.log"), json = scratch("unknown.json");
  ASSERT_NE(hil_bench(fmt::format("run {} --lockstep --bus {} --log {}", scenario("transfer_alignment_quick"),
                                  bus(), log))
                .code,
            2);
  std::string text = read(scenario("transfer_alignment_quick"));
  const std::size_t truth = text.find("[truth]"), master = text.find("[master_ins]");
  text = text.substr(0, truth) + R"([truth]
trajectory = "unknown"
latitude_deg = 37.0
longitude_deg = 127.0
height_m = 1000.0
velocity_mps = [138.9, 0.0, 0.0]
heading_deg = 0.0

)" + text.substr(master);
  text = with_table(text, "slave_imu", "recorded = \"unknown.log\"\n");
  const std::string measures = write("measures.toml", text);
  expect_one_line(hil_bench("run " + measures), "key 'master_ins': has no truth to measure");
  text = with_table(text, "master_ins", "recorded = \"unknown.log\"\n");
  const std::string own = write("unknown.toml", text);
  const Ended ended = hil_bench(
      fmt::format("run {} --lockstep --bus {} --json {} --csv {}", own, bus(), json, scratch("unknown.csv")));
  EXPECT_EQ(ended.code, 3) << ended.out << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("not measured: no truth: trajectory is \"unknown\""));
  int errors = 0, innovations = 0;
  const nlohmann::json report = read_json(json);
  for (const nlohmann::json& check : report["checks"]) {
    const bool of_truth = check["kind"] == "error";
    if (of_truth) {
      EXPECT_EQ(check["outcome"], "not measured") << check;
      EXPECT_EQ(check["measured"], "no truth: trajectory is \"unknown\"") << check;
      ++errors;
    } else if (check["kind"] == "consistency") {
      EXPECT_EQ(check["outcome"], "pass") << check;
      ++innovations;
    }
  }
  EXPECT_GE(errors, 3);
  EXPECT_EQ(innovations, 1);
  const std::string csv = read(scratch("unknown.csv"));
  EXPECT_THAT(csv, HasSubstr("innovation.nis"));
  EXPECT_THAT(csv, testing::Not(HasSubstr("nan")));
}

// The error message about an invalid CSV file states the line of this file and what was expected.
TEST(RecordedData, AWrongFileIsOneLine) {
  write("rows.csv", "t_s,rate_x_degps\n0.01,1\n0.02,2\n");
  std::string text = read(scenario("transfer_alignment_quick"));
  const std::string own = write("wrong.toml", with_table(text, "slave_imu", "recorded = \"rows.csv\"\n"));
  expect_one_line(hil_bench("run " + own),
                  "rows.csv:1: column 'delta_theta_y_rad': is missing, expected it or 'delta_theta_y_deg'");
  const std::string none = write("none.toml", with_table(text, "slave_imu", "recorded = \"none.log\"\n"));
  expect_one_line(hil_bench("run " + none), "none.log: cannot be read (No such file or directory)");
}

}  // namespace
}  // namespace canhil::test
