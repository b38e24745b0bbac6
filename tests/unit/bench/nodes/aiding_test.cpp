// The messages of the SSBL and of the GPS for a moving vehicle.
#include <gtest/gtest.h>

#include "bench/sensors/gps.hpp"
#include "bench/sensors/ssbl.hpp"
#include "bench/world/units.hpp"
#include "tests/unit/bench/nodes/made.hpp"

namespace canhil::nodes {
namespace {

using namespace sensors;

using messages::Validity;
using world::Vector3;
using world::units::deg;

const world::FlightRecord& flight() {
  // A path to the north at 3 m/s, which goes down to a depth of 10 m and back up within 100 s.
  static const world::FlightRecord record(
      {.start = {.latitude = 35 * deg, .longitude = 129 * deg, .height = 0},
       .motion = world::SPath{.speed = 3, .heading = 0, .depth = {.depth = 10, .period = 100}}},
      200'000'000, 20'000);
  return record;
}

struct Fix {
  std::int64_t due_us = 0;
  std::uint8_t counter = 0;
  std::int64_t valid_us = 0;
  world::Position position;
  bool valid = false;
  double sigma = 0;
};

template <class Message>
Message message(const Transmission& out, std::size_t place) {
  EXPECT_EQ(out.frames()[place].id, Message::info.id);
  return from_frame<Message>(out.frames()[place]);
}

Fix ssbl_fix(const Transmission& out) {
  using namespace messages;
  const auto horizontal = message<SsblRelativeNE>(out, 0);
  const auto latitude = message<SsblShipLatitude>(out, 1);
  const auto longitude = message<SsblShipLongitude>(out, 2);
  const auto vertical = message<SsblRelativeD>(out, 3);
  const world::Position ship{latitude.latitude_deg * deg, longitude.longitude_deg * deg, latitude.height_m};
  return {.valid_us = vertical.time_of_validity_us,
          .position = displaced(
              ship, {horizontal.relative_north_m, horizontal.relative_east_m, vertical.relative_down_m}),
          .valid = horizontal.position_validity == Validity::valid,
          .sigma = longitude.relative_sigma_m};
}

Fix gps_fix(const Transmission& out) {
  using namespace messages;
  const auto latitude = message<GpsLatitude>(out, 0);
  const auto longitude = message<GpsLongitude>(out, 1);
  const auto time = message<GpsTime>(out, 2);
  EXPECT_EQ(longitude.satellites > 0, longitude.position_validity == Validity::valid);
  return {.valid_us = time.time_of_validity_us,
          .position = {latitude.latitude_deg * deg, longitude.longitude_deg * deg, latitude.height_m},
          .valid = longitude.position_validity == Validity::valid,
          .sigma = time.horizontal_sigma_m};
}

template <class Decode>
std::vector<Fix> fixes(Node& node, Decode decode) {
  std::vector<Fix> all;
  Transmission out;
  for (; node.due_us() != never_us; out.clear()) {
    const std::int64_t due_us = node.due_us();
    node.transmit(out);
    if (out.frames().empty()) continue;
    Fix fix = decode(out);
    fix.due_us = due_us;
    fix.counter = e2e::counter(out.frames()[0].payload());
    for (const Frame& frame : out.frames()) EXPECT_EQ(e2e::counter(frame.payload()), fix.counter);
    all.push_back(fix);
  }
  return all;
}
std::vector<Fix> fixes(const SsblSettings& config) { return fixes(*made(ssbl, config, flight()), ssbl_fix); }
std::vector<Fix> fixes(const GpsSettings& config) { return fixes(*made(gps, config, flight()), gps_fix); }

Vector3 error(const Fix& fix) { return displacement_n(flight().at(fix.valid_us).position, fix.position); }

Vector3 mean_error(const std::vector<Fix>& fixes) {
  Vector3 sum = Vector3::Zero();
  for (const Fix& fix : fixes) sum += error(fix);
  return sum / static_cast<double>(fixes.size());
}

// The RMS about a mean, by axis.
Vector3 spread(const std::vector<Fix>& fixes, const Vector3& mean) {
  Vector3 sum = Vector3::Zero();
  for (const Fix& fix : fixes) sum += (error(fix) - mean).cwiseAbs2();
  return (sum / static_cast<double>(fixes.size())).cwiseSqrt();
}

TEST(Aiding, WithoutErrorsIsTheTruthAtItsTimeOfValidity) {
  const auto acoustic = fixes(SsblSettings{.schedule = {.period_us = {}, .latency_us = 1'500'000},
                                           .ship_offset = {200, -300, -5},
                                           .ship_velocity = {1, 2, 0}});
  ASSERT_EQ(acoustic.size(), 198U);
  for (const Fix& fix : acoustic) {
    EXPECT_EQ(fix.due_us, fix.valid_us + 1'500'000);
    EXPECT_TRUE(fix.valid);
    EXPECT_LT(error(fix).norm(), 0.06) << "heights in steps of 0.1 m";
  }
  for (const Fix& fix : fixes(GpsSettings{})) EXPECT_LT(error(fix).norm(), 0.06);
}

TEST(Aiding, TheShipMovesAndSaysWhereItIs) {
  const auto node =
      made(ssbl,
           SsblSettings{
               .ship_offset = {200, -300, 0}, .ship_velocity = {1, 2, 0}, .ship_error = {.value = {3, 0, 0}}},
           flight());
  Transmission out;
  for (int k = 0; k < 10; ++k, out.clear()) {
    node->transmit(out);
    const auto latitude = message<messages::SsblShipLatitude>(out, 1);
    const auto longitude = message<messages::SsblShipLongitude>(out, 2);
    const Vector3 ship =
        displacement_n(flight().epochs()[0].position,
                       {latitude.latitude_deg * deg, longitude.longitude_deg * deg, latitude.height_m});
    EXPECT_LT((ship - Vector3(203 + (k + 1), -300 + 2 * (k + 1), 0)).norm(), 0.06);
  }
}

TEST(Aiding, ErrorsAreConstantsAndNoise) {
  const SsblSettings acoustic{
      .ship_error = {.value = {5, 0, 0}}, .bias = {.value = {0, -7, 1}}, .noise = {2, 3, 4}};
  const auto acoustic_fixes = fixes(acoustic);
  const Vector3 acoustic_mean(5, -7, 1);
  const double n = 200;
  EXPECT_LT((mean_error(acoustic_fixes) - acoustic_mean).cwiseAbs().cwiseQuotient(acoustic.noise).maxCoeff(),
            5 / std::sqrt(n));
  EXPECT_LT(
      (spread(acoustic_fixes, acoustic_mean).cwiseQuotient(acoustic.noise).array() - 1).abs().maxCoeff(),
      5 / std::sqrt(2 * n));
  EXPECT_DOUBLE_EQ(acoustic_fixes[0].sigma, 4);
  const GpsSettings satellite{.bias = {.value = {1, 2, 3}}, .noise = {10, 10, 15}};
  const auto satellite_fixes = fixes(satellite);
  EXPECT_LT(
      (mean_error(satellite_fixes) - Vector3(1, 2, 3)).cwiseAbs().cwiseQuotient(satellite.noise).maxCoeff(),
      5 / std::sqrt(n));
  EXPECT_LT((spread(satellite_fixes, {1, 2, 3}).cwiseQuotient(satellite.noise).array() - 1).abs().maxCoeff(),
            5 / std::sqrt(2 * n));
  EXPECT_DOUBLE_EQ(satellite_fixes[0].sigma, 10);
}

TEST(Aiding, AcousticNoiseGrowsWithTheRange) {
  const auto all = fixes(SsblSettings{.ship_offset = {-400, 0, 0}, .noise = {3, 3, 3}, .range_noise = 0.01});
  EXPECT_NEAR(all.front().sigma, 5.02, 0.02);  // root sum square of 3 m and 1 % of 403 m
  EXPECT_NEAR(
      all.back().sigma,
      std::hypot(
          3,
          0.01 * (400 +
                  displacement_n(flight().epochs().front().position, flight().epochs().back().position).x())),
      0.01);
}

TEST(Aiding, AnOutlierJumpsHorizontally) {
  const auto all = fixes(GpsSettings{.faults = {.outlier_probability = 0.1, .outlier = 1000}});
  int outliers = 0;
  for (const Fix& fix : all) {
    const double size = error(fix).head<2>().norm();
    EXPECT_TRUE(size < 0.1 || std::abs(size - 1000) < 0.5) << size;
    EXPECT_LT(std::abs(error(fix).z()), 0.06);
    outliers += size > 0.1 ? 1 : 0;
  }
  EXPECT_NEAR(outliers, 20, 5 * 4.3);
  EXPECT_GT(outliers, 0);
}

TEST(Aiding, LossesLeaveGapsInTheCounters) {
  const auto all = fixes(SsblSettings{.faults = {.loss_probability = 0.3}});
  EXPECT_NEAR(static_cast<double>(all.size()), 140, 5 * 6.5);
  for (const Fix& fix : all) EXPECT_EQ(fix.counter, (fix.valid_us / 1'000'000 - 1) % 15);
}

TEST(Aiding, IsSilentInAnInterval) {
  for (const Fix& fix : fixes(GpsSettings{.faults = {.silence_us = std::pair{50'000'000, 60'000'000}}}))
    EXPECT_TRUE(fix.valid_us < 50'000'000 || fix.valid_us > 60'000'000) << fix.valid_us;
  EXPECT_EQ(fixes(GpsSettings{.faults = {.silence_us = std::pair{50'000'000, 60'000'000}}}).size(), 189U);
}

TEST(Aiding, AnInvalidFixSaysSoAndHasNothingToOffer) {
  const auto all = fixes(SsblSettings{.ship_offset = {-400, 0, 0}, .faults = {.invalid_probability = 0.5}});
  const auto invalid = std::ranges::count(all, false, &Fix::valid);
  EXPECT_NEAR(static_cast<double>(invalid), 100, 5 * 7.1);
  for (const Fix& fix : all) EXPECT_EQ(error(fix).norm() < 0.1, fix.valid);
}

TEST(Aiding, AReceiverHasNoFixUnderWater) {
  for (const Fix& fix : fixes(GpsSettings{.lowest_height = -1.0})) {
    const double height = flight().at(fix.valid_us).position.height;
    EXPECT_EQ(fix.valid, height >= -1.0) << height;
  }
}

TEST(Aiding, FaultsChangeNoMeasurement) {
  const auto plain = fixes(GpsSettings{.noise = {10, 10, 15}});
  const auto faulty = fixes(GpsSettings{.noise = {10, 10, 15}, .faults = {.loss_probability = 0.5}});
  ASSERT_LT(faulty.size(), plain.size());
  for (const Fix& fix : faulty) {
    const auto same = std::ranges::find(plain, fix.valid_us, &Fix::valid_us);
    ASSERT_NE(same, plain.end());
    EXPECT_EQ(same->position.latitude, fix.position.latitude);
  }
}

}  // namespace
}  // namespace canhil::nodes
