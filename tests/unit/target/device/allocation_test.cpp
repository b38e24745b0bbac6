// Property: no allocation on the device's frame path after start-up.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "tests/unit/target/device/bench_side.hpp"
#include "tests/unit/target/device/missile.hpp"

namespace {
std::atomic<std::size_t> allocations = 0;
}

// Not inlined, because GCC would otherwise report a mismatched free() in these functions.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  if (void* memory = std::aligned_alloc(static_cast<std::size_t>(alignment), size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace canhil::target {
namespace {

/// Evidence that a session ran to its end.
struct Session {
  std::size_t answers_above;
  bool running;  ///< at the end
};

void expect_no_allocation(const std::vector<Frame>& frames, const Session& session) {
  Device device;
  std::size_t answers = 0;
  const std::size_t before = allocations;
  for (const Frame& frame : frames) answers += device.receive(frame).size();
  EXPECT_EQ(allocations - before, 0U);
  EXPECT_GT(answers, session.answers_above);
  EXPECT_EQ(device.running(), session.running);
}

// The frames of a session with all features: parameters, both algorithms, lost samples, late fixes, faults.
std::vector<Frame> transfer_session(messages::Algorithm algorithm) {
  using namespace messages;
  BenchSide bench;
  bench.command(Command::reset, Estimator::transfer_alignment, algorithm);
  bench.send(ParamSet{.parameter = Parameter::h2_case, .value = 1.0F});
  bench.initialise();
  bench.command(Command::start);
  for (int k = 1; k <= 200; ++k) {
    if (k % 37 == 0) {
      bench.lose_imu(k * 10'000L);
    } else {
      bench.imu(k * 10'000L);
    }
    if (k % 10 == 5) bench.master((k - 5) * 10'000L, BenchSide::speed + 0.1);
    bench.sync(k * 10'000L, k > 100);
  }
  for (int k = 201; k <= 260; ++k) bench.sync(k * 10'000L);  // the IMU falls silent, which causes a fault
  return bench.fed();
}

TEST(Allocation, TheFramePathOfTheDeviceHasNone) {
  for (const auto algorithm : {messages::Algorithm::kalman, messages::Algorithm::robust_h2}) {
    expect_no_allocation(transfer_session(algorithm), {.answers_above = 500, .running = false});
  }
}

// The frames of a session of in-flight alignment: fixes that are late, gated, invalid, or from the other aid,
// and a covariance P that needs a repair.
std::vector<Frame> inflight_session(messages::Algorithm algorithm) {
  using namespace messages;
  BenchSide bench;
  bench.command(Command::reset, Estimator::inflight_alignment, algorithm);
  bench.send(ParamSet{.parameter = Parameter::aiding, .value = 1.0F});
  bench.send(ParamSet{.parameter = Parameter::gyro_bias_sigma_degph, .value = 0.0F});
  bench.initialise();
  bench.command(Command::start);
  for (int k = 1; k <= 600; ++k) {
    if (k % 37 == 0) {
      bench.lose_imu(k * 10'000L);
    } else {
      bench.imu(k * 10'000L);
    }
    if (k % 50 == 0) {
      const double north_deg = BenchSide::speed * (k - 40) * 0.01 / 111e3;
      bench.send(GpsLatitude{.latitude_deg = k == 300 ? 38 : 37 + north_deg, .height_m = 1000});
      bench.send(GpsLongitude{.longitude_deg = 127,
                              .position_validity = k == 200 ? Validity::invalid : Validity::valid});
      bench.send(GpsTime{.time_of_validity_us = wrap_us((k - 40) * 10'000L)});
      bench.send(SsblRelativeNE{});
      bench.send(SsblShipLatitude{});
      bench.send(SsblShipLongitude{});
      bench.send(SsblRelativeD{});
    }
    bench.sync(k * 10'000L, k > 300);
  }
  for (int k = 601; k <= 660; ++k) bench.sync(k * 10'000L);
  return bench.fed();
}

TEST(Allocation, TheFramePathOfInflightAlignmentHasNone) {
  using messages::Algorithm;
  for (const auto algorithm : {Algorithm::ekf, Algorithm::ukf, Algorithm::sin_cos}) {
    expect_no_allocation(inflight_session(algorithm), {.answers_above = 1500, .running = false});
  }
}

// The frames of a session of the LOS rate: groups that are lost, invalid or late, and a seeker that falls
// silent and returns.
std::vector<Frame> los_rate_session(messages::Algorithm algorithm) {
  using namespace messages;
  Missile missile(algorithm, {{.parameter = Parameter::glint_noise_yaw_m, .value = 0.7F}});
  for (int k = 1; !missile.over(); ++k) {
    if (k % 37 == 0 || (k > 400 && k < 520)) {
      missile.fly_unheard();
    } else {
      missile.fly([k](SeekerSample& sample) {
        if (k % 29 == 0) sample.angles.error_validity = Validity::invalid;
        if (k % 31 == 0) sample.range.range_m = -1;
        if (k % 41 == 0) sample.range.time_of_validity_us = 0;
      });
    }
  }
  return missile.fed();
}

TEST(Allocation, TheFramePathOfTheLosRateHasNone) {
  using messages::Algorithm;
  for (const auto algorithm :
       {Algorithm::switched_table, Algorithm::combined, Algorithm::kalman, Algorithm::low_pass}) {
    expect_no_allocation(los_rate_session(algorithm), {.answers_above = 2500, .running = true});
  }
}

// The frames of a session of the wind: fins that are late or rejected; navigation that is lost or invalid,
// jumps, falls silent, and returns.
std::vector<Frame> wind_session(messages::Algorithm algorithm) {
  using namespace messages;
  BenchSide bench;
  bench.command(Command::reset, Estimator::wind, algorithm);
  bench.send(ParamSet{.parameter = Parameter::body_rate_noise_degpsprts, .value = 0.1F});
  bench.initialise();
  bench.send(TargetInitRate{});
  bench.send(TargetInitAirVelocity{.air_velocity_x_mps = BenchSide::speed, .air_velocity_z_mps = 5});
  bench.command(Command::start);
  for (int k = 1; k <= 600; ++k) {
    const std::int64_t t_us = k * 20'000L;
    if (k % 7 != 0) {
      bench.send(FinDeflections{
          .elevator_deg = k % 31 == 0 ? 40.0 : -1.0,
          .time_of_validity_us = static_cast<double>(wrap_short_us(t_us - (k % 11 == 0 ? 60'000 : 0)))});
    }
    if (k < 200 || k > 350) {  // 3 s of silence
      bench.send(GliderNavVelocityNE{
          .velocity_north_mps = BenchSide::speed + (k % 90 == 0 ? 100 : 0.1 * (k % 3)), .height_m = 5000});
      bench.send(GliderNavAttitude{.pitch_deg = k % 80 == 0 ? 89.0 : 2.0,
                                   .navigation_validity = k % 50 == 0 ? Validity::invalid : Validity::valid});
      if (k % 70 != 0) {
        bench.send(GliderNavRates{});
      } else {
        bench.lose(GliderNavRates{});
      }
      bench.send(GliderNavVelocityD{.time_of_validity_us = wrap_us(k == 500 ? 0 : t_us)});
    }
    bench.send(ParamSet{.parameter = Parameter::theta_per_s, .value = static_cast<float>(k % 4)});
    bench.sync(t_us, k > 300);
  }
  return bench.fed();
}

TEST(Allocation, TheFramePathOfTheWindHasNone) {
  using messages::Algorithm;
  for (const auto algorithm : {Algorithm::ekf, Algorithm::h_infinity, Algorithm::adaptive_q}) {
    expect_no_allocation(wind_session(algorithm), {.answers_above = 3500, .running = true});
  }
}

TEST(Allocation, TheCounterOfThisTestCounts) {
  const std::size_t before = allocations;
  delete new Device;
  EXPECT_GT(allocations - before, 0U);
}

}  // namespace
}  // namespace canhil::target
