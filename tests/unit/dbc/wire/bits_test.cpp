#include "dbc/wire/bits.hpp"

#include <gtest/gtest.h>

#include <array>

namespace canhil::wire {
namespace {

constexpr std::array<std::uint8_t, 8> bytes{0x01, 0x23, 0x45, 0x67, 0x89, 0xAB, 0xCD, 0xEF};

TEST(Bits, IntelCountsUpMotorolaDownByteByByte) {
  EXPECT_EQ(bit_position(12, 5, false), 17U);
  EXPECT_EQ(bit_position(7, 0, true), 7U);
  EXPECT_EQ(bit_position(7, 7, true), 0U);
  EXPECT_EQ(bit_position(7, 8, true), 15U);
  EXPECT_EQ(bit_position(10, 3, true), 23U);
}

TEST(Bits, LoadsAreTheSameInConstantExpressions) {
  static_assert(load_le<0, 8>(bytes.data()) == 0xEFCDAB8967452301U);
  static_assert(load_be<0, 8>(bytes.data()) == 0x0123456789ABCDEFU);
  const auto* data = bytes.data();
  EXPECT_EQ((load_le<0, 8>(data)), 0xEFCDAB8967452301U);
  EXPECT_EQ((load_be<0, 8>(data)), 0x0123456789ABCDEFU);
  EXPECT_EQ((load_le<2, 3>(data)), 0x896745U);
  EXPECT_EQ((load_be<2, 3>(data)), 0x456789U);
  EXPECT_EQ((load_be<8, 0>(data)), 0U);
}

TEST(Bits, StoresAndMergesTouchTheirBytesOnly) {
  std::array<std::uint8_t, 5> data{1, 1, 1, 1, 1};
  store_le<1, 3>(data.data(), 0xCCBBAA);
  EXPECT_EQ(data, (std::array<std::uint8_t, 5>{1, 0xAA, 0xBB, 0xCC, 1}));
  store_be<1, 3>(data.data(), 0xCCBBAA);
  EXPECT_EQ(data, (std::array<std::uint8_t, 5>{1, 0xCC, 0xBB, 0xAA, 1}));
  merge_be<0, 2>(data.data(), 0x8001);
  EXPECT_EQ(data, (std::array<std::uint8_t, 5>{0x81, 0xCD, 0xBB, 0xAA, 1}));
}

TEST(Bits, FieldsOfAWord) {
  constexpr std::uint64_t word = 0x8000'0000'0000'F0A5U;
  EXPECT_EQ((unsigned_bits<4, 8>(word)), 0x0AU);
  EXPECT_EQ((signed_bits<12, 4>(word)), -1);
  EXPECT_EQ((signed_bits<0, 8>(word)), -91);
  EXPECT_EQ((unsigned_bits<63, 1>(word)), 1U);
  EXPECT_EQ((signed_bits<0, 64>(word)), static_cast<std::int64_t>(word));
  EXPECT_EQ((placed<60, 4>(0xFFF5U)), 0x5000'0000'0000'0000U);
}

}  // namespace
}  // namespace canhil::wire
