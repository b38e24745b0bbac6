#include "dbc/wire/time_base.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

namespace canhil {
namespace {

constexpr std::int64_t period_us = std::int64_t{1} << 32U;

TEST(TimeBase, UnwrapsAcrossTheWrapInBothDirections) {
  EXPECT_EQ(unwrap_us(5, period_us - 3), period_us + 5);
  EXPECT_EQ(unwrap_us(0xFFFFFFFE, period_us + 3), period_us - 2);
  EXPECT_EQ(unwrap_us(100, 100), 100);
}

TEST(TimeBase, TimesBeforeTheFirstSyncAreNegative) { EXPECT_EQ(unwrap_us(0xFFFFFFFF, 0), -1); }

RC_GTEST_PROP(TimeBase, GivesBackEveryTimeWithin35Minutes, (std::uint64_t any, std::int32_t difference_us)) {
  const auto reference_us = static_cast<std::int64_t>(any % (1ULL << 40U));
  const std::int64_t t_us = reference_us + difference_us;
  RC_ASSERT(unwrap_us(wrap_us(t_us), reference_us) == t_us);
}

TEST(TimeBase, UnwrapsTheShortTimeToTheLatestThatItCanBe) {
  EXPECT_EQ(unwrap_short_us(100, 100), 100);
  EXPECT_EQ(unwrap_short_us(110, 100), 110 - short_period_us);
  EXPECT_EQ(unwrap_short_us(90, 3 * short_period_us + 100), 3 * short_period_us + 90);
  EXPECT_EQ(unwrap_short_us(wrap_short_us(-20), 0), -20);
}

RC_GTEST_PROP(TimeBase, GivesBackEveryTimeOfTheLastShortPeriod, (std::uint64_t any)) {
  const auto latest_us = static_cast<std::int64_t>(any % (1ULL << 40U));
  const std::int64_t t_us = latest_us - static_cast<std::int64_t>(any >> 40U) % short_period_us;
  RC_ASSERT(unwrap_short_us(wrap_short_us(t_us), latest_us) == t_us);
}

}  // namespace
}  // namespace canhil
