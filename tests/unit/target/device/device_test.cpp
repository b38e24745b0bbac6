#include "target/device/device.hpp"

#include <gmock/gmock.h>

#include "tests/unit/target/device/bench_side.hpp"

namespace canhil::target {
namespace {

using namespace messages;

TEST(Device, AnswersAResetWithItsStateAndTheHashOfItsMessages) {
  BenchSide bench;
  bench.command(Command::reset);
  const auto heartbeat = bench.last<TargetHeartbeat>();
  ASSERT_TRUE(heartbeat);
  EXPECT_EQ(heartbeat->state, TargetState::idle);
  EXPECT_EQ(heartbeat->estimator, Estimator::transfer_alignment);
  EXPECT_EQ(heartbeat->dbc_hash, exchange_hash24("transfer_alignment"));
  EXPECT_EQ(heartbeat->error_command, 0);
}

TEST(Device, RefusesACommandOfAnotherDbc) {
  BenchSide bench;
  bench.command(Command::reset);
  bench.initialise();
  bench.send(TargetCommand{.command = Command::start, .dbc_hash = exchange_hash24("none") ^ 1U});
  EXPECT_EQ(bench.last<TargetHeartbeat>()->state, TargetState::ready);
  EXPECT_EQ(bench.last<TargetHeartbeat>()->error_dbc_mismatch, 1);
}

TEST(Device, RefusesAnEstimatorThatItDoesNotOffer) {
  BenchSide bench;
  bench.command(Command::reset, Estimator::none);
  EXPECT_EQ(bench.last<TargetHeartbeat>()->error_command, 1);
  bench.initialise();
  bench.command(Command::start);
  EXPECT_EQ(bench.last<TargetHeartbeat>()->state, TargetState::idle);
}

TEST(Device, DoesNotStartWithoutAWholeInitialState) {
  BenchSide bench;
  bench.command(Command::reset);
  bench.send(TargetInitLatitude{.latitude_deg = 37, .height_m = 1000});
  bench.command(Command::start);
  EXPECT_EQ(bench.last<TargetHeartbeat>()->state, TargetState::idle);
  EXPECT_EQ(bench.last<TargetHeartbeat>()->error_not_initialised, 1);
}

TEST(Device, ReadsBackEveryParameterAsItWasSet) {
  for (const Parameter parameter : enumerators<Parameter>) {
    int takers = 0;
    for (const auto& [estimator, algorithm] :
         {std::pair(Estimator::transfer_alignment, Algorithm::kalman),
          std::pair(Estimator::inflight_alignment, Algorithm::sin_cos),
          std::pair(Estimator::los_rate, Algorithm::combined), std::pair(Estimator::wind, Algorithm::ekf)}) {
      BenchSide bench;
      bench.command(Command::reset, estimator, algorithm);
      bench.send(ParamSet{.parameter = parameter, .value = 1.0F});
      ASSERT_EQ(bench.last<ParamAck>()->parameter, parameter);
      const ParameterStatus status = bench.last<ParamAck>()->status;
      if (status != ParameterStatus::unknown) ++takers;
      if (estimator == Estimator::los_rate && status == ParameterStatus::out_of_range)
        continue;  // this value is outside the range of a noise in rad
      EXPECT_EQ(bench.last<ParamAck>()->value, 1.0F) << name_of(parameter);
      EXPECT_TRUE(status == ParameterStatus::accepted || status == ParameterStatus::unknown);
    }
    EXPECT_GE(takers, 1) << name_of(parameter);
  }
}

TEST(Device, TakesWhatIsInTheRangeThatItReports) {
  const Device device;
  for (const auto& [estimator, algorithm] :
       {std::pair(Estimator::transfer_alignment, Algorithm::kalman),
        std::pair(Estimator::inflight_alignment, Algorithm::sin_cos),
        std::pair(Estimator::los_rate, Algorithm::combined), std::pair(Estimator::wind, Algorithm::ekf)}) {
    for (const Parameter parameter : enumerators<Parameter>) {
      BenchSide bench;
      bench.command(Command::reset, estimator, algorithm);
      const auto status = [&](double value) {
        bench.send(ParamSet{.parameter = parameter, .value = static_cast<float>(value)});
        return bench.last<ParamAck>()->status;
      };
      const auto range = device.range(estimator, parameter);
      if (!range) {
        EXPECT_EQ(status(1), ParameterStatus::unknown) << name_of(parameter);
        continue;
      }
      const double inside = range->whole ? range->maximum : (range->minimum + range->maximum) / 2;
      EXPECT_EQ(status(inside), ParameterStatus::accepted) << name_of(parameter);
      EXPECT_EQ(status(range->minimum), ParameterStatus::accepted) << name_of(parameter);
      EXPECT_EQ(status(range->maximum), ParameterStatus::accepted) << name_of(parameter);
      EXPECT_EQ(status(range->maximum * 1.001 + 1e-3), ParameterStatus::out_of_range) << name_of(parameter);
      EXPECT_EQ(status(range->minimum - 1e-3), ParameterStatus::out_of_range) << name_of(parameter);
    }
  }
  EXPECT_TRUE(device.range(Estimator::transfer_alignment, Parameter::h2_case)->whole);
}

TEST(Device, KeepsTheOldValueOfAParameterThatItRefuses) {
  BenchSide bench;
  bench.command(Command::reset);
  bench.send(ParamSet{.parameter = Parameter::h2_case, .value = 5.0F});
  EXPECT_EQ(bench.last<ParamAck>()->status, ParameterStatus::out_of_range);
  EXPECT_EQ(bench.last<ParamAck>()->value, 2.0F);
  bench.send(ParamSet{.parameter = Parameter::velocity_noise_m2ps, .value = std::nanf("")});
  EXPECT_EQ(bench.last<ParamAck>()->status, ParameterStatus::out_of_range);
  bench.send(ParamSet{.parameter = static_cast<Parameter>(200), .value = 1.0F});
  EXPECT_EQ(bench.last<ParamAck>()->status, ParameterStatus::unknown);
  bench.start();
  bench.send(ParamSet{.parameter = Parameter::h2_case, .value = 1.0F});
  EXPECT_EQ(bench.last<ParamAck>()->status, ParameterStatus::wrong_state);
}

TEST(Device, AnswersEachImuGroupNamingItsCause) {
  BenchSide bench;
  bench.start();
  bench.imu(10'000);
  bench.imu(20'000);
  const auto closing = bench.all<AlignVelocityD>();
  ASSERT_EQ(closing.size(), 2U);
  EXPECT_EQ(closing[0].cause_time_us, 10'000U);
  EXPECT_EQ(closing[1].cause_time_us, 20'000U);
  EXPECT_EQ(bench.all<AlignVelocityNE>()[1].cause_counter, 1);
  EXPECT_EQ(bench.last<AlignAttitude>()->coasting, 0);
  EXPECT_NEAR(bench.last<AlignVelocityNE>()->velocity_north_mps, BenchSide::speed, 0.01);
}

TEST(Device, AnswersFasterImuGroupsAtTheOutputInterval) {
  BenchSide bench;
  bench.start();
  for (int k = 1; k <= 20; ++k) bench.imu(k * 5'000L, 5'000);
  EXPECT_EQ(bench.all<AlignVelocityD>().size(), 10U);
}

TEST(Device, AnswersEachMasterGroupWithSigmasAndInnovation) {
  BenchSide bench;
  bench.start();
  for (int k = 1; k <= 10; ++k) bench.imu(k * 10'000L);
  bench.master(100'000, BenchSide::speed - 0.5);
  const auto update = bench.last<AlignUpdate>();
  ASSERT_TRUE(update);
  EXPECT_EQ(update->cause_time_us, 100'000U);
  EXPECT_NEAR(bench.last<AlignInnovation>()->innovation_north_mps, 0.5, 0.01);
  EXPECT_GT(update->nis, 0);
  EXPECT_GT(bench.last<AlignAttitudeSigma>()->attitude_sigma_down_rad, 0.01);
  EXPECT_LT(bench.last<AlignVelocitySigma>()->velocity_sigma_north_mps, 0.5);
}

TEST(Device, AppliesALateFixAtItsTimeOfValidity) {
  // Two targets receive the same fixes, one target in time, the other 60 ms late. When both targets have
  // received all fixes, their answers agree bit for bit.
  const auto last_answer = [](int delay_samples) {
    BenchSide bench;
    bench.start();
    for (int k = 1; k <= 60; ++k) {
      bench.imu(k * 10'000L);
      const int valid = k - delay_samples;
      if (valid > 0 && valid % 10 == 0 && valid <= 50) bench.master(valid * 10'000L, BenchSide::speed - 0.3);
    }
    return std::tuple(bench.last<AlignVelocityNE>()->velocity_north_mps,
                      bench.last<AlignAttitude>()->pitch_deg, bench.last<TargetHeartbeat>()->state);
  };
  EXPECT_EQ(last_answer(0), last_answer(6));
}

TEST(Device, UsesALateFixOfAnyImu) {
  for (const std::int64_t interval_us : {1'000, 2'500, 10'000}) {
    BenchSide bench;
    bench.start();
    for (std::int64_t t_us = interval_us; t_us <= 1'000'000; t_us += interval_us)
      bench.imu(t_us, static_cast<double>(interval_us));
    bench.master(400'000);
    EXPECT_FALSE(bench.last<AlignUpdate>()) << interval_us;
    bench.master(600'000);
    EXPECT_TRUE(bench.last<AlignUpdate>()) << interval_us;
  }
}

TEST(Device, KeepsAFixThatIsAheadOfTheImu) {
  BenchSide bench;
  bench.start();
  bench.imu(10'000);
  bench.master(20'000);
  EXPECT_FALSE(bench.last<AlignUpdate>());
  bench.imu(20'000);
  ASSERT_TRUE(bench.last<AlignUpdate>());
  EXPECT_EQ(bench.last<AlignUpdate>()->cause_time_us, 20'000U);
}

TEST(Device, EveryFixThatIsAheadOfASlowImuWaits) {
  // A fix is sent every 20 ms; the IMU is 50 ms behind. The device holds back each fix until an IMU sample
  // with the time of this fix arrives.
  BenchSide bench;
  bench.start();
  for (int k = 1; k <= 30; ++k) {
    if (k % 2 == 0) bench.master(k * 10'000L);
    if (k > 5) bench.imu((k - 5) * 10'000L);
    bench.sync(k * 10'000L);
  }
  std::vector<std::uint32_t> applied;
  for (const auto& update : bench.all<AlignUpdate>()) applied.push_back(update.cause_time_us);
  EXPECT_THAT(applied, testing::ElementsAre(20'000U, 40'000U, 60'000U, 80'000U, 100'000U, 120'000U, 140'000U,
                                            160'000U, 180'000U, 200'000U, 220'000U, 240'000U));
  EXPECT_EQ(bench.last<TargetCounters>()->late, 0);
}

TEST(Device, FixesThatWaitedForOneImuSampleAreAllAnswered) {
  BenchSide bench;
  bench.start();
  bench.imu(10'000);
  for (int k = 2; k <= 10; ++k) bench.master(k * 10'000L);  // one fix more than the device can hold
  EXPECT_FALSE(bench.last<AlignUpdate>());
  bench.imu(150'000);  // the device bridges the gap before this sample
  bench.sync(150'000);
  EXPECT_EQ(bench.all<AlignUpdate>().size(), 8U);
  EXPECT_EQ(bench.all<AlignInnovation>().size(), 8U);
  EXPECT_EQ(bench.last<AlignVelocityD>()->cause_time_us, 150'000U);
  EXPECT_EQ(bench.last<TargetCounters>()->bad_group, 1);
}

TEST(Device, CountsAFixOlderThanItsHistoryAsLate) {
  BenchSide bench;
  bench.start();
  for (int k = 1; k <= 100; ++k) bench.imu(k * 10'000L);
  bench.master(10'000);
  bench.sync(1'000'000);
  EXPECT_FALSE(bench.last<AlignUpdate>());
  EXPECT_EQ(bench.last<TargetCounters>()->late, 1);
}

TEST(Device, AnswersAStepOfVirtualTimeLast) {
  BenchSide bench;
  bench.start();
  bench.forget();
  bench.sync(0, true);
  EXPECT_TRUE(bench.device().lockstep());
  ASSERT_FALSE(bench.answers().empty());
  EXPECT_EQ(bench.answers().back().id, StepDone::info.id);
  bench.imu(10'000);
  bench.sync(10'000, true);
  EXPECT_EQ(bench.last<StepDone>()->step, 1);
  bench.forget();
  bench.sync(20'000, false);
  EXPECT_FALSE(bench.last<StepDone>());
}

TEST(Device, BeatsEveryHundredMillisecondsOfTheTimeBase) {
  BenchSide bench;
  bench.start();
  bench.forget();
  for (int k = 0; k <= 40; ++k) {
    bench.sync(k * 10'000L);
    bench.imu((k + 1) * 10'000L);
  }
  EXPECT_EQ(bench.all<TargetHeartbeat>().size(), 5U);
  EXPECT_EQ(bench.all<TargetCounters>().size(), 5U);
}

TEST(Device, IsAfterAResetAsItWasAfterConstruction) {
  BenchSide used;
  used.start();
  for (int k = 1; k <= 30; ++k) used.imu(k * 10'000L);
  used.master(300'000);

  const auto session = [](BenchSide& bench) {
    bench.forget();
    bench.start();
    bench.sync(0);
    for (int k = 1; k <= 30; ++k) {
      bench.imu(k * 10'000L);
      if (k % 10 == 0) bench.master(k * 10'000L);
      bench.sync(k * 10'000L);
    }
    return bench.answers();
  };
  // The new device receives the frames that the bench sent to the used device, because the counters of a new
  // bench would start at 0.
  BenchSide again;
  const std::size_t before = used.fed().size();
  const auto answers = session(used);
  std::vector<Frame> fresh;
  Device device;
  for (std::size_t i = before; i < used.fed().size(); ++i) {
    const auto part = device.receive(used.fed()[i]);
    fresh.insert(fresh.end(), part.begin(), part.end());
  }
  EXPECT_EQ(fresh, answers);
  EXPECT_GT(answers.size(), 100U);
}

// The answers of the device to a flight.
std::vector<Frame> flight_after(BenchSide& bench) {
  bench.forget();
  for (int k = 1; k <= 30; ++k) {
    bench.imu(k * 10'000L);
    if (k % 10 == 0) bench.master(k * 10'000L);
    bench.sync(k * 10'000L);
  }
  return bench.answers();
}

TEST(Device, RepeatedCommandsOfTheHandshakeLeaveNoTraceInTheRun) {
  BenchSide once;
  once.start();
  BenchSide twice;
  twice.command(Command::reset);
  twice.command(Command::reset);
  twice.initialise();
  twice.initialise();
  twice.command(Command::start);
  twice.command(Command::start);
  EXPECT_EQ(twice.last<TargetHeartbeat>()->error_command, 0);
  EXPECT_EQ(flight_after(once), flight_after(twice));
}

TEST(Device, HeartbeatsBeforeTheStartLeaveNoTraceInTheRun) {
  BenchSide plain;
  plain.start();
  BenchSide watched;
  watched.command(Command::reset);
  for (int k = 0; k < 4; ++k) static_cast<void>(watched.device().idle_heartbeat());
  watched.initialise();
  watched.command(Command::start);
  EXPECT_EQ(flight_after(plain), flight_after(watched));
}

TEST(Device, AStartInMidRunIsAnErrorAndChangesNothing) {
  BenchSide bench;
  bench.start();
  for (int k = 1; k <= 10; ++k) bench.imu(k * 10'000L);
  bench.command(Command::start);
  EXPECT_EQ(bench.last<TargetHeartbeat>()->error_command, 1);
  bench.imu(110'000);
  EXPECT_EQ(bench.last<AlignAttitude>()->coasting, 0);
  EXPECT_EQ(bench.last<AlignVelocityD>()->cause_time_us, 110'000U);
}

TEST(Device, HearsACommandThatRepeatsTheCounterOfTheLast) {
  BenchSide first;
  first.command(Command::reset);
  Outbox<1> second_bench;
  second_bench.send(TargetCommand{.command = Command::reset,
                                  .estimator = Estimator::transfer_alignment,
                                  .algorithm = Algorithm::robust_h2,
                                  .dbc_hash = exchange_hash24("transfer_alignment")});
  first.feed(second_bench.frames().front());  // counter 0 again
  EXPECT_EQ(first.last<TargetHeartbeat>()->algorithm, Algorithm::robust_h2);
}

}  // namespace
}  // namespace canhil::target
