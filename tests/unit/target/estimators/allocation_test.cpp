// Property: no allocation on the frame path, in the delivered libraries. The linker redirects their calls of
// malloc and similar functions to this file (--wrap, CMakeLists.txt), including those of Eigen. This file
// also defines operator new.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <new>

#include "target/estimators/inflight_alignment/history.hpp"
#include "target/estimators/los_rate/filter.hpp"
#include "target/estimators/transfer_alignment/history.hpp"
#include "target/estimators/wind/bank.hpp"
#include "tests/unit/target/estimators/flight.hpp"
#include "tests/unit/target/estimators/los_rate/engagement.hpp"

namespace {
std::atomic<std::size_t> allocations = 0;
}

// The names that the linker's option --wrap prescribes.
// NOLINTBEGIN(bugprone-reserved-identifier)
extern "C" {
void* __real_malloc(std::size_t size);
void* __real_calloc(std::size_t count, std::size_t size);
void* __real_realloc(void* memory, std::size_t size);
void* __real_aligned_alloc(std::size_t alignment, std::size_t size);

void* __wrap_malloc(std::size_t size) {
  ++allocations;
  return __real_malloc(size);
}
void* __wrap_calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __real_calloc(count, size);
}
void* __wrap_realloc(void* memory, std::size_t size) {
  ++allocations;
  return __real_realloc(memory, size);
}
void* __wrap_aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __real_aligned_alloc(alignment, size);
}
}
// NOLINTEND(bugprone-reserved-identifier)

// Not inlined, because GCC would otherwise report a mismatched free() in these functions.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (void* memory = std::malloc(size)) return memory;
  std::abort();
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  if (void* memory = std::aligned_alloc(static_cast<std::size_t>(alignment), size)) return memory;
  std::abort();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace canhil::transfer_alignment {
namespace {

// Global, because GCC would remove the allocation of a variable that is local to a test.
std::unique_ptr<int> kept_value;
Eigen::MatrixXd kept_matrix;

TEST(Allocation, OperatorNewIsCounted) {
  const std::size_t before = allocations;
  kept_value = std::make_unique<int>(1);
  EXPECT_EQ(allocations, before + 1);
}

TEST(Allocation, EigensOwnIsCounted) {
  const std::size_t before = allocations;
  kept_matrix.resize(2, 2);
  EXPECT_EQ(allocations, before + 1);
}

TEST(Allocation, TransferAlignmentAllocatesNothing) {
  for (const Algorithm algorithm : {Algorithm::kalman, Algorithm::robust_h2}) {
    for (const Loop loop : {Loop::open, Loop::published, Loop::invariant}) {
      Settings settings;
      settings.algorithm = algorithm;
      settings.loop = loop;
      History<64> history(0);
      State state = initial(published_start(), settings);
      const auto imu = flight_increment(flight_start(), 0, 0.01);
      Outcome worst = Outcome::ok;
      const std::size_t before = allocations;
      for (int k = 1; k <= 200; ++k) {
        history.propagate(state, imu, k * 10'000L, settings);
        if (k % 10 != 0) continue;
        const UpdateResult result =
            history.update(state, flight_start().v_eb_n, k * 10'000L - 55'000, settings);
        if (result.outcome != Outcome::ok) worst = result.outcome;
      }
      const std::size_t made = allocations - before;
      EXPECT_EQ(made, 0U);
      EXPECT_EQ(worst, Outcome::ok);
    }
  }
}

}  // namespace
}  // namespace canhil::transfer_alignment

namespace canhil::inflight_alignment {
namespace {

TEST(Allocation, InflightAlignmentAllocatesNothing) {
  for (const Algorithm algorithm : {Algorithm::ekf, Algorithm::ukf, Algorithm::sin_cos}) {
    for (const Aiding aiding : {Aiding::ssbl, Aiding::gps}) {
      for (const UkfRoot root : {UkfRoot::lower_cholesky, UkfRoot::symmetric}) {
        Settings settings;
        settings.algorithm = algorithm;
        settings.aiding = aiding;
        settings.ukf_root = root;
        settings.closed_loop = root == UkfRoot::symmetric;
        settings.longest_interval = 0.3;
        settings.gyro_bias_sigma_0 = 0;  // so that the ukf must repair P
        const strapdown::NavState start = transfer_alignment::flight_start();
        const auto imu = transfer_alignment::flight_increment(start, 0, 0.01);
        const auto history = std::make_unique<History<128>>(0);
        State state = initial(start, settings);
        int ok = 0;
        const std::size_t before = allocations;
        for (int k = 1; k <= 500; ++k) {
          history->propagate(state, imu, k * 10'000L, settings);
          if (k % 50 != 0) continue;
          const double north = start.v_eb_n.x() * (k * 0.01 - 0.455);
          const GeodeticPosition fix{start.latitude + north / 6.36e6, start.longitude, start.height};
          const UpdateResult result = history->update(state, fix, k * 10'000L - 455'000, settings);
          if (result.outcome == Outcome::ok && std::isfinite(estimate(state).nav.height)) ++ok;
          if (uncertainty(state).position.allFinite()) continue;
          ok = 0;
        }
        const std::size_t made = allocations - before;
        EXPECT_EQ(made, 0U);
        EXPECT_EQ(ok, 10);
        EXPECT_EQ(state.repairs > 0, algorithm == Algorithm::ukf);
      }
    }
  }
}

}  // namespace
}  // namespace canhil::inflight_alignment

namespace canhil::los_rate {
namespace {

TEST(Allocation, LosRateAllocatesNothing) {
  for (const Algorithm algorithm :
       {Algorithm::switched_table, Algorithm::combined, Algorithm::kalman, Algorithm::low_pass}) {
    EngagementSetup setup;
    setup.settings.algorithm = algorithm;
    setup.settings.noise.yaw.glint = 1;  // two gain sets
    setup.settings.start_up = 1;
    setup.roll_rate = 3;
    const Design design = make_design(setup.settings);
    Engagement engagement(setup);
    State state = initial();
    int updated = 0, coasted = 0;
    const std::size_t before = allocations;
    for (int k = 0; !engagement.over(); ++k) {
      Measurement m = engagement.next();
      m.error_valid = k % 600 < 580;  // the filter starts up again after each gap
      const UpdateResult result = step(state, m, design);
      if (result.outcome == Outcome::updated) ++updated;
      if (result.outcome == Outcome::coasting) ++coasted;
    }
    EXPECT_EQ(allocations - before, 0);
    EXPECT_GT(updated, 300);
    EXPECT_GT(coasted, 15);
  }
}

}  // namespace
}  // namespace canhil::los_rate

namespace canhil::wind {
namespace {

TEST(Allocation, WindAllocatesNothing) {
  for (const Algorithm algorithm : {Algorithm::ekf, Algorithm::h_infinity, Algorithm::adaptive_q}) {
    Settings settings;
    settings.algorithm = algorithm;
    settings.theta_per_s = 10;  // theta is capped at some updates
    settings.process_noise = ProcessNoise::likeliest;
    const BankDesign design = make_bank(settings);
    Start start;
    start.air_velocity << 250, 0, 2;
    start.v_eb_n << 255, 60, 2;
    start.omega.setZero();
    start.attitude.setZero();
    start.altitude = 10'000;
    Bank bank = initial(start, design);
    FinHistory fins;
    int outcomes[7] = {};
    const std::size_t before = allocations;
    for (int k = 0; k <= 500; ++k) {
      fins.push(k * 20'000L, {0, 0, 0.3 * (k % 2)}, 0.2);  // every other push is refused
      const Navigation sample{.t_us = k % 50 == 0 ? 0 : k * 20'000L,
                              .v_eb_n = start.v_eb_n + Eigen::Vector3d(0.01 * (k % 3), 0, 0),
                              .omega = start.omega,
                              .attitude = start.attitude,
                              .altitude = start.altitude,
                              .valid = k % 20 < 18 && k % 300 < 180};
      ++outcomes[static_cast<int>(step(bank, sample, fins, design).outcome)];
      if (k == 450)
        for (State& state : bank.states) state.x(0) = std::nan("");
      const Uncertainty sigma = uncertainty(bank.x, bank.P);
      if (sigma.along_track < 0 || estimate(bank.x).wind_speed < 0) std::abort();
    }
    const std::size_t made = allocations - before;
    EXPECT_EQ(made, 0U);
    for (const Outcome outcome : {Outcome::waiting, Outcome::started, Outcome::updated, Outcome::coasting,
                                  Outcome::out_of_order, Outcome::non_finite})
      EXPECT_GT(outcomes[static_cast<int>(outcome)], 0) << static_cast<int>(outcome);
  }
}

}  // namespace
}  // namespace canhil::wind
