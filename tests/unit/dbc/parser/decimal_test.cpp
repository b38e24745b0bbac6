// The decimal values of signals. The expected values are exact decimal numbers, computed by hand or with
// integers, never with the doubles that the code under test must avoid.
#include "dbc/parser/decimal.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <random>

namespace canhil::dbc {
namespace {

Signal signal(double scale, double offset, unsigned length = 64, RawType type = RawType::unsigned_integer) {
  Signal one;
  one.length = length;
  one.type = type;
  one.scale = scale;
  one.offset = offset;
  return one;
}

std::string text(const Signal& of, std::uint64_t raw) { return DecimalConversion(of).text(raw); }

TEST(Decimal, IsTheShortestNumber) {
  const auto expect = [](double value, std::int64_t digits, int exponent) {
    const Decimal decimal = shortest_decimal(value);
    EXPECT_EQ(fmt::format("{}e{}", decimal.digits, decimal.exponent), fmt::format("{}e{}", digits, exponent));
  };
  expect(0, 0, 0);
  expect(0.1, 1, -1);
  expect(-12.50, -125, -1);
  expect(1500, 15, 2);
  expect(1e22, 1, 22);
  expect(-3.5e-10, -35, -11);
  expect(1.1920928955078125e-07, 11920928955078125, -23);
}

TEST(DecimalConversion, HasNoNoiseOfBinaryNumbers) {
  EXPECT_EQ(text(signal(0.1, 0), 3), "0.3");
  EXPECT_EQ(text(signal(0.01, -40), 4321), "3.21");
  EXPECT_EQ(text(signal(0.001, 0), 1709632800123456), "1709632800123.456");
  EXPECT_EQ(text(signal(-0.1, 0), 0), "0");
  EXPECT_EQ(text(signal(1e-7, -180), 1234567891), "-56.5432109");
  EXPECT_EQ(text(signal(0.1, 0, 8, RawType::signed_integer), 0xFD), "-0.3");
  EXPECT_EQ(text(signal(0, 7.5), 9), "7.5");
  EXPECT_EQ(text(signal(0.03125, 0), 4096), "128");
}

TEST(DecimalConversion, WritesAllDigitsOfAnInteger) {
  EXPECT_EQ(text(signal(1, 0), 1709632800123456), "1709632800123456");
  EXPECT_EQ(text(signal(1, 0), UINT64_MAX), "18446744073709551615");
  EXPECT_EQ(text(signal(1, 0, 64, RawType::signed_integer), std::uint64_t{1} << 63U), "-9223372036854775808");
  EXPECT_EQ(text(signal(10, 5), UINT64_MAX), "184467440737095516155");
  EXPECT_EQ(text(signal(0.5, 0), (std::uint64_t{1} << 62U) + 2), "2305843009213693953");
}

TEST(DecimalConversion, WritesFloatsToTheLastBit) {
  EXPECT_EQ(text(signal(1, 0, 64, RawType::float64), std::bit_cast<std::uint64_t>(48.123456789012344)),
            "48.123456789012344");
  // The double that equals the float, because a reader converts the text to a double.
  EXPECT_EQ(text(signal(1, 0, 32, RawType::float32), std::bit_cast<std::uint32_t>(0.1F)),
            "0.10000000149011612");
  EXPECT_EQ(text(signal(0.1, 0, 64, RawType::float64), std::bit_cast<std::uint64_t>(3.0)), "0.3");
  EXPECT_EQ(text(signal(1, 0, 32, RawType::float32), 0xFFC0'0000), "nan");
  EXPECT_EQ(text(signal(2, 1, 32, RawType::float32), 0xFF80'0000), "-inf");
}

TEST(DecimalConversion, ComputesWithExtremeScales) {
  EXPECT_EQ(text(signal(1e-300, 0), 15), "1.5e-299");
  EXPECT_EQ(text(signal(1e30, 0), 2), "2e+30");
  EXPECT_EQ(text(signal(1e-300, 1), 15), "1");
  EXPECT_EQ(text(signal(12345678901234568, 0.12345678901234567), UINT64_MAX), "2.277375791072698e+35");
}

// Any text must read back as the double nearest to the exact decimal number. Here the exact number is made of
// integers, and strtod() finds the nearest double.
TEST(DecimalConversion, IsTheNearestDoubleOfTheExactNumber) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100'000; ++i) {
    const auto scale = static_cast<std::int64_t>(1 + random() % 999'999),
               offset = static_cast<std::int64_t>(random() % 2'000'001) - 1'000'000;
    const int exponent = -static_cast<int>(random() % 12);
    const std::uint64_t raw = random() >> (random() % 64);
    const Signal one = signal(std::strtod(fmt::format("{}e{}", scale, exponent).c_str(), nullptr),
                              std::strtod(fmt::format("{}e{}", offset, exponent).c_str(), nullptr));
    const RawNumber exact = RawNumber{raw} * scale + offset;
    const std::string written = text(one, raw);
    const double expected = std::strtod(fmt::format("{}e{}", exact, exponent).c_str(), nullptr);
    ASSERT_EQ(std::strtod(written.c_str(), nullptr), expected) << written;
    if (written.find('.') != std::string::npos) {
      ASSERT_EQ(written, fmt::format("{}", expected));
    }
  }
}

}  // namespace
}  // namespace canhil::dbc
