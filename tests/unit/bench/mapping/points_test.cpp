// The quantities that the bench derives from those which a mapped target reports, and sigmas in messages of
// their own. The mapping is a text in the test; the answers are put in by hand.
#include "bench/mapping/points.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <map>

#include "bench/drive/flight.hpp"
#include "bench/world/earth.hpp"
#include "tests/unit/bench/mapping/read_mapped.hpp"

namespace canhil::mapping {
namespace {

constexpr const char* dbc_text = R"(VERSION ""
BU_: IMU ECU
BO_ 100 Rates: 8 IMU
 SG_ RateZ : 0|32@1- (1,0) [0|0] "rad/s" ECU
BO_ 101 Place: 24 ECU
 SG_ Lat : 0|32@1- (1,0) [0|0] "deg" IMU
 SG_ Lon : 32|32@1- (1,0) [0|0] "deg" IMU
 SG_ Height : 64|32@1- (1,0) [0|0] "m" IMU
BO_ 102 Sigmas: 24 ECU
 SG_ LatSigma : 0|32@1- (1,0) [0|0] "m" IMU
 SG_ LonSigma : 32|32@1- (1,0) [0|0] "m" IMU
 SG_ HeightSigma : 64|32@1- (1,0) [0|0] "m" IMU
 SG_ LatLon : 96|32@1- (1,0) [0|0] "" IMU
BO_ 103 Innovation: 24 ECU
 SG_ North : 0|32@1- (1,0) [0|0] "m/s" IMU
 SG_ East : 32|32@1- (1,0) [0|0] "m/s" IMU
 SG_ Down : 64|32@1- (1,0) [0|0] "m/s" IMU
 SG_ NorthSigma : 96|32@1- (1,0) [0|0] "m/s" IMU
 SG_ EastSigma : 128|32@1- (1,0) [0|0] "m/s" IMU
 SG_ DownSigma : 160|32@1- (1,0) [0|0] "m/s" IMU
BA_DEF_ BO_ "VFrameFormat" ENUM "StandardCAN","ExtendedCAN","reserved","reserved","reserved","reserved","reserved","reserved","reserved","reserved","reserved","reserved","reserved","reserved","StandardCAN_FD","ExtendedCAN_FD";
BA_DEF_DEF_ "VFrameFormat" "StandardCAN_FD";
)";

constexpr const char* mapping_text = R"toml(
dbc = "ecu.dbc"
[[play]]
messages = ["Rates"]
every_ms = 20
[play.signals]
"Rates.RateZ" = "imu.rate.z"
[[hear]]
message = "Sigmas"
[hear.signals]
LatSigma = "position.latitude.sigma"
LonSigma = "position.longitude.sigma"
HeightSigma = "position.height.sigma"
LatLon = "correlation(position.latitude, position.longitude)"
[[hear]]
message = "Place"
signals = { Lat = "position.latitude", Lon = "position.longitude", Height = "position.height" }
[[hear]]
message = "Innovation"
[hear.signals]
North = "innovation.velocity.north"
East = "innovation.velocity.east"
Down = "innovation.velocity.down"
NorthSigma = "innovation.velocity.north.sigma"
EastSigma = "innovation.velocity.east.sigma"
DownSigma = "innovation.velocity.down.sigma"
)toml";

constexpr const char* scenario_text = R"(
title = "a turn in the north"
duration_s = 20.0
seed = 3
[target]
mapping = "ecu.mapping.toml"
[truth]
latitude_deg = 60.0
longitude_deg = 179.9999
height_m = 1000.0
trajectory = "spiral"
speed_mps = 50.0
heading_deg = 90.0
turn_period_s = 100.0
[slave_imu]
period_ms = 10
[[check]]
kind = "answers"
answers_at_least = 1
)";

Result<scenario::Scenario> read(std::string mapping = mapping_text) {
  return read_mapped(scenario_text, std::move(mapping), dbc_text);
}

// The answers of a target whose errors are north, east and up [m].
class Told {
 public:
  Told()
      : scenario_(read().value()), flight_(drive::make_truth(scenario_).value()), seen_(mapping().messages) {}
  [[nodiscard]] const Mapping& mapping() const { return dynamic_cast<const Mapping&>(*scenario_.binding); }
  [[nodiscard]] const MappedTarget& target() const { return mapping().targets.front(); }
  void place(std::int64_t t_us, double north, double east, double up) {
    const world::Position at = flight_.at(t_us).position;
    const world::Position said = world::displaced(at, {north, east, -up});
    value("position.latitude", t_us, said.latitude);
    value("position.longitude", t_us, std::remainder(said.longitude, 2 * M_PI));
    value("position.height", t_us, said.height);
  }
  void value(std::string_view quantity, std::int64_t t_us, double value) {
    record(t_us, value, [&](const ReportedSignal& one) {
      return one.what == ReportedSignal::What::value && one.quantity->quantity->name == quantity;
    });
  }
  void sigma(std::string_view signal, std::int64_t t_us, double value) {
    record(t_us, value, [&](const ReportedSignal& one) { return one.signal->name == signal; });
  }
  [[nodiscard]] std::vector<quantities::TrackPoint> points(std::string_view quantity) const {
    const auto all = points_of(*find_reference_quantity(quantity), target(), seen_,
                               {.flight = flight_, .duration_us = flight_.end_us()})
                         .points;
    return {all.begin(), all.end()};
  }
  [[nodiscard]] const world::FlightRecord& flight() const { return flight_; }
  [[nodiscard]] quantities::Samples samples() const {
    return target().estimator->samples(seen_, {.flight = flight_, .duration_us = flight_.end_us()});
  }

 private:
  template <class Holds>
  void record(std::int64_t t_us, double value, Holds holds) {
    for (const Hear& hear : mapping().hears) {
      for (const ReportedSignal& one : hear.reported_signals) {
        if (holds(one)) seen_.of<Answers>().values[&one].push_back({.t_us = t_us, .value = value});
      }
    }
  }
  scenario::Scenario scenario_;
  world::FlightRecord flight_;
  checks::Observations seen_;
};

TEST(Derived, APositionIsInMetresAlsoWhereTheLongitudeComesRound) {
  Told told;
  for (int k = 1; k <= 10; ++k) told.place(k * 1'000'000, 3, -4, 1.5);
  ASSERT_GT(told.flight().at(10'000'000).position.longitude, M_PI) << "otherwise this test proves less";
  for (const auto& [name, error] : std::map<std::string_view, double>{{"position.north", 3},
                                                                      {"position.east", -4},
                                                                      {"position.down", -1.5},
                                                                      {"position.horizontal", 5}}) {
    const auto points = told.points(name);
    ASSERT_EQ(points.size(), 10U) << name;
    for (const auto& point : points) EXPECT_NEAR(point.value, error, 1e-4) << name;
  }
  // Estimate and truth are counted from the start of the flight.
  const auto last = told.points("position.east").back();
  EXPECT_NEAR(*last.truth, 50 * 100 / (2 * M_PI) * std::sin(2 * M_PI / 10), 0.1);
  EXPECT_NEAR(*last.estimate - *last.truth, -4, 1e-4);
}

TEST(Derived, SigmasMayBeInMetresAndInAMessageOfTheirOwn) {
  Told told;
  told.place(1'000'000, 3, -4, 1.5);
  told.sigma("LatSigma", 2'000'000, 2);
  told.place(2'000'000, 3, -4, 1.5);
  told.place(2'900'000, 3, -4, 1.5);
  told.place(9'000'000, 3, -4, 1.5);
  const auto north = told.points("position.north");
  ASSERT_EQ(north.size(), 4U);
  EXPECT_EQ(north[0].sigma, std::nullopt) << "none came before";
  EXPECT_NEAR(north[1].sigma.value(), 2, 1e-9);
  EXPECT_NEAR(north[2].sigma.value(), 2, 1e-9) << "the latest one";
  EXPECT_EQ(north[3].sigma, std::nullopt) << "its message has been silent for 7 s";
  EXPECT_NEAR(told.points("position.latitude").at(1).sigma.value(), 2 / 6.38e6, 1e-3 * 2 / 6.38e6);
}

TEST(Derived, ANeesHasTheSigmasAndCorrelationsThatAreTold) {
  Told told;
  told.place(1'000'000, 3, -4, 1.5);
  EXPECT_TRUE(told.points("position.nees").empty()) << "no sigma yet";
  told.sigma("LatSigma", 2'000'000, 2);
  told.sigma("LonSigma", 2'000'000, 5);
  told.sigma("HeightSigma", 2'000'000, 0.5);
  told.place(2'000'000, 3, -4, 1.5);
  const double a = 3.0 / 2, b = -4.0 / 5;
  ASSERT_EQ(told.points("position.horizontal.nees").size(), 1U);
  EXPECT_NEAR(told.points("position.horizontal.nees").at(0).value, a * a + b * b, 1e-3);
  EXPECT_NEAR(told.points("position.nees").at(0).value, a * a + b * b + 9, 1e-3);
  told.sigma("LatLon", 3'000'000, 0.8);
  told.place(3'000'000, 3, -4, 1.5);
  // The inverse of [[1, r], [r, 1]] is [[1, -r], [-r, 1]] / (1 - r^2).
  EXPECT_NEAR(told.points("position.horizontal.nees").at(1).value,
              (a * a + b * b - 2 * 0.8 * a * b) / (1 - 0.64), 1e-3);
  for (const char* signal : {"LatSigma", "LonSigma"}) told.sigma(signal, 4'000'000, 2);
  told.sigma("LatLon", 4'000'000, 1.2);
  told.place(4'000'000, 3, -4, 1.5);
  EXPECT_TRUE(std::isnan(told.points("position.horizontal.nees").at(2).value)) << "no covariance";
}

// Such a sigma would otherwise hide any error: a NEES that is not a number fails each check of it.
TEST(Derived, ASigmaThatIsNoneIsNoSmallNees) {
  for (const double sigma : {std::nan(""), std::numeric_limits<double>::infinity(), -2.0}) {
    Told told;
    told.sigma("LatSigma", 1'000'000, sigma);
    told.sigma("LonSigma", 1'000'000, 1);
    told.place(1'000'000, 300, 0, 0);
    ASSERT_EQ(told.points("position.horizontal.nees").size(), 1U) << sigma;
    EXPECT_TRUE(std::isnan(told.points("position.horizontal.nees").front().value)) << sigma;
    EXPECT_TRUE(std::isnan(told.points("position.latitude").front().sigma.value())) << sigma;
  }
  Told told;
  for (const char* signal : {"LatSigma", "LonSigma"}) told.sigma(signal, 1'000'000, 1);
  told.sigma("LatLon", 1'000'000, std::nan(""));
  told.place(1'000'000, 300, 0, 0);
  EXPECT_TRUE(std::isnan(told.points("position.horizontal.nees").at(0).value)) << "nor is a correlation 0";
}

// In a campaign, a NEES that is none is infinite, because NaN means that the answer has none.
TEST(Derived, ACampaignSeesASigmaThatIsNone) {
  Told told;
  for (const char* axis : {"north", "east", "down"})
    told.value(std::string("innovation.velocity.") + axis, 1'000'000, 0.3);
  for (const char* signal : {"LatSigma", "LonSigma", "HeightSigma"})
    told.sigma(signal, 1'000'000, std::nan(""));
  told.place(1'000'000, 300, 0, 0);
  const quantities::Samples samples = told.samples();
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_TRUE(std::isinf(samples.value(0, *find_reference_quantity("position.nees")->quantity)));
}

// An error is not kept for ever: a quantity that is silent has no samples.
TEST(Derived, ACampaignHasNoSamplesOfAQuantityThatIsSilent) {
  Told told;
  const auto innovations = [&](std::int64_t t_us) {
    for (const char* axis : {"north", "east", "down"})
      told.value(std::string("innovation.velocity.") + axis, t_us, 0.3);
  };
  told.place(1'000'000, 3, -4, 1.5);
  for (const std::int64_t t_us : {1'000'000, 1'900'000, 5'000'000, 6'000'000}) innovations(t_us);
  told.place(6'000'000, 3, -4, 1.5);
  std::vector<std::int64_t> times;
  const quantities::Samples samples = told.samples();
  for (std::size_t i = 0; i < samples.size(); ++i) times.push_back(samples.times()[i]);
  EXPECT_THAT(times, testing::ElementsAre(1'000'000, 1'900'000, 6'000'000));
}

// Metrics treat a sample as missing if it is older than two periods of the messages, or a second longer than
// one.
TEST(Derived, SamplesOfACampaignAgeByThePeriodsOfTheMessages) {
  const auto age_us = [](const std::string& mapping) {
    const auto scenario = read(mapping).value();
    const auto& target = dynamic_cast<const Mapping&>(*scenario.binding).targets.front();
    return target.estimator->freshness(scenario).age_limit_us;
  };
  EXPECT_EQ(age_us(mapping_text), std::numeric_limits<std::int64_t>::max()) << "their periods are not known";
  std::string known = mapping_text;
  for (const char* message : {"Sigmas", "Place", "Innovation"}) {
    const std::string line = std::string("message = \"") + message + "\"\n";
    known.replace(known.find(line), line.size(), line + "answers = \"Rates\"\n");
  }
  EXPECT_EQ(age_us(known), 1'020'000);
}

// A campaign has a sample for each time, also where there is no NEES because no sigma came.
TEST(Derived, ACampaignHasSamplesWithoutANees) {
  Told told;
  for (const char* axis : {"north", "east", "down"})
    told.value(std::string("innovation.velocity.") + axis, 1'000'000, 0.3);
  told.place(1'000'000, 3, -4, 1.5);
  for (const char* signal : {"LatSigma", "LonSigma", "HeightSigma"}) told.sigma(signal, 2'000'000, 1);
  told.place(2'000'000, 3, -4, 1.5);
  told.place(8'000'000, 3, -4, 1.5);
  const quantities::Samples samples = told.samples();
  ASSERT_EQ(samples.size(), 3U);
  const quantities::Quantity& nees = *find_reference_quantity("position.nees")->quantity;
  const quantities::Quantity& north = *find_reference_quantity("position.north")->quantity;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_EQ(std::isnan(samples.value(i, nees)), i != 1) << i;
    EXPECT_NEAR(samples.value(i, north), 3, 1e-4);
  }
}

TEST(Derived, ANisIsOfTheInnovations) {
  Told told;
  for (const char* axis : {"north", "east", "down"})
    told.value(std::string("innovation.velocity.") + axis, 1'000'000, 0.3);
  for (const char* signal : {"NorthSigma", "EastSigma", "DownSigma"}) told.sigma(signal, 1'000'000, 0.1);
  ASSERT_EQ(told.points("innovation.velocity.nis").size(), 1U);
  EXPECT_NEAR(told.points("innovation.velocity.nis").at(0).value, 27, 1e-9);
}

TEST(Derived, OnlyWhatThePartsAllow) {
  const auto names = [](const Mapping& mapping) {
    std::vector<std::string_view> all;
    for (const auto* one : mapping.targets.front().quantities) all.push_back(one->name);
    return all;
  };
  const auto whole = read().value();
  EXPECT_THAT(names(dynamic_cast<const Mapping&>(*whole.binding)),
              testing::IsSupersetOf({"position.north", "position.nees", "innovation.velocity.nis"}));
  std::string text = mapping_text;
  const std::string line = "HeightSigma = \"position.height.sigma\"\n";
  text.erase(text.find(line), line.size());
  const auto less = read(text).value();
  EXPECT_THAT(names(dynamic_cast<const Mapping&>(*less.binding)),
              testing::AllOf(testing::Contains("position.horizontal.nees"),
                             testing::Not(testing::Contains("position.nees"))));
  text = mapping_text;
  const std::string value = ", Height = \"position.height\"";
  text.erase(text.find(value), value.size());
  EXPECT_THAT(
      read(text).error().message,
      testing::HasSubstr("Sigmas.HeightSigma carries a sigma or correlation of position.height without "
                         "its value, expected both"));
  text = mapping_text;
  text.replace(text.find("\"position.height\""), 17, "\"position.down\"");
  EXPECT_THAT(read(text).error().message,
              testing::HasSubstr("'position.down' is not a quantity that a target reports"));
}

}  // namespace
}  // namespace canhil::mapping
