// An in-process run with recorded data gives the same results as the flight that was recorded.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>

#include "bench/drive/contract.hpp"
#include "bench/drive/flight.hpp"
#include "bench/drive/session.hpp"
#include "bench/estimators/navigation.hpp"
#include "bench/estimators/transfer_alignment/answers.hpp"
#include "bench/world/units.hpp"
#include "tests/own_folder.hpp"

namespace canhil::drive {
namespace {

using testing::HasSubstr;
using world::units::deg;

// A weave of 40 s; in this time, the transfer alignment converges.
constexpr std::string_view per_run_truth = R"(trajectory = "weave"
latitude_deg = 37.0
longitude_deg = 127.0
height_m = 1000.0
heading_deg = 20.0
speed_kmph = 500.0
heading_amplitude_deg = 20.0
turn_period_s = 15.0
pitch_amplitude_deg = 4.0
pitch_period_s = 11.0
)";

std::string scenario_text(std::string_view truth) {
  return fmt::format(R"(title = "Own data"
duration_s = 40.0
seed = 3
[target]
estimator = "transfer_alignment"
algorithm = "kalman"
initial_sigma = {{ velocity_mps = 1.0, tilt_deg = 2.0, heading_deg = 2.0, position_m = 10.0 }}
[truth]
{}
[initial_error]
velocity_sigma_mps = 1.0
attitude_sigma_deg = 2.0
[master_ins]
velocity_noise_mps = 0.05
[slave_imu]
accel_bias_sigma_ug = 300
gyro_bias_sigma_degph = 3
[[check]]
kind = "heartbeat"
silent_at_most_s = 0.5
)",
                     truth);
}

std::string csv_of(const world::FlightRecord& record, std::int64_t every_us) {
  std::string csv =
      "t_s,latitude_deg,longitude_deg,height_m,velocity_north_mps,velocity_east_mps,velocity_down_mps,"
      "roll_deg,pitch_deg,heading_deg\n";
  for (std::int64_t t_us = 0; t_us <= record.end_us(); t_us += every_us) {
    const world::Truth at = record.at(t_us);
    const world::Euler angles = world::euler_from(at.C_bn);
    csv += fmt::format("{:.6f},{:.9f},{:.9f},{:.4f},{:.6f},{:.6f},{:.6f},{:.7f},{:.7f},{:.7f}\n",
                       1e-6 * static_cast<double>(t_us), at.position.latitude / deg,
                       world::longitude_deg(at.position), at.position.height, at.v_eb_n.x(), at.v_eb_n.y(),
                       at.v_eb_n.z(), angles.roll / deg, angles.pitch / deg, angles.heading / deg);
  }
  return csv;
}

struct Flown {
  Spool<estimators::NavigationError> errors;
  Spool<estimators::FilterAnswer> filter;
};

Flown fly(const std::string& text, const std::string& folder) {
  const auto scenario = scenario::parse(text, "own.toml", contract(), {}, folder);
  EXPECT_TRUE(scenario) << scenario.error().message;
  const auto truth = make_truth(*scenario);
  EXPECT_TRUE(truth) << truth.error().message;
  auto collected = run_in_process(*scenario, *truth, 0);
  EXPECT_TRUE(collected) << collected.error().message;
  EXPECT_EQ(collected->ending.kind, Ending::Kind::completed) << collected->ending.detail;
  const auto& answers = collected->seen.of<estimators::TransferAnswers>();
  return {answers.navigation.errors(*truth), answers.filter};
}

std::string folder() { return test::own_folder(); }

void write(const std::string& name, const std::string& text) { std::ofstream(folder() + "/" + name) << text; }

double rms(const Spool<estimators::NavigationError>& errors, std::int64_t from_us) {
  double sum = 0;
  int count = 0;
  for (const auto& error : errors) {
    if (error.t_us < from_us) continue;
    sum += error.misalignment.squaredNorm();
    ++count;
  }
  return std::sqrt(sum / count);
}

// With the same seed, the analytic flight and the recorded flight have the same errors of the sensors and of
// the initial state. The flights differ only by the interpolation and the rounding of the file, which are
// small compared with the errors of the alignment. The ratio of the errors differs from 1 by at most 8e-6; a
// single frame that is rounded in the other direction can multiply this difference.
TEST(RecordedTruth, GivesTheErrorsOfTheFlightThatItWasRecordedOf) {
  const std::string analytic = scenario_text(per_run_truth);
  const auto scenario = scenario::parse(analytic, "own.toml", contract());
  ASSERT_TRUE(scenario) << scenario.error().message;
  const auto truth = make_truth(*scenario);
  ASSERT_TRUE(truth);
  const Flown own = fly(analytic, folder());
  ASSERT_GT(own.errors.size(), 1000U);
  for (const std::int64_t every_us : {10'000, 20'000}) {
    write("flight.csv", csv_of(*truth, every_us));
    const Flown recorded = fly(scenario_text("trajectory = \"recorded\"\nfile = \"flight.csv\"\n"), folder());
    ASSERT_EQ(recorded.errors.size(), own.errors.size());
    for (const std::int64_t from_us : {1'000'000, 30'000'000}) {
      EXPECT_NEAR(rms(recorded.errors, from_us) / rms(own.errors, from_us), 1, 1e-4)
          << every_us << " us, from " << from_us << " us";
    }
  }
}

TEST(RecordedTruth, TooFewRowsForTheImuAreRefused) {
  const auto scenario = scenario::parse(scenario_text(per_run_truth), "own.toml", contract());
  ASSERT_TRUE(scenario);
  const auto truth = make_truth(*scenario);
  write("coarse.csv", csv_of(*truth, 200'000));
  const auto coarse = scenario::parse(scenario_text("trajectory = \"recorded\"\nfile = \"coarse.csv\"\n"),
                                      "own.toml", contract(), {}, folder());
  ASSERT_TRUE(coarse) << coarse.error().message;
  const auto refused = make_truth(*coarse);
  ASSERT_FALSE(refused);
  EXPECT_EQ(
      refused.error().message,
      "key 'truth.file': a row every 200 ms (median) is too few for an IMU of 10 ms, expected one in 10 "
      "of its intervals at least");
}

}  // namespace
}  // namespace canhil::drive
