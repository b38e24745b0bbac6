// Property: no allocation on the device's frame path after start-up.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "tests/unit/target/device/bench_side.hpp"

namespace {
std::atomic<std::size_t> allocations = 0;
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  if (void* memory = std::aligned_alloc(static_cast<std::size_t>(alignment), size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace canhil::target {
namespace {

// The frames of a session with everything in it: parameters, both algorithms, losses, late fixes, faults.
std::vector<Frame> session(messages::Algorithm algorithm) {
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
  for (int k = 201; k <= 260; ++k) bench.sync(k * 10'000L);  // the IMU falls silent: fault
  return bench.fed();
}

TEST(Allocation, TheFramePathOfTheDeviceHasNone) {
  for (const auto algorithm : {messages::Algorithm::kalman, messages::Algorithm::robust_h2}) {
    const std::vector<Frame> frames = session(algorithm);
    Device device;
    std::size_t answers = 0;
    const std::size_t before = allocations;
    for (const Frame& frame : frames) answers += device.receive(frame).size();
    EXPECT_EQ(allocations - before, 0U);
    EXPECT_GT(answers, 500U);
    EXPECT_EQ(device.state(), messages::TargetState::fault);
  }
}

TEST(Allocation, TheCounterOfThisTestCounts) {
  const std::size_t before = allocations;
  delete new Device;
  EXPECT_GT(allocations - before, 0U);
}

}  // namespace
}  // namespace canhil::target
