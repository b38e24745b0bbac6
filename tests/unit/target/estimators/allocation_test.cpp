// Property: no allocation on the frame path. Counts operator new, and makes Eigen abort on an allocation of
// its own.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cstdlib>
#include <memory>
#include <new>

#include "target/estimators/transfer_alignment/history.hpp"
#include "tests/unit/target/estimators/flight.hpp"

namespace {
std::size_t allocations = 0;
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  std::abort();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace canhil::transfer_alignment {
namespace {

TEST(Allocation, OperatorNewIsCounted) {
  const std::size_t before = allocations;
  const auto value = std::make_unique<int>(1);
  EXPECT_EQ(allocations, before + 1);
}

TEST(Allocation, TransferAlignmentAllocatesNothing) {
  for (const Algorithm algorithm : {Algorithm::kalman, Algorithm::robust_h2}) {
    for (const bool closed_loop : {true, false}) {
      Settings settings;
      settings.algorithm = algorithm;
      settings.closed_loop = closed_loop;
      History<64> history(0);
      State state = initial(published_start(), settings);
      const auto imu = flight_increment(flight_start(), 0, 0.01);
      Outcome worst = Outcome::ok;
      Eigen::internal::set_is_malloc_allowed(false);
      const std::size_t before = allocations;
      for (int k = 1; k <= 200; ++k) {
        history.propagate(state, imu, k * 10'000L, settings);
        if (k % 10 != 0) continue;
        const UpdateResult result =
            history.update(state, flight_start().v_eb_n, k * 10'000L - 55'000, settings);
        if (result.outcome != Outcome::ok) worst = result.outcome;
      }
      const std::size_t made = allocations - before;
      Eigen::internal::set_is_malloc_allowed(true);
      EXPECT_EQ(made, 0);
      EXPECT_EQ(worst, Outcome::ok);
    }
  }
}

}  // namespace
}  // namespace canhil::transfer_alignment
