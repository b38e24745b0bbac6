// In-flight alignment through the device: a vehicle at rest with good and bad fixes from an SSBL or a GPS.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/target/device/bench_side.hpp"

namespace canhil::target {
namespace {

using namespace messages;

constexpr double metres_per_degree = 110'977;  // length of a degree of latitude at 37 deg [m]
constexpr double latitude_deg = 37, longitude_deg = 127, height_m = 1000;

// At rest, heading north. The initial state is the truth, with sigmas for an unknown heading.
class Vehicle : public BenchSide {
 public:
  explicit Vehicle(float aiding, Algorithm algorithm = Algorithm::sin_cos,
                   const std::vector<ParamSet>& parameters = {}, double starts_at_deg = longitude_deg) {
    command(Command::reset, Estimator::inflight_alignment, algorithm);
    send(ParamSet{.parameter = Parameter::aiding, .value = aiding});
    for (const ParamSet& parameter : parameters) send(parameter);
    send(TargetInitLatitude{.latitude_deg = latitude_deg, .height_m = height_m});
    send(TargetInitLongitude{.longitude_deg = starts_at_deg, .position_sigma_m = 10});
    send(TargetInitVelocityNE{});
    send(TargetInitAttitude{});
    send(TargetInitSigma{.velocity_sigma_mps = 0.1, .tilt_sigma_deg = 1, .heading_sigma_deg = 90});
    send(TargetInitVelocityD{.time_of_validity_us = 0});
    command(Command::start, Estimator::inflight_alignment, algorithm);
  }
  void imu_until(std::int64_t t_us) {
    for (; next_us_ <= t_us; next_us_ += 10'000) {
      imu(next_us_);
      sync(next_us_);
    }
  }
  void gps(std::int64_t t_us, double north_m = 0, Validity validity = Validity::valid,
           double latitude = latitude_deg, double sigma_m = 0) {
    send(GpsLatitude{.latitude_deg = latitude + north_m / metres_per_degree, .height_m = height_m});
    send(GpsLongitude{.longitude_deg = longitude_deg, .satellites = 9, .position_validity = validity});
    send(GpsTime{.horizontal_sigma_m = sigma_m,
                 .vertical_sigma_m = 2 * sigma_m,
                 .time_of_validity_us = wrap_us(t_us)});
  }
  // The ship lies 100 m south of the vehicle and 20 m above it.
  void ssbl(std::int64_t t_us, double north_m = 0, Validity validity = Validity::valid, double sigma_m = 0) {
    send(SsblRelativeNE{.relative_north_m = 100 + north_m, .position_validity = validity});
    send(SsblShipLatitude{.latitude_deg = latitude_deg - 100 / metres_per_degree, .height_m = height_m + 20});
    send(SsblShipLongitude{.longitude_deg = longitude_deg, .relative_sigma_m = sigma_m});
    send(SsblRelativeD{.relative_down_m = 20, .time_of_validity_us = wrap_us(t_us)});
  }
  [[nodiscard]] FixOutcome outcome() const { return last<FixStatus>()->outcome; }

 private:
  std::int64_t next_us_ = 10'000;
};

constexpr float by_ssbl = 0, by_gps = 1;

TEST(InflightAlignment, AnswersEachFixNamingItsCause) {
  Vehicle bench(by_gps, Algorithm::sin_cos, {{.parameter = Parameter::fix_correlated_percent, .value = 0}});
  bench.imu_until(1'000'000);
  bench.gps(1'000'000, 3);
  bench.gps(990'000, 3);
  const auto updates = bench.all<FixUpdate>();
  ASSERT_EQ(updates.size(), 2U);
  EXPECT_EQ(updates[0].cause_time_us, 1'000'000U);
  EXPECT_EQ(updates[1].cause_time_us, 990'000U);
  EXPECT_EQ(updates[1].cause_counter, 1);
  EXPECT_GT(updates[0].nis, 0);
  EXPECT_EQ(bench.all<FixStatus>()[0].outcome, FixOutcome::accepted);
  EXPECT_EQ(bench.all<FixStatus>()[0].source, FixSource::gps);
  EXPECT_NEAR(bench.all<FixInnovation>()[0].innovation_north_m, -3, 0.1);
  const auto position = bench.all<FixPositionLatitude>()[0];
  EXPECT_GT(position.latitude_deg, latitude_deg + 1 / metres_per_degree);
  EXPECT_LT(position.latitude_deg, latitude_deg + 3 / metres_per_degree);
  // Prior sigma 10 m, fix sigma 2 m; the sigmas of position and attitude have a margin of 10 %.
  EXPECT_NEAR(bench.all<FixPositionSigma>()[0].position_sigma_north_m, 2.2, 0.1);
  EXPECT_GT(bench.all<FixAttitudeSigma>()[0].heading_sigma_deg, 20);
  EXPECT_NEAR(bench.all<FixAttitudeSigma>()[0].tilt_sigma_east_deg, 1.1, 0.05);
  EXPECT_NEAR(bench.all<FixAccelBiasSigma>()[0].accel_bias_sigma_x_ug, 1000, 10);
  EXPECT_NEAR(bench.all<FixGyroBiasSigma>()[0].gyro_bias_sigma_z_degph, 1, 0.01);
  EXPECT_EQ(bench.all<FixBiasSigma>()[0].fix_bias_sigma_north_m, 0) << "white noise has none";
}

TEST(InflightAlignment, AnSsblFixIsTheShipsPositionPlusTheRelative) {
  Vehicle bench(by_ssbl);
  bench.imu_until(1'000'000);
  bench.ssbl(1'000'000);
  EXPECT_EQ(bench.outcome(), FixOutcome::accepted);
  EXPECT_EQ(bench.last<FixStatus>()->source, FixSource::ssbl);
  EXPECT_NEAR(bench.last<FixInnovation>()->innovation_north_m, 0, 0.1);
  EXPECT_NEAR(bench.last<FixInnovation>()->innovation_down_m, 0, 0.1);
  EXPECT_GT(bench.last<FixBiasSigma>()->fix_bias_sigma_north_m, 2);
}

// The parameters set a sigma of 2 m. A fix that states a larger sigma is weighted by its own sigma; a fix
// that states a smaller sigma is weighted by the sigma of the parameters.
TEST(InflightAlignment, AFixThatStatesALargerSigmaWeighsLess) {
  const auto sigmas = [](float aiding, double stated_m) {
    Vehicle bench(aiding);
    bench.imu_until(1'000'000);
    if (aiding == by_gps) {
      bench.gps(1'000'000, 0, Validity::valid, latitude_deg, stated_m);
    } else {
      bench.ssbl(1'000'000, 0, Validity::valid, stated_m);
    }
    return *bench.last<FixPositionSigma>();
  };
  for (const float aiding : {by_ssbl, by_gps}) {
    const FixPositionSigma assumed = sigmas(aiding, 0), worse = sigmas(aiding, 10);
    EXPECT_EQ(sigmas(aiding, 1).position_sigma_north_m, assumed.position_sigma_north_m);
    EXPECT_GT(worse.position_sigma_north_m, 1.5 * assumed.position_sigma_north_m);
    EXPECT_GT(worse.position_sigma_down_m, 1.5 * assumed.position_sigma_down_m);
  }
  EXPECT_GT(sigmas(by_gps, 10).position_sigma_down_m, 1.05 * sigmas(by_gps, 10).position_sigma_north_m);
}

TEST(InflightAlignment, LongitudesAreReportedFromMinus180To180Degrees) {
  Vehicle bench(by_gps, Algorithm::sin_cos, {}, 179.999995);
  bench.imu_until(1'000'000);
  bench.send(GpsLatitude{.latitude_deg = latitude_deg, .height_m = height_m});
  bench.send(GpsLongitude{.longitude_deg = -179.99995,
                          .satellites = 9,
                          .position_validity = Validity::valid});  // 5 m further east
  bench.send(GpsTime{.time_of_validity_us = 1'000'000});
  EXPECT_EQ(bench.outcome(), FixOutcome::accepted);
  EXPECT_NEAR(bench.last<FixInnovation>()->innovation_east_m, -4.9, 0.2);
  EXPECT_LT(bench.last<FixPositionLongitude>()->longitude_deg, -179.9999);
}

TEST(InflightAlignment, AnswersEachImuGroup) {
  Vehicle bench(by_gps);
  bench.imu_until(50'000);
  EXPECT_EQ(bench.all<FixVelocityD>().size(), 5U);
  EXPECT_EQ(bench.last<FixVelocityD>()->cause_time_us, 50'000U);
  EXPECT_EQ(bench.last<FixAttitude>()->coasting, 0);
}

TEST(InflightAlignment, ALostImuGroupIsBridgedAndFlagged) {
  Vehicle bench(by_gps);
  bench.imu_until(50'000);
  bench.lose_imu(60'000);
  bench.imu(70'000);
  EXPECT_EQ(bench.last<FixAttitude>()->coasting, 1);
  EXPECT_NEAR(bench.last<FixVelocityD>()->velocity_down_mps, 0, 0.01);
}

struct BadFix {
  const char* name;
  FixOutcome expected;
  void (*send)(Vehicle&);
};

class BadFixes : public testing::TestWithParam<BadFix> {};

// Each bad fix is answered with its reason and counted, and does not change the estimate.
TEST_P(BadFixes, AreAnsweredWithTheirReasonAndLeaveNoTrace) {
  for (const Algorithm algorithm : {Algorithm::ekf, Algorithm::ukf, Algorithm::sin_cos}) {
    const auto flight = [&](bool bad) {
      Vehicle bench(by_gps, algorithm);
      for (int second = 1; second <= 4; ++second) {
        bench.imu_until(second * 1'000'000L);
        bench.gps(second * 1'000'000L, second % 2);
      }
      bench.imu_until(4'500'000);
      const std::size_t before = bench.all<FixStatus>().size();
      if (bad) {
        GetParam().send(bench);
        EXPECT_EQ(bench.all<FixStatus>().size(), before + 1);
        EXPECT_EQ(bench.outcome(), GetParam().expected);
        const auto status = bench.last<FixStatus>();
        EXPECT_EQ(status->gated + status->refused, 1);
        EXPECT_EQ(status->gated, GetParam().expected == FixOutcome::gated ? 1 : 0);
        EXPECT_TRUE(std::isfinite(bench.last<FixPositionLatitude>()->latitude_deg));
      }
      bench.forget();
      for (int second = 5; second <= 6; ++second) {
        bench.imu_until(second * 1'000'000L);
        bench.gps(second * 1'000'000L, second % 2);
      }
      std::vector<double> estimates;
      for (const auto& a : bench.all<FixAttitude>()) estimates.push_back(a.heading_deg);
      for (const auto& v : bench.all<FixVelocityNE>()) estimates.push_back(v.velocity_north_mps);
      for (const auto& u : bench.all<FixUpdate>()) estimates.push_back(u.nis);
      EXPECT_EQ(bench.last<TargetHeartbeat>()->state, TargetState::running);
      return estimates;
    };
    EXPECT_EQ(flight(true), flight(false));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Fixes, BadFixes,
    testing::Values(
        BadFix{"OfTheAidNotChosen", FixOutcome::wrong_source, [](Vehicle& b) { b.ssbl(4'500'000); }},
        BadFix{"FlaggedInvalid", FixOutcome::invalid,
               [](Vehicle& b) { b.gps(4'500'000, 0, Validity::invalid); }},
        BadFix{"OffTheGlobe", FixOutcome::invalid,
               [](Vehicle& b) { b.gps(4'500'000, 0, Validity::valid, -214.7483648); }},
        BadFix{"FromTheFuture", FixOutcome::future, [](Vehicle& b) { b.gps(5'500'000); }},
        BadFix{"BeforeTheStart", FixOutcome::before_start, [](Vehicle& b) { b.gps(-10'000); }},
        BadFix{"BeforeTheLastFix", FixOutcome::out_of_order, [](Vehicle& b) { b.gps(3'900'000); }},
        BadFix{"TwiceTheSame", FixOutcome::out_of_order, [](Vehicle& b) { b.gps(4'000'000); }},
        BadFix{"JumpOfAKilometre", FixOutcome::gated, [](Vehicle& b) { b.gps(4'500'000, 1000); }}),
    [](const auto& which) { return which.param.name; });

TEST(InflightAlignment, AFixOlderThanTheHistoryIsLate) {
  Vehicle bench(by_gps);
  bench.imu_until(9'000'000);
  bench.gps(1'000'000);
  EXPECT_EQ(bench.outcome(), FixOutcome::late);
  bench.sync(9'000'000);
  EXPECT_GE(bench.last<FixStatus>()->refused, 1);
  bench.imu_until(9'100'000);
  EXPECT_EQ(bench.last<TargetCounters>()->late, 1);
}

// An encoder that does not check for NaN sends the raw minimum instead of NaN.
TEST(InflightAlignment, TheRawMinimumIsNoRelativePosition) {
  Vehicle bench(by_ssbl);
  bench.imu_until(1'000'000);
  Outbox<1> out;
  out.send(SsblRelativeNE{.position_validity = Validity::valid});
  Frame frame = out.frames().front();
  frame.data[4] |= 0x08U;  // bit 35: the sign of relative_north_m, whose other bits are 0
  e2e::protect({frame.data.data(), frame.size}, SsblRelativeNE::info.e2e_data_id, 0);
  ASSERT_LT(from_frame<SsblRelativeNE>(frame).relative_north_m, -83'886.0);
  bench.feed(frame);
  bench.send(SsblShipLatitude{.latitude_deg = latitude_deg, .height_m = height_m});
  bench.send(SsblShipLongitude{.longitude_deg = longitude_deg});
  bench.send(SsblRelativeD{.time_of_validity_us = 1'000'000});
  EXPECT_EQ(bench.outcome(), FixOutcome::invalid);
}

TEST(InflightAlignment, TheGateOpensAfterAsManyRejectionsAsConfigured) {
  Vehicle bench(by_gps, Algorithm::sin_cos, {{.parameter = Parameter::gate_recovery, .value = 3}});
  bench.imu_until(1'000'000);
  bench.gps(1'000'000);
  std::vector<FixOutcome> outcomes;
  for (int second = 2; second <= 6; ++second) {
    bench.imu_until(second * 1'000'000L);
    bench.gps(second * 1'000'000L, 1000);
    outcomes.push_back(bench.outcome());
  }
  EXPECT_THAT(outcomes, testing::ElementsAre(FixOutcome::gated, FixOutcome::gated, FixOutcome::gated,
                                             FixOutcome::recovered, FixOutcome::accepted));
  EXPECT_EQ(bench.last<FixStatus>()->gated, 3);
  // Nobody knows whether the fixes or the filter were 1 km off.
  EXPECT_NEAR(bench.last<FixPositionSigma>()->position_sigma_north_m, 778, 20);
  EXPECT_NEAR(bench.last<FixBiasSigma>()->fix_bias_sigma_north_m, 131, 0.1) << "the largest value on the bus";
  EXPECT_TRUE(std::isfinite(bench.last<FixVelocityNE>()->velocity_north_mps));
}

TEST(InflightAlignment, WithoutFixesItAnswersPredictionsAtTheOutputsRate) {
  Vehicle bench(by_gps);
  bench.imu_until(1'000'000);
  bench.gps(1'000'000);
  bench.imu_until(3'000'000);
  EXPECT_EQ(bench.all<FixUpdate>().size(), 1U);
  const double sigma_mps = bench.last<FixVelocitySigma>()->velocity_sigma_north_mps;
  bench.imu_until(13'000'000);
  const auto outputs = bench.all<FixVelocityD>();
  const auto predictions = bench.all<FixUpdate>();
  const auto after_2_s = std::ranges::count_if(
      outputs, [](const FixVelocityD& output) { return output.cause_time_us > 3'000'000; });
  ASSERT_EQ(predictions.size(), 1U + static_cast<std::size_t>(after_2_s));
  EXPECT_EQ(predictions.back().cause_time_us, outputs.back().cause_time_us);
  EXPECT_EQ(predictions.back().cause_counter, bench.last<FixVelocityNE>()->cause_counter);
  EXPECT_EQ(bench.last<FixStatus>()->outcome, FixOutcome::predicted);
  EXPECT_EQ(bench.last<FixStatus>()->source, FixSource::imu);
  EXPECT_EQ(bench.last<FixStatus>()->refused, 0);
  const auto sigmas = bench.all<FixVelocitySigma>();
  for (std::size_t i = 2; i < sigmas.size(); ++i)
    EXPECT_GE(sigmas[i].velocity_sigma_north_mps, sigmas[i - 1].velocity_sigma_north_mps) << i;
  // A tilt of 1 deg accelerates the INS by 0.17 m/s^2.
  EXPECT_GT(sigmas.back().velocity_sigma_north_mps, sigma_mps + 1.5);
  bench.gps(13'000'000);
  EXPECT_EQ(bench.outcome(), FixOutcome::accepted);
  bench.imu_until(14'000'000);
  EXPECT_EQ(bench.outcome(), FixOutcome::accepted);
}

TEST(InflightAlignment, WithoutAGateEveryFixIsTaken) {
  Vehicle bench(by_gps, Algorithm::sin_cos, {{.parameter = Parameter::gate_nis, .value = 0}});
  bench.imu_until(1'000'000);
  bench.gps(1'000'000, 1000);
  EXPECT_EQ(bench.outcome(), FixOutcome::accepted);
  EXPECT_TRUE(bench.device().running());
}

// The north velocity at the end of a run whose fixes arrive `late_us` after their time of validity.
double north_after(std::int64_t late_us, float late_fixes) {
  Vehicle bench(by_gps, Algorithm::sin_cos, {{.parameter = Parameter::late_fixes, .value = late_fixes}});
  for (std::int64_t t = 100'000; t <= 8'000'000; t += 100'000) {
    bench.imu_until(t);
    const std::int64_t valid_us = t - late_us;
    if (valid_us >= 1'000'000 && valid_us <= 5'000'000 && valid_us % 1'000'000 == 0)
      bench.gps(valid_us, static_cast<double>(valid_us) * 1e-6);
  }
  return bench.last<FixVelocityNE>()->velocity_north_mps;
}

TEST(InflightAlignment, AppliesALateFixAtItsTimeOfValidity) {
  const double in_time = north_after(0, 1);
  for (const std::int64_t late_us : {200'000, 1'300'000, 2'000'000})
    EXPECT_EQ(north_after(late_us, 1), in_time);
  EXPECT_NE(north_after(1'300'000, 0), in_time) << "at arrival, as asked for";
}

TEST(InflightAlignment, KeepsAFixThatIsAheadOfTheImu) {
  Vehicle bench(by_gps);
  bench.imu_until(1'000'000);
  bench.gps(1'020'000);
  EXPECT_FALSE(bench.last<FixUpdate>());
  bench.imu_until(1'020'000);
  ASSERT_TRUE(bench.last<FixUpdate>());
  EXPECT_EQ(bench.last<FixUpdate>()->cause_time_us, 1'020'000U);
}

TEST(InflightAlignment, EveryFixOfAQueueThatOverflowsIsAnswered) {
  Vehicle bench(by_gps);
  bench.imu_until(1'000'000);
  for (int k = 1; k <= 6; ++k) bench.gps(1'000'000 + k * 10'000);
  EXPECT_EQ(bench.all<FixStatus>().size(), 2U);  // the fifth and the sixth fix
  EXPECT_EQ(bench.outcome(), FixOutcome::future);
  bench.imu_until(1'010'000);
  bench.lose_imu(1'020'000);
  bench.lose_imu(1'030'000);
  bench.lose_imu(1'040'000);
  bench.imu(1'050'000);
  EXPECT_EQ(bench.all<FixStatus>().size(), 6U);
  EXPECT_EQ(bench.all<FixUpdate>().size(), 6U);
}

TEST(InflightAlignment, RefusesAlgorithmsOfOthers) {
  BenchSide bench;
  bench.command(Command::reset, Estimator::inflight_alignment, Algorithm::kalman);
  EXPECT_EQ(bench.last<TargetHeartbeat>()->error_command, 1);
  bench.command(Command::reset, Estimator::transfer_alignment, Algorithm::sin_cos);
  EXPECT_EQ(bench.last<TargetHeartbeat>()->error_command, 1);
}

TEST(InflightAlignment, KeepsTheSettingOfTheAidOnceItRuns) {
  Vehicle bench(by_gps);
  bench.send(ParamSet{.parameter = Parameter::aiding, .value = by_ssbl});
  EXPECT_EQ(bench.last<ParamAck>()->status, ParameterStatus::wrong_state);
  bench.send(ParamSet{.parameter = Parameter::gate_nis, .value = 16});
  EXPECT_EQ(bench.last<ParamAck>()->status, ParameterStatus::accepted);
  bench.send(ParamSet{.parameter = Parameter::fix_noise_horizontal_m, .value = 0});
  EXPECT_EQ(bench.last<ParamAck>()->status, ParameterStatus::out_of_range);
  bench.send(ParamSet{.parameter = Parameter::h2_case, .value = 1});
  EXPECT_EQ(bench.last<ParamAck>()->status, ParameterStatus::unknown);
}

}  // namespace
}  // namespace canhil::target
