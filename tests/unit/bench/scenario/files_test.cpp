// The scenarios of the project are valid with the project's own DBC.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>

#include "bench/bindings/canhil.hpp"
#include "bench/checks/judge.hpp"
#include "bench/estimators/registry.hpp"
#include "bench/estimators/vocabulary.hpp"
#include "bench/plant/registry.hpp"
#include "bench/sensors/gps.hpp"
#include "bench/sensors/master_ins.hpp"
#include "bench/sensors/slave_imu.hpp"
#include "bench/sensors/ssbl.hpp"
#include "bench/world/units.hpp"
#include "tests/unit/bench/scenario/texts.hpp"

namespace canhil::scenario {
namespace {

std::string dbc() {
  std::ifstream file(SOURCE_DIR "/dbc/canhil.dbc");
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it)
    found.push_back((*it)[1]);
  return found;
}

std::vector<std::string> value_table(const std::string& text, const std::string& name) {
  const auto tables = matches(text, "\nVAL_TABLE_ " + name + " ([^;]*);");
  return tables.empty() ? std::vector<std::string>{} : matches(tables[0], "\"([a-z0-9_]+)\"");
}

std::vector<std::string> answers(const std::string& text) {
  std::vector<std::string> names;
  for (const std::string& id : matches(text, "\nBA_ \"Answers\" BO_ ([0-9]+) "))
    names.push_back(matches(text, "\nBO_ " + id + " ([A-Za-z]+):").at(0));
  return names;
}

DbcVocabulary of_the_dbc() {
  const std::string text = dbc();
  return {.estimators = value_table(text, "Estimator"),
          .algorithms = value_table(text, "Algorithm"),
          .parameters = value_table(text, "Parameter"),
          .messages = matches(text, "\nBO_ [0-9]+ ([A-Za-z]+):"),
          .answers = answers(text),
          .check_kinds = checks::kinds(estimators::all()),
          .known = estimators::all(),
          .facts = estimators::bound_to({}, bindings::canhil()).facts,
          .nodes = nodes::tables(),
          .binding = bindings::canhil(),
          .plants = plant::tables()};
}

TEST(ScenarioFiles, AreAllValid) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SOURCE_DIR "/bench/flights")) {
    const auto scenario = read_file(entry.path(), of_the_dbc());
    EXPECT_TRUE(scenario) << scenario.error().message;
    ++count;
  }
  EXPECT_GE(count, 3);
}

TEST(ScenarioFiles, TheKalmanFilterIsConfiguredWithTheTruth) {
  const auto s = read_file(SOURCE_DIR "/bench/flights/transfer_alignment.toml", of_the_dbc()).value();
  EXPECT_EQ(s.targets.front().algorithm, "kalman");
  EXPECT_DOUBLE_EQ(s.targets.front().initial_sigma.heading, s.initial_error.attitude.sigma.z());
  EXPECT_DOUBLE_EQ(s.targets.front().initial_sigma.tilt, s.initial_error.attitude.sigma.x());
  EXPECT_DOUBLE_EQ(s.targets.front().initial_sigma.velocity, s.initial_error.velocity.sigma.x());
  for (const Parameter& parameter : s.targets.front().parameters) {
    const auto imu = node_of<sensors::SlaveImuSettings>(s).errors;
    if (parameter.name == "velocity_noise_m2ps") {
      // The density is sigma^2 times the interval. The interval is 100 ms, the cycle time of the master's
      // velocity in the DBC.
      EXPECT_NEAR(parameter.value,
                  0.1 * std::pow(node_of<sensors::MasterInsSettings>(s).errors.velocity.sigma.x(), 2), 1e-15);
    } else if (parameter.name == "accel_bias_sigma_ug") {
      EXPECT_NEAR(parameter.value * world::units::ug, imu.accel.bias.sigma.x(), 1e-15);
    } else if (parameter.name == "gyro_noise_degprth") {
      EXPECT_NEAR(parameter.value * world::units::degprth, imu.gyro.noise.x(), 1e-15);
    }
  }
}

TEST(ScenarioFiles, TheH2FilterIsConfiguredWithOneDegreeOfFive) {
  const auto s = read_file(SOURCE_DIR "/bench/flights/transfer_alignment_h2.toml", of_the_dbc()).value();
  EXPECT_EQ(s.targets.front().algorithm, "robust_h2");
  EXPECT_DOUBLE_EQ(s.targets.front().initial_sigma.heading, 1 * world::units::deg);
  EXPECT_DOUBLE_EQ(s.initial_error.attitude.sigma.z(), 5 * world::units::deg);
  EXPECT_TRUE(node_of<sensors::MasterInsSettings>(s).errors.velocity.sigma.isZero());
}

TEST(ScenarioFiles, TheFiltersOfInFlightAlignmentAreConfiguredWithTheTruth) {
  for (const std::string name : {"inflight_ssbl", "inflight_gps", "inflight_ssbl_180", "inflight_quick"}) {
    const auto s = read_file(SOURCE_DIR "/bench/flights/" + name + ".toml", of_the_dbc()).value();
    const auto parameter = [&](std::string_view wanted) {
      const auto found = std::ranges::find(s.targets.front().parameters, wanted, &Parameter::name);
      return found == s.targets.front().parameters.end() ? std::nan("") : found->value;
    };
    EXPECT_EQ(s.targets.front().algorithm, "sin_cos");
    EXPECT_DOUBLE_EQ(s.targets.front().initial_sigma.tilt, s.initial_error.attitude.sigma.x());
    EXPECT_DOUBLE_EQ(s.targets.front().initial_sigma.velocity, s.initial_error.velocity.sigma.x());
    EXPECT_DOUBLE_EQ(s.targets.front().initial_sigma.position, s.initial_error.position.sigma.x());
    EXPECT_GE(s.targets.front().initial_sigma.heading, s.initial_error.heading_magnitude);
    const auto imu = node_of<sensors::SlaveImuSettings>(s).errors;
    EXPECT_NEAR(parameter("accel_bias_sigma_ug") * world::units::ug, imu.accel.bias.sigma.x(), 1e-15);
    EXPECT_NEAR(parameter("gyro_bias_sigma_degph") * world::units::degph, imu.gyro.bias.sigma.x(), 1e-15);
    EXPECT_NEAR(parameter("accel_noise_ugprthz") * world::units::ugprthz, imu.accel.noise.x(), 1e-15);
    EXPECT_NEAR(parameter("gyro_noise_degprth") * world::units::degprth, imu.gyro.noise.x(), 1e-15);
    const bool gps = s.node("gps") != nullptr;
    EXPECT_EQ(parameter("aiding"), gps ? 1.0 : 0.0);
    const world::Vector3 noise =
        gps ? node_of<sensors::GpsSettings>(s).noise : node_of<sensors::SsblSettings>(s).noise;
    EXPECT_EQ(parameter("fix_noise_horizontal_m"), noise.x());
    EXPECT_EQ(parameter("fix_noise_vertical_m"), noise.z());
    if (gps) {
      EXPECT_EQ(parameter("initial_height_sigma_m"), s.initial_error.position.sigma.z());
    } else {
      const auto ssbl = node_of<sensors::SsblSettings>(s);
      EXPECT_NEAR(parameter("fix_bias_sigma_m"), std::hypot(ssbl.bias.sigma.x(), ssbl.ship_error.sigma.x()),
                  1e-6);
    }
  }
}

}  // namespace
}  // namespace canhil::scenario
