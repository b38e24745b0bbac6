// How the device handles frames that are lost, damaged, late or marked as invalid.
#include <gtest/gtest.h>

#include "target/device/imu_stream.hpp"
#include "tests/unit/target/device/bench_side.hpp"

namespace canhil::target {
namespace {

using namespace messages;

TEST(SensorLoss, AFrameWithAWrongCrcIsDroppedAndCounted) {
  BenchSide bench;
  bench.start();
  Outbox<1> out;
  out.send(BenchSide::velocity());
  Frame frame = out.frames().front();
  frame.data[3] ^= 0x10U;
  bench.feed(frame);
  bench.sync(0);
  EXPECT_EQ(bench.last<TargetCounters>()->bad_crc, 1);
  EXPECT_EQ(bench.last<TargetHeartbeat>()->error_input_lost, 1);
}

TEST(SensorLoss, AFrameOfTheWrongSizeOrFormatIsDroppedAndCounted) {
  const auto wrong = [](auto change) {
    BenchSide bench;
    bench.start();
    Outbox<1> out;
    out.send(BenchSide::velocity());
    Frame frame = out.frames().front();
    change(frame);
    bench.feed(frame);
    bench.sync(0);
    EXPECT_EQ(bench.last<TargetCounters>()->bad_crc, 1);
    EXPECT_EQ(bench.last<TargetHeartbeat>()->error_input_lost, 1);
  };
  wrong([](Frame& frame) { frame.size = 4; });
  wrong([](Frame& frame) { frame.fd = true; });
  wrong([](Frame& frame) {  // the CRC is correct for the 12 bytes
    frame.size = 12;
    frame.data[0] = e2e::crc(frame.payload(), SlaveImuDeltaV::info.e2e_data_id);
  });
}

TEST(SensorLoss, AGroupThatMissesAFrameIsNotUsed) {
  BenchSide bench;
  bench.start();
  bench.imu(10'000);
  bench.send(BenchSide::theta(Validity::valid));
  bench.lose(BenchSide::velocity());
  bench.send(BenchSide::status(20'000, 10'000));
  EXPECT_EQ(bench.all<AlignVelocityD>().size(), 1U);
  bench.imu(30'000);
  bench.sync(30'000);
  EXPECT_EQ(bench.all<AlignVelocityD>().size(), 2U);
  EXPECT_EQ(bench.last<TargetCounters>()->bad_group, 1);
  EXPECT_EQ(bench.last<TargetCounters>()->frames_lost, 1);
}

TEST(SensorLoss, ALostGroupIsBridgedAndFlaggedOnce) {
  BenchSide bench;
  bench.start();
  bench.imu(10'000);
  bench.lose_imu(20'000);
  bench.imu(30'000);
  EXPECT_EQ(bench.last<AlignAttitude>()->coasting, 1);
  EXPECT_EQ(bench.last<AlignVelocityD>()->cause_time_us, 30'000U);
  // The missing specific force is bridged, so the vertical velocity stays near zero.
  EXPECT_NEAR(bench.last<AlignVelocityD>()->velocity_down_mps, 0, 0.01);
  bench.imu(40'000);
  EXPECT_EQ(bench.last<AlignAttitude>()->coasting, 0);
  EXPECT_EQ(bench.last<TargetHeartbeat>()->state, TargetState::running);
}

TEST(SensorLoss, ABridgeIsTheMeanOfItsNeighboursAtTheirRates) {
  const auto accelerated = [](BenchSide& bench, std::int64_t t_us, double delta_v_x_mps) {
    auto velocity = BenchSide::velocity();
    velocity.delta_v_x_mps = delta_v_x_mps;
    bench.send(BenchSide::theta(Validity::valid));
    bench.send(velocity);
    bench.send(BenchSide::status(t_us, 10'000));
  };
  // Two samples are lost between samples of 0.1 and 0.3 m/s. Each lost sample is replaced by 0.2 m/s.
  BenchSide bench;
  bench.start();
  accelerated(bench, 10'000, 0.1);
  bench.lose_imu(20'000);
  bench.lose_imu(30'000);
  accelerated(bench, 40'000, 0.3);
  EXPECT_NEAR(bench.last<AlignVelocityNE>()->velocity_north_mps, BenchSide::speed + 0.1 + 2 * 0.2 + 0.3,
              2e-3);
}

TEST(SensorLoss, AFrameThatRepeatsItsCounterIsLateNotUsed) {
  BenchSide bench;
  bench.start();
  bench.imu(10'000);
  const std::vector<Frame> fed = bench.fed();
  for (auto frame = fed.end() - 3; frame != fed.end(); ++frame) bench.feed(*frame);
  bench.sync(10'000);
  EXPECT_EQ(bench.all<AlignVelocityD>().size(), 1U);
  EXPECT_EQ(bench.last<TargetCounters>()->late, 3);
  EXPECT_EQ(bench.last<TargetCounters>()->bad_group, 0);
  EXPECT_TRUE(bench.device().running());
}

TEST(SensorLoss, AnInvalidGroupIsBridgedAndCounted) {
  BenchSide bench;
  bench.start();
  bench.imu(10'000);
  bench.imu(20'000, 10'000, Validity::invalid);
  EXPECT_EQ(bench.all<AlignVelocityD>().size(), 1U);
  bench.imu(30'000);
  bench.sync(30'000);
  EXPECT_EQ(bench.last<AlignAttitude>()->coasting, 1);
  EXPECT_EQ(bench.last<TargetCounters>()->bad_group, 1);
}

TEST(SensorLoss, AGroupOutOfOrderIsLateNotUsed) {
  BenchSide bench;
  bench.start();
  for (int k = 1; k <= 5; ++k) bench.imu(k * 10'000L);
  bench.imu(30'000);
  bench.sync(50'000);
  EXPECT_EQ(bench.all<AlignVelocityD>().size(), 5U);
  EXPECT_EQ(bench.last<TargetCounters>()->late, 1);
}

TEST(SensorLoss, AnImuThatStaysAwayIsNamed) {
  BenchSide bench;
  bench.start();
  bench.imu(10'000);
  for (int k = 1; k <= 51; ++k) bench.sync(k * 10'000L);
  EXPECT_TRUE(bench.device().running());
  bench.sync(520'000);
  EXPECT_EQ(bench.last<TargetHeartbeat>()->state, TargetState::fault);
  EXPECT_EQ(bench.last<TargetHeartbeat>()->error_input_silent, 1);
}

TEST(SensorLoss, AGapTooLongToBridgeEndsTheAlignment) {
  BenchSide bench;
  bench.start();
  bench.imu(10'000);
  bench.imu(400'000);
  EXPECT_EQ(bench.last<TargetHeartbeat>()->state, TargetState::fault);
  EXPECT_EQ(bench.last<TargetHeartbeat>()->error_input_silent, 1);
}

// The device bridges the whole gap while it processes one frame. With steps of 10 us, the interval of the
// sample after the gap, the device would need 20,000 steps.
TEST(SensorLoss, AGapBeforeAVeryShortSampleIsBridgedInFewSteps) {
  ImuStream imu;
  imu.start(0, 10'000);
  Answers answers;
  Losses losses;
  Errors errors;
  ConsistencyMonitor consistency;
  Context context{200'000, answers, losses, errors, consistency};
  int steps = 0, reached = 0;
  double seconds = 0;
  const auto receive = [&](const auto& message) {
    return imu.receive(
        to_frame(message, 0), 0, context,
        [&](const strapdown::ImuIncrement& increment, std::int64_t) {
          ++steps;
          seconds += increment.dt;
        },
        [&] {
          ++reached;
          return Health::good;
        });
  };
  receive(BenchSide::theta(Validity::valid));
  receive(BenchSide::velocity());
  EXPECT_EQ(reached, 0);
  EXPECT_EQ(receive(BenchSide::status(200'000, 10)), Health::good);
  EXPECT_EQ(reached, 1);
  EXPECT_LE(steps, 500);
  EXPECT_NEAR(seconds, 0.2, 1e-9);
  EXPECT_EQ(imu.now_us(), 200'000);
}

TEST(SensorLoss, AFixFromTheFutureIsDropped) {
  BenchSide bench;
  bench.start();
  bench.imu(10'000);
  bench.master(2'000'000);
  for (int k = 2; k <= 20; ++k) bench.imu(k * 10'000L);
  bench.sync(200'000);
  EXPECT_FALSE(bench.last<AlignUpdate>());
  EXPECT_EQ(bench.last<TargetCounters>()->bad_group, 1);
}

TEST(SensorLoss, TimeOfValidityMayWrap) {
  BenchSide bench;
  bench.command(Command::reset);
  const std::int64_t start_us = (std::int64_t{1} << 32) - 50'000;
  bench.sync(start_us);
  bench.initialise();
  bench.send(TargetInitLatitude{.latitude_deg = 37, .height_m = 1000});
  bench.send(TargetInitLongitude{.longitude_deg = 127, .position_sigma_m = 10});
  bench.send(TargetInitVelocityNE{.velocity_north_mps = BenchSide::speed});
  bench.send(TargetInitAttitude{});
  bench.send(TargetInitSigma{.velocity_sigma_mps = 1, .tilt_sigma_deg = 1, .heading_sigma_deg = 1});
  bench.send(TargetInitVelocityD{.time_of_validity_us = wrap_us(start_us)});
  bench.command(Command::start);
  for (int k = 1; k <= 20; ++k) {
    bench.imu(start_us + k * 10'000L);
    bench.sync(start_us + k * 10'000L);
  }
  EXPECT_EQ(bench.all<AlignVelocityD>().size(), 20U);
  EXPECT_EQ(bench.last<AlignVelocityD>()->cause_time_us, wrap_us(start_us + 200'000));
  EXPECT_EQ(bench.last<TargetCounters>()->late, 0);
  EXPECT_TRUE(bench.device().running());
}

}  // namespace
}  // namespace canhil::target
