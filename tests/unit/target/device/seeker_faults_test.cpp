// Faults of the seeker: they are reported, bridged with growing sigmas, and the estimator recovers.
#include <gmock/gmock.h>

#include <string>

#include "tests/unit/target/device/missile.hpp"

namespace canhil::target {
namespace {

using namespace messages;

struct BadSample {
  const char* name;
  LosRateFault fault;
  void (*spoil)(SeekerSample&);
  bool concerns_low_pass;  // low_pass needs neither range nor missile acceleration
};

class BadSamples : public testing::TestWithParam<BadSample> {};

// From 2.6 s to 2.3 s before the closest approach, every group has the same fault.
TEST_P(BadSamples, AreNamedCoastedOverAndRecoveredFrom) {
  for (const Algorithm algorithm :
       {Algorithm::switched_table, Algorithm::combined, Algorithm::kalman, Algorithm::low_pass}) {
    SCOPED_TRACE(name_of(algorithm));
    Missile missile(algorithm);
    missile.fly_until(2.6);
    const double before = missile.sigma().los_rate_sigma_pitch_radps;
    EXPECT_EQ(missile.last<TargetHeartbeat>()->error_input_lost, 0);
    const bool coasts = algorithm != Algorithm::low_pass || GetParam().concerns_low_pass;
    double sigma = before;
    while (missile.truth().time_to_go > 2.3) {
      missile.fly(GetParam().spoil);
      ASSERT_EQ(missile.estimate().fault, GetParam().fault);
      ASSERT_EQ(missile.estimate().outcome, coasts ? LosRateOutcome::coasting : LosRateOutcome::updated);
      if (coasts) {
        ASSERT_GE(missile.sigma().los_rate_sigma_pitch_radps, sigma) << missile.truth().time_to_go;
        ASSERT_EQ(missile.sigma().nis, 0);
      }
      sigma = missile.sigma().los_rate_sigma_pitch_radps;
    }
    if (coasts) {
      EXPECT_GT(sigma, 1.3 * before);
    }
    while (missile.truth().time_to_go > 1.3) {
      missile.fly();
      ASSERT_EQ(missile.estimate().fault, LosRateFault::none);
      ASSERT_NE(missile.estimate().outcome, LosRateOutcome::coasting);
    }
    // The lag of the classical low-pass filter causes an error with and without the fault.
    EXPECT_LT(missile.rate_error(), algorithm == Algorithm::low_pass ? 3e-3 : 5e-4);
    EXPECT_TRUE(missile.device().running());
    EXPECT_EQ(missile.last<TargetHeartbeat>()->error_input_lost, 1);
    EXPECT_EQ(missile.last<TargetHeartbeat>()->error_numeric, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Seeker, BadSamples,
    testing::Values(
        BadSample{"ErrorAngleFlagged", LosRateFault::error_angle,
                  [](SeekerSample& s) { s.angles.error_validity = Validity::invalid; }, true},
        BadSample{"ErrorAngleOutsideTheFieldOfView", LosRateFault::field_of_view,
                  [](SeekerSample& s) { s.angles.error_yaw_rad = -0.16; }, true},
        BadSample{"ErrorAngleSaturated", LosRateFault::field_of_view,
                  [](SeekerSample& s) { s.angles.error_pitch_rad = 7; }, true},
        BadSample{"AntennaFlagged", LosRateFault::antenna,
                  [](SeekerSample& s) { s.antenna.antenna_validity = Validity::invalid; }, true},
        BadSample{"IntervalNone", LosRateFault::antenna, [](SeekerSample& s) { s.angles.interval_us = 0; },
                  true},
        BadSample{"IntervalTwiceAsLong", LosRateFault::antenna,
                  [](SeekerSample& s) { s.angles.interval_us = 10'000; }, true},
        BadSample{"AccelerationFlagged", LosRateFault::acceleration,
                  [](SeekerSample& s) { s.motion.acceleration_validity = Validity::invalid; }, false},
        BadSample{"RangeFlagged", LosRateFault::range_invalid,
                  [](SeekerSample& s) { s.range.range_validity = Validity::invalid; }, false},
        BadSample{"RangeZero", LosRateFault::range_invalid, [](SeekerSample& s) { s.range.range_m = 0; },
                  false},
        BadSample{"RangeNegative", LosRateFault::range_invalid,
                  [](SeekerSample& s) { s.range.range_m = -3000; }, false},
        BadSample{"ClosingSpeedFlagged", LosRateFault::closing_speed_invalid,
                  [](SeekerSample& s) { s.motion.closing_speed_validity = Validity::invalid; }, false},
        BadSample{"ClosingSpeedZero", LosRateFault::closing_speed_invalid,
                  [](SeekerSample& s) { s.motion.closing_speed_mps = 0; }, false},
        BadSample{"ClosingSpeedNegative", LosRateFault::closing_speed_invalid,
                  [](SeekerSample& s) { s.motion.closing_speed_mps = -900; }, false},
        BadSample{
            "RangeOutlier", LosRateFault::range_jump,
            [](SeekerSample& s) { s.range.range_m += s.range.time_of_validity_us % 10'000 < 1 ? 700 : -700; },
            false},
        BadSample{"ClosingSpeedOutlier", LosRateFault::range_jump,
                  [](SeekerSample& s) {
                    s.motion.closing_speed_mps += s.range.time_of_validity_us % 10'000 < 1 ? 700 : 350;
                  },
                  false}),
    [](const auto& which) { return which.param.name; });

TEST(SeekerLoss, ALostGroupIsBridgedAndNamed) {
  for (const Algorithm algorithm :
       {Algorithm::switched_table, Algorithm::combined, Algorithm::kalman, Algorithm::low_pass}) {
    SCOPED_TRACE(name_of(algorithm));
    Missile missile(algorithm), whole(algorithm);
    missile.fly_until(2.4);
    whole.fly_until(2.4);
    missile.fly_unheard();
    missile.fly();
    whole.fly();
    whole.fly();
    EXPECT_EQ(missile.estimate().outcome, LosRateOutcome::updated);
    EXPECT_EQ(missile.estimate().fault, LosRateFault::antenna);
    EXPECT_NEAR(missile.sigma().los_rate_sigma_pitch_radps / whole.sigma().los_rate_sigma_pitch_radps, 1,
                0.1);
    EXPECT_NEAR(missile.rate_error(), whole.rate_error(), 1e-4);
    EXPECT_EQ(missile.last<LosRateTarget>()->cause_time_us, missile.t_us());
    missile.fly();
    EXPECT_EQ(missile.estimate().outcome, LosRateOutcome::updated);
    EXPECT_EQ(missile.estimate().fault, LosRateFault::none);
    missile.fly_until(2);
    EXPECT_EQ(missile.last<TargetHeartbeat>()->error_input_lost, 1);
  }
}

TEST(SeekerLoss, AGroupThatMissesAFrameIsALostGroup) {
  Missile missile;
  missile.fly_until(2.4);
  missile.forget();
  const SeekerSample sample = missile.next();
  missile.send(sample.antenna);
  missile.lose(sample.angles);
  missile.send(sample.motion);
  missile.send(sample.range);
  EXPECT_TRUE(missile.answers().empty());
  missile.fly();
  EXPECT_EQ(missile.estimate().fault, LosRateFault::antenna);
  missile.fly_until(2.3);
  EXPECT_EQ(missile.last<TargetCounters>()->bad_group, 1);
  EXPECT_EQ(missile.last<TargetCounters>()->frames_lost, 1);
}

// dt is the difference of the times of validity, not the nominal period: with samples every 10 ms the filter
// tracks the same flight.
TEST(SeekerLoss, TheStepIsAsLongAsTheTimesOfValiditySay) {
  los_rate::EngagementSetup setup = Missile::rolling();
  setup.settings.sample_period = 0.01;
  Missile missile(Algorithm::combined, {{.parameter = Parameter::sample_period_ms, .value = 10}}, setup);
  std::int64_t t_us = 0;
  do {
    SeekerSample sample = missile.next();
    t_us += 10'000;
    sample.angles.interval_us = 10'000;
    sample.range.time_of_validity_us = wrap_us(t_us);
    missile.sync(t_us);
    missile.transmit(sample);
    ASSERT_EQ(missile.estimate().fault, LosRateFault::none);
  } while (missile.truth().time_to_go > 2);
  EXPECT_LT(missile.rate_error(), 3e-4);
}

TEST(SeekerLoss, ARangeThatStandsStillIsStaleAfterAWhile) {
  Missile missile;
  missile.fly_until(2.6);
  double frozen = 0;
  int believed = 0;
  const auto freeze = [&](SeekerSample& s) {
    frozen > 0 ? s.range.range_m = frozen : frozen = s.range.range_m;
  };
  do {
    missile.fly(freeze);
    ASSERT_LT(++believed, 100);
  } while (missile.estimate().fault == LosRateFault::none);
  EXPECT_EQ(missile.estimate().fault, LosRateFault::range_stale);
  EXPECT_EQ(missile.estimate().outcome, LosRateOutcome::coasting);
  EXPECT_NEAR(believed, 21, 1);  // 0.1 s of samples
  missile.fly();
  EXPECT_EQ(missile.estimate().fault, LosRateFault::none);
}

TEST(SeekerLoss, AJumpThatLastsIsBelievedInTheEnd) {
  Missile missile(Algorithm::combined, {{.parameter = Parameter::relock_samples, .value = 5}});
  missile.fly_until(3);
  const auto jump = [](SeekerSample& s) { s.range.range_m += 700; };
  for (int k = 0; k < 5; ++k) {
    missile.fly(jump);
    EXPECT_EQ(missile.estimate().fault, LosRateFault::range_jump) << k;
  }
  missile.fly(jump);
  EXPECT_EQ(missile.estimate().fault, LosRateFault::none);
}

TEST(SeekerLoss, AGapIsOneLongCoast) {
  Missile missile;
  missile.fly_until(2.6);
  const double before = missile.sigma().los_rate_sigma_pitch_radps;
  for (int k = 0; k < 80; ++k) missile.fly_unheard();
  missile.fly();
  EXPECT_EQ(missile.estimate().outcome, LosRateOutcome::coasting);
  EXPECT_GT(missile.sigma().los_rate_sigma_pitch_radps, 1.5 * before);
  EXPECT_EQ(missile.last<TargetHeartbeat>()->error_input_silent, 0);
  missile.fly_until(1.2);
  EXPECT_LT(missile.rate_error(), 1e-3);
}

TEST(SeekerLoss, ASeekerThatStaysAwayIsNamedAndTheTargetAcquiredAnew) {
  Missile missile;
  missile.fly_until(3.5);
  for (int k = 0; k < 120; ++k) missile.fly_unheard();
  EXPECT_EQ(missile.last<TargetHeartbeat>()->error_input_silent, 1);
  EXPECT_TRUE(missile.device().running());
  missile.fly();
  EXPECT_EQ(missile.estimate().outcome, LosRateOutcome::started);
  EXPECT_EQ(missile.estimate().fault, LosRateFault::none);
  EXPECT_NEAR(missile.sigma().los_rate_sigma_pitch_radps, 0.05, 1e-3);
  missile.fly_until(1.1);
  EXPECT_LT(missile.rate_error(), 1e-3);
}

TEST(SeekerLoss, ASeekerThatNeverSpeaksIsNamed) {
  Missile missile;
  for (int k = 0; k <= 50; ++k) missile.sync(k * 10'000L);
  EXPECT_EQ(missile.last<TargetHeartbeat>()->error_input_silent, 0);
  missile.sync(600'000);
  EXPECT_EQ(missile.last<TargetHeartbeat>()->error_input_silent, 1);
}

struct Untimely {
  const char* name;
  std::int64_t offset_us;
  int late, bad_group;
};

class UntimelyGroups : public testing::TestWithParam<Untimely> {};

// Untimely groups are answered and counted, but do not affect later answers.
TEST_P(UntimelyGroups, AreAnsweredCountedAndLeaveNoTrace) {
  const auto flight = [&](bool untimely) {
    Missile missile;
    missile.fly_until(2.4);
    const LosRateEstimate before = missile.estimate();
    const LosRateSigma sigma = missile.sigma();
    if (untimely) {
      SeekerSample sample = Missile().next();
      sample.angles.error_pitch_rad = 0.1;
      sample.range.time_of_validity_us = wrap_us(missile.t_us() + GetParam().offset_us);
      const std::size_t answers = missile.all<LosRateTarget>().size();
      missile.transmit(sample);
      EXPECT_EQ(missile.all<LosRateTarget>().size(), answers + 1);
      EXPECT_EQ(missile.last<LosRateTarget>()->cause_time_us, sample.range.time_of_validity_us);
      EXPECT_EQ(missile.estimate().outcome, LosRateOutcome::bad_step);
      EXPECT_EQ(missile.estimate().los_rate_pitch_radps, before.los_rate_pitch_radps);
      EXPECT_EQ(missile.sigma().los_rate_sigma_yaw_radps, sigma.los_rate_sigma_yaw_radps);
      EXPECT_EQ(missile.sigma().nis, 0);
    }
    missile.forget();
    missile.fly_until(2.1);
    EXPECT_EQ(missile.last<TargetCounters>()->late, untimely ? GetParam().late : 0);
    EXPECT_EQ(missile.last<TargetCounters>()->bad_group, untimely ? GetParam().bad_group : 0);
    std::vector<double> estimates;
    for (const auto& e : missile.all<LosRateEstimate>()) estimates.push_back(e.los_rate_pitch_radps);
    for (const auto& s : missile.all<LosRateSigma>()) estimates.push_back(s.nis);
    return estimates;
  };
  EXPECT_EQ(flight(true), flight(false));
}

INSTANTIATE_TEST_SUITE_P(Seeker, UntimelyGroups,
                         testing::Values(Untimely{"TwiceTheSameTime", 0, 1, 0},
                                         Untimely{"OutOfOrder", -5'000, 1, 0},
                                         Untimely{"MinutesOld", -60'000'000, 1, 0},
                                         Untimely{"FromTheFuture", 150'000, 0, 1},
                                         Untimely{"FromTheFarFuture", 60'000'000, 0, 1}),
                         [](const auto& which) { return which.param.name; });

TEST(SeekerLoss, AnUntimelyGroupBeforeTheFirstSampleClaimsNothing) {
  Missile missile;
  SeekerSample sample = missile.next();
  sample.range.time_of_validity_us = 10'000'000;
  missile.transmit(sample);
  EXPECT_EQ(missile.estimate().outcome, LosRateOutcome::bad_step);
  EXPECT_NEAR(missile.sigma().los_rate_sigma_pitch_radps, 0.05, 1e-5);
  EXPECT_NEAR(missile.sigma().target_acceleration_sigma_y_mps2, 40, 1);
}

TEST(SeekerLoss, BlindnessOutlivesAnUntimelyGroup) {
  Missile missile;
  missile.fly_until(0.04);
  ASSERT_EQ(missile.estimate().blind, 1);
  SeekerSample sample = Missile().next();
  sample.range.time_of_validity_us = wrap_us(missile.t_us() - 5'000);
  missile.transmit(sample);
  EXPECT_EQ(missile.estimate().blind, 1);
}

// After the pass, target and range are lost for ten seconds.
TEST(SeekerLoss, AfterThePassTheSigmasGrowToTheirLimit) {
  Missile missile;
  while (!missile.over()) missile.fly();
  SeekerSample sample = Missile().next();
  sample.angles.error_validity = sample.range.range_validity = Validity::invalid;
  double sigma = 0;
  for (int k = 1; k <= 2000; ++k) {
    const std::int64_t t_us = missile.t_us() + k * Missile::period_us;
    sample.range.time_of_validity_us = wrap_us(t_us);
    missile.sync(t_us);
    missile.transmit(sample);
    ASSERT_EQ(missile.estimate().outcome, LosRateOutcome::coasting);
    ASSERT_EQ(missile.estimate().blind, 1);
    ASSERT_GE(missile.sigma().los_rate_sigma_pitch_radps, sigma);
    sigma = missile.sigma().los_rate_sigma_pitch_radps;
  }
  EXPECT_NEAR(sigma, 0.327, 2e-5);
  EXPECT_TRUE(missile.device().running());
}

TEST(SeekerLoss, TimeOfValidityMayWrap) {
  Missile missile;
  const std::int64_t offset_us = (std::int64_t{1} << 32) - 50'000;
  for (int k = 0; k < 20; ++k) {
    SeekerSample sample = missile.next();
    sample.range.time_of_validity_us = wrap_us(offset_us + missile.t_us());
    missile.sync(offset_us + missile.t_us());
    missile.transmit(sample);
    EXPECT_EQ(missile.estimate().outcome, k == 0 ? LosRateOutcome::started : LosRateOutcome::start_up);
  }
}

}  // namespace
}  // namespace canhil::target
