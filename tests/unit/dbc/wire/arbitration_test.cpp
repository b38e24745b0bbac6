#include "dbc/wire/arbitration.hpp"

#include <gtest/gtest.h>

namespace canhil::wire {
namespace {

TEST(ArbitrationRank, IsThatOfTheBitsOnTheWire) {
  EXPECT_LT(arbitration_rank(0x7FE, false), arbitration_rank(0x7FF, false));
  EXPECT_LT(arbitration_rank(0x100, false), arbitration_rank(0x100U << 18U, true));  // RTR before SRR
  EXPECT_LT(arbitration_rank((0x100U << 18U) | 0x3FFFF, true), arbitration_rank(0x101, false));
  EXPECT_LT(arbitration_rank(0x100U << 18U, true), arbitration_rank((0x100U << 18U) | 1, true));
}

}  // namespace
}  // namespace canhil::wire
