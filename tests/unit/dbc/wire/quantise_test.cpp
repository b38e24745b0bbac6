#include "dbc/wire/quantise.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

namespace canhil::wire {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(RoundHalfEven, InConstantExpressionsToo) {
  static_assert(round_half_even(0.5) == 0 && round_half_even(1.5) == 2 && round_half_even(2.5) == 2);
  static_assert(round_half_even(-0.5) == 0 && round_half_even(-1.5) == -2 && round_half_even(-2.5) == -2);
  static_assert(round_half_even(-0.75) == -1 && round_half_even(7) == 7 && round_half_even(-7) == -7);
}

// Compares both branches of round_half_even: one at run time, the other in a table made at compile time.
TEST(RoundHalfEven, BothWaysGiveTheSame) {
  constexpr auto table = [] {
    std::array<std::int64_t, 4001> rounded{};
    for (int i = 0; i <= 4000; ++i)
      rounded[static_cast<std::size_t>(i)] = round_half_even((i - 2000) * 0.125);
    return rounded;
  }();
  for (int i = 0; i <= 4000; ++i)
    EXPECT_EQ(table[static_cast<std::size_t>(i)], round_half_even((i - 2000) * 0.125)) << i;
}

TEST(Physical, IsRawTimesScalePlusOffset) {
  EXPECT_EQ(physical(3, 0.5, 0), 1.5);
  EXPECT_EQ(physical(3, 0.5, -2), -0.5);
}

TEST(Clamped, NanGoesToTheLowerBoundOrOnANegativeScaleToTheUpper) {
  EXPECT_EQ(clamped(nan, -2, 3), -2);
  EXPECT_EQ(clamped_nan_high(nan, -2, 3), 3);
  EXPECT_EQ(clamped(5, -2, 3), 3);
  EXPECT_EQ(clamped(-5, -2, 3), -2);
  EXPECT_EQ(clamped_nan_high(5, -2, 3), 3);
  EXPECT_EQ(clamped_nan_high(-5, -2, 3), -2);
  EXPECT_EQ(unrounded(nan, 1, 0, -2, 3), -2);
  EXPECT_EQ(unrounded(nan, -1, 0, -2, 3), 3);
}

TEST(Bound, NeverLeavesTheRange) {
  EXPECT_EQ(bound(std::numeric_limits<std::int64_t>::max()), 9223372036854774784.0);
  EXPECT_EQ(bound(std::numeric_limits<std::int64_t>::min()), -9223372036854775808.0);
  EXPECT_EQ(bound(std::numeric_limits<std::uint64_t>::max()), 18446744073709549568.0);
  EXPECT_EQ(bound(std::int64_t{-9223372036854775807}), -9223372036854774784.0);
  EXPECT_EQ(bound(std::uint64_t{1} << 53U), 9007199254740992.0);
  EXPECT_EQ(bound((std::uint64_t{1} << 53U) + 1), 9007199254740992.0);
  EXPECT_EQ(bound(std::int64_t{-5}), -5.0);
}

TEST(QuantisedWide, ReachesTheUpperHalf) {
  const double highest = bound(std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(quantised_wide(1e30, 1, 0, 0, highest), 18446744073709549568U);
  EXPECT_EQ(quantised_wide(9223372036854775808.0, 1, 0, 0, highest), 9223372036854775808U);
  EXPECT_EQ(quantised_wide(2.5, 1, 0, 0, highest), 2U);
  EXPECT_EQ(quantised_wide(nan, 1, 0, 0, highest), 0U);
}

// If a raw value is converted to a physical value and back, the result is the same raw value. This holds for
// raw values of up to 40 bits and offsets of up to 1e6 LSB: the values are below 2^41 LSB, and the four
// operations cause a relative error of a few parts in 2^53. This error is far below half an LSB.
RC_GTEST_PROP(Quantised, GivesBackEveryRawValue,
              (std::int64_t any, std::uint16_t scale_bits, std::int32_t offset_lsb)) {
  const std::int64_t raw = any % (std::int64_t{1} << 40U);
  const double magnitude = std::ldexp(1 + (scale_bits % 1024) / 1000.0, scale_bits % 40 - 20);
  const double scale = scale_bits % 2 == 0 ? magnitude : -magnitude;
  const double offset = offset_lsb % 1'000'000 * scale;
  const double value = physical(static_cast<double>(raw), scale, offset);
  RC_ASSERT(static_cast<std::int64_t>(quantised(value, scale, offset, -0x1p40, 0x1p40)) == raw);
}

// Within the range, the sent value differs from the intended one by at most half an LSB.
RC_GTEST_PROP(Quantised, IsWithinHalfAnLsb, (std::int32_t numerator, std::uint16_t divisor)) {
  const double scale = 0.003;
  const double value = numerator / (1.0 + divisor);
  RC_PRE(std::abs(value) < 1e6);
  const auto raw = static_cast<std::int64_t>(quantised(value, scale, 0, -1e10, 1e10));
  RC_ASSERT(std::abs(physical(static_cast<double>(raw), scale, 0) - value) <= 0.5 * scale * (1 + 1e-6));
}

}  // namespace
}  // namespace canhil::wire
