// Several estimators on one device receive the same sensors and do not influence each other.
#include <gmock/gmock.h>

#include "tests/unit/target/device/bench_side.hpp"

namespace canhil::target {
namespace {

using namespace messages;

// The last heartbeat of one estimator.
std::optional<TargetHeartbeat> beat_of(const BenchSide& bench, Estimator estimator) {
  std::optional<TargetHeartbeat> last;
  for (const TargetHeartbeat& beat : bench.all<TargetHeartbeat>()) {
    if (beat.estimator == estimator) last = beat;
  }
  return last;
}

TargetState state_of(const BenchSide& bench, Estimator estimator) {
  const auto beat = beat_of(bench, estimator);
  EXPECT_TRUE(beat) << name_of(estimator) << " has no heartbeat";
  return beat ? beat->state : TargetState::fault;
}

// Transfer and in-flight alignment, ready to start.
BenchSide& make_ready(BenchSide& bench) {
  bench.command(Command::reset, Estimator::transfer_alignment, Algorithm::kalman);
  bench.initialise();
  bench.command(Command::add, Estimator::inflight_alignment, Algorithm::ekf);
  bench.initialise();
  return bench;
}

TEST(SeveralEstimators, EachAnswersAndHasItsHeartbeat) {
  BenchSide bench;
  make_ready(bench).command(Command::start);
  EXPECT_EQ(state_of(bench, Estimator::transfer_alignment), TargetState::running);
  EXPECT_EQ(state_of(bench, Estimator::inflight_alignment), TargetState::running);
  bench.forget();
  bench.imu(10'000);
  bench.sync(10'000);
  EXPECT_EQ(bench.all<AlignVelocityD>().size(), 1U);
  EXPECT_EQ(bench.all<FixVelocityD>().size(), 1U);
  EXPECT_EQ(bench.all<TargetHeartbeat>().size(), 2U);
  EXPECT_EQ(bench.all<TargetCounters>().size(), 1U) << "of the device, not of an estimator";
  bench.sync(20'000, true);
  EXPECT_EQ(bench.all<StepDone>().size(), 1U);
}

TEST(SeveralEstimators, ParametersAreOfTheOneSelectedLast) {
  BenchSide bench;
  make_ready(bench);
  bench.send(ParamSet{.parameter = Parameter::aiding, .value = 1});
  EXPECT_EQ(bench.last<ParamAck>()->status, ParameterStatus::accepted);
  bench.send(ParamSet{.parameter = Parameter::h2_case, .value = 1});
  EXPECT_EQ(bench.last<ParamAck>()->status, ParameterStatus::unknown) << "one of transfer alignment";
}

TEST(SeveralEstimators, NoneStartsBeforeAllAreReady) {
  BenchSide bench;
  bench.command(Command::reset, Estimator::transfer_alignment, Algorithm::kalman);
  bench.initialise();
  bench.command(Command::add, Estimator::wind, Algorithm::ekf);
  bench.command(Command::start);
  EXPECT_FALSE(bench.device().running());
  EXPECT_EQ(beat_of(bench, Estimator::wind)->error_not_initialised, 1);
  EXPECT_EQ(beat_of(bench, Estimator::transfer_alignment)->error_not_initialised, 0);
  EXPECT_EQ(state_of(bench, Estimator::transfer_alignment), TargetState::ready);
  bench.initialise();
  bench.command(Command::start);
  EXPECT_EQ(state_of(bench, Estimator::wind), TargetState::running);
  EXPECT_EQ(state_of(bench, Estimator::transfer_alignment), TargetState::running);
}

TEST(SeveralEstimators, TheFaultOfOneLeavesTheOtherRunning) {
  BenchSide bench;
  bench.command(Command::reset, Estimator::transfer_alignment, Algorithm::kalman);
  bench.initialise();
  bench.command(Command::add, Estimator::los_rate, Algorithm::combined);
  bench.initialise();
  bench.command(Command::start);
  for (std::int64_t t_us = 10'000; t_us <= 600'000; t_us += 10'000) bench.sync(t_us);  // the IMU is silent
  EXPECT_EQ(state_of(bench, Estimator::transfer_alignment), TargetState::fault);
  EXPECT_EQ(beat_of(bench, Estimator::transfer_alignment)->error_input_silent, 1);
  EXPECT_EQ(state_of(bench, Estimator::los_rate), TargetState::running);
  EXPECT_TRUE(bench.device().running());
  bench.command(Command::stop);
  EXPECT_EQ(state_of(bench, Estimator::los_rate), TargetState::idle);
  EXPECT_FALSE(bench.device().running());
}

TEST(SeveralEstimators, AddIsRefusedWhereItCannotBe) {
  BenchSide bench;
  const auto refused = [&](Estimator estimator, Algorithm algorithm) {
    bench.forget();
    bench.command(Command::add, estimator, algorithm);
    return bench.last<TargetHeartbeat>()->error_command == 1 && !beat_of(bench, estimator);
  };
  EXPECT_TRUE(refused(Estimator::wind, Algorithm::ekf)) << "to nothing";
  bench.command(Command::reset, Estimator::transfer_alignment, Algorithm::kalman);
  EXPECT_TRUE(refused(Estimator::wind, Algorithm::ukf)) << "an algorithm that it does not have";
  make_ready(bench);
  bench.command(Command::add, Estimator::transfer_alignment, Algorithm::kalman);
  EXPECT_EQ(bench.last<TargetHeartbeat>()->error_command, 1) << "twice";
  make_ready(bench).command(Command::start);
  EXPECT_TRUE(refused(Estimator::wind, Algorithm::ekf)) << "while running";
}

TEST(SeveralEstimators, AnAddThatIsRepeatedSelectsAnew) {
  BenchSide bench;
  make_ready(bench).command(Command::add, Estimator::inflight_alignment, Algorithm::ukf);
  EXPECT_EQ(state_of(bench, Estimator::inflight_alignment), TargetState::idle);
  EXPECT_EQ(beat_of(bench, Estimator::inflight_alignment)->algorithm, Algorithm::ukf);
  EXPECT_EQ(beat_of(bench, Estimator::inflight_alignment)->error_command, 0);
  EXPECT_EQ(state_of(bench, Estimator::transfer_alignment), TargetState::ready);
}

TEST(SeveralEstimators, AResetForgetsAllOfThem) {
  BenchSide bench;
  make_ready(bench).start();
  bench.forget();
  bench.imu(10'000);
  bench.sync(10'000);
  EXPECT_EQ(bench.all<TargetHeartbeat>().size(), 1U);
  EXPECT_THAT(bench.all<FixVelocityD>(), testing::IsEmpty());
}

TEST(SeveralEstimators, AStartThatIsRepeatedStartsAllAnew) {
  const auto first_answers = [](int starts) {
    BenchSide bench;
    make_ready(bench);
    for (int i = 0; i < starts; ++i) bench.command(Command::start);
    bench.forget();
    bench.imu(10'000);
    return bench.answers();
  };
  EXPECT_EQ(first_answers(2), first_answers(1));
  EXPECT_EQ(first_answers(1).size(), 6U);
}

// The device holds back fixes that are newer than the last IMU sample. When an IMU sample arrives after the
// gap, the device answers all of these fixes.
TEST(SeveralEstimators, AllThatWaitedIsAnsweredWithOneSample) {
  BenchSide bench;
  make_ready(bench).command(Command::start);
  bench.imu(10'000);
  for (int i = 0; i < 8; ++i) bench.master(100'000 + i * 10'000);
  for (int i = 0; i < 4; ++i) {
    bench.send(SsblRelativeNE{.position_validity = Validity::valid});
    bench.send(SsblShipLatitude{.latitude_deg = 37, .height_m = 1000});
    bench.send(SsblShipLongitude{.longitude_deg = 127});
    bench.send(SsblRelativeD{.time_of_validity_us = static_cast<std::uint32_t>(100'000 + i * 10'000)});
  }
  bench.forget();
  bench.imu(200'000);
  EXPECT_EQ(bench.all<AlignInnovation>().size(), 8U);
  EXPECT_EQ(bench.all<AlignUpdate>().size(), 8U);
  EXPECT_EQ(bench.all<FixInnovation>().size(), 4U);
  EXPECT_EQ(bench.all<FixUpdate>().size(), 4U);
  EXPECT_EQ(bench.all<AlignVelocityD>().size(), 1U);
  EXPECT_EQ(bench.all<FixVelocityD>().size(), 1U);
}

}  // namespace
}  // namespace canhil::target
