// The wind estimator through the device: a published run in frames.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/unit/target/device/glider.hpp"

namespace canhil::target {
namespace {

using namespace messages;
using wind::FinFrame;
using wind::Navigation;

TEST(Wind, AnswersEachGroupNamingItsCause) {
  Glider bench;
  bench.forget();
  bench.fly(0, 50);
  const auto updates = bench.all<WindUpdate>();
  ASSERT_EQ(updates.size(), 50U);
  for (std::size_t k = 0; k < 50; ++k) {
    EXPECT_EQ(updates[k].cause_time_us, 20'000 * k);
    EXPECT_EQ(updates[k].cause_counter, k % 15);
    EXPECT_GT(updates[k].nis, 0);
    EXPECT_EQ(bench.all<WindSpeed>()[k].outcome, WindOutcome::updated);
    EXPECT_EQ(bench.all<WindVector>()[k].started, 1);
  }
  std::vector<std::uint32_t> ids;
  for (const Frame& frame : bench.answers()) ids.push_back(frame.id);
  EXPECT_THAT(
      std::vector(ids.begin(), ids.begin() + 9),
      testing::ElementsAre(WindVector::info.id, WindSpeed::info.id, WindSigma::info.id,
                           WindCorrelation::info.id, WindTrackSigma::info.id, WindAirVelocity::info.id,
                           WindAttitude::info.id, WindInnovation::info.id, WindUpdate::info.id));
}

TEST(Wind, IsDegradedForTheFirstSecond) {
  Glider bench;
  bench.forget();
  bench.fly(0, 60);
  const auto answers = bench.all<WindSpeed>();
  ASSERT_EQ(answers.size(), 60U);
  for (std::size_t k = 0; k < 60; ++k) EXPECT_EQ(answers[k].degraded, k < 50 ? 1 : 0) << k;
}

TEST(Wind, ComesAsComponentsAndAsSpeedAndDirectionWithTheirSigmas) {
  Glider bench;
  bench.fly(0, 600);
  const auto vectors = bench.all<WindVector>();
  for (std::size_t k = 0; k < 600; k += 100) {
    const double north = vectors[k].wind_north_mps, east = vectors[k].wind_east_mps;
    const auto polar = bench.all<WindSpeed>()[k];
    EXPECT_NEAR(polar.wind_speed_mps, std::hypot(north, east), 0.01);
    EXPECT_NEAR(polar.wind_from_deg, std::atan2(-east, -north) / Glider::deg + 360, 0.02);  // a west wind
    const auto sigma = bench.all<WindSigma>()[k];
    const double sigma_n = sigma.wind_sigma_north_mps, sigma_e = sigma.wind_sigma_east_mps;
    const double covariance = bench.all<WindCorrelation>()[k].wind_correlation_ne * sigma_n * sigma_e;
    const auto sigma_along = [&](double n, double e) {
      return std::sqrt(n * n * sigma_n * sigma_n + e * e * sigma_e * sigma_e + 2 * n * e * covariance);
    };
    const auto track = bench.all<WindTrackSigma>()[k];
    const double speed = std::hypot(north, east);
    EXPECT_NEAR(track.wind_speed_sigma_mps, sigma_along(north / speed, east / speed), 0.01);
    EXPECT_NEAR(track.wind_from_sigma_deg, sigma_along(-east / speed, north / speed) / speed / Glider::deg,
                0.03);
    // The heading is nearly the direction of the air velocity.
    const double heading = bench.all<WindAttitude>()[k].heading_deg * Glider::deg;
    EXPECT_NEAR(track.along_track_sigma_mps, sigma_along(std::cos(heading), std::sin(heading)), 0.05);
    EXPECT_NEAR(track.cross_track_sigma_mps, sigma_along(-std::sin(heading), std::cos(heading)), 0.05);
    EXPECT_GT(track.cross_track_sigma_mps, 0.01);
  }
}

// The epoch is a multiple of 10 us, the resolution of the time in the fins' messages.
TEST(Wind, TimesMayWrap) {
  const auto flight = [](std::int64_t epoch_us) {
    Glider bench(Glider::Release{.parameters = {}, .t_us = epoch_us});
    bench.fly(0, 200);
    EXPECT_EQ(bench.last<WindUpdate>()->cause_time_us, wrap_us(epoch_us + 199 * 20'000L));
    return bench.winds();
  };
  EXPECT_EQ(flight(0), flight((std::int64_t{1} << 32) - 1'000'006));
}

TEST(Wind, AnswersGoodSamplesAsOftenAsConfiguredAndBadOnesAlways) {
  Glider bench(Glider::Release{.parameters = {{.parameter = Parameter::output_interval_ms, .value = 100}}});
  bench.fly(0, 200, [](std::size_t k, Navigation& n, FinFrame&) { n.valid = k < 100 || k >= 110; });
  std::vector<std::uint32_t> due, bad;
  for (std::size_t i = 0; const auto& update : bench.all<WindUpdate>()) {
    (bench.all<WindSpeed>()[i++].outcome == WindOutcome::updated ? due : bad)
        .push_back(update.cause_time_us / 20'000);
  }
  EXPECT_EQ(bad.size(), 10U);
  ASSERT_EQ(due.size(), 38U);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(due[i], 5 * i);
}

TEST(Wind, TheSameFramesGiveTheSameAnswersAfterAReset) {
  Device device;
  const auto run = [&device](const std::vector<Frame>& frames) {
    std::vector<std::vector<std::uint8_t>> answers;
    for (const Frame& frame : frames) {
      for (const Frame& answer : device.receive(frame))
        answers.emplace_back(answer.payload().begin(), answer.payload().end());
    }
    return answers;
  };
  Glider bench;
  bench.fly(0, 100);
  Glider without_air(Glider::Release{.air_velocity_known = false, .parameters = {}});
  without_air.fly(0, 100);
  const auto first = run(bench.fed());
  const auto between = run(without_air.fed());
  EXPECT_NE(between, first) << "the air velocity of the run before is forgotten";
  EXPECT_EQ(run(bench.fed()), first);
}

TEST(Wind, RefusesAlgorithmsOfOthers) {
  BenchSide bench;
  for (const Algorithm algorithm : {Algorithm::kalman, Algorithm::ukf, Algorithm::sin_cos}) {
    bench.command(Command::reset, Estimator::wind, algorithm);
    EXPECT_EQ(bench.last<TargetHeartbeat>()->error_command, 1);
  }
  bench.command(Command::reset, Estimator::inflight_alignment, Algorithm::h_infinity);
  EXPECT_EQ(bench.last<TargetHeartbeat>()->error_command, 1);
}

}  // namespace
}  // namespace canhil::target
