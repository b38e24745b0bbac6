#include "dbc/parser/codec.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <array>
#include <cmath>
#include <limits>

#include "dbc/parser/parse.hpp"
#include "dbc/wire/bits.hpp"

namespace canhil::dbc {
namespace {

Database database_of(const std::string& name) {
  auto database = read_file(TEST_DATA_DIR "/dbc/" + name);
  EXPECT_TRUE(database) << database.error().message;
  return database.value_or(Database{});
}

double decoded(const Message& message, std::span<const std::uint8_t> data, std::string_view name) {
  const auto signals = decode(message, data);
  EXPECT_TRUE(signals);
  for (const auto& [signal, value] : *signals) {
    if (signal->name == name) return value;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

// By hand: the 12 bits from bit 7 of byte 0 on contain 0x28D = 653, and 653 * 0.1 - 40 = 25.3.
TEST(RunTimeCodec, DecodesMotorola) {
  const Database database = database_of("motorola.dbc");
  const std::array<std::uint8_t, 8> data{0x28, 0xD0};
  EXPECT_DOUBLE_EQ(decoded(database.messages[0], data, "temperature"), 25.3);
}

TEST(RunTimeCodec, NamesValues) {
  const Database database = database_of("motorola.dbc");
  const Signal& gear = *find_signal(database.messages[0], "Gear");
  EXPECT_EQ(value_name(gear, 7), "reverse");  // -1 in three bits
  EXPECT_EQ(value_name(gear, 2), "second");
  EXPECT_EQ(value_name(gear, 3), "");
}

TEST(RunTimeCodec, DecodesThePageThatTheMultiplexorsName) {
  const Database database = database_of("multiplexed.dbc");
  const Message& simple = database.messages[0];
  const std::array<std::uint8_t, 8> page_9{0x09, 0x05};
  const auto signals = decode(simple, page_9);
  ASSERT_TRUE(signals);
  ASSERT_EQ(signals->size(), 3U);
  EXPECT_EQ((*signals)[2].signal->name, "mode");
  EXPECT_EQ((*signals)[2].value, 5);
}

TEST(RunTimeCodec, NestedSignalsNeedEveryMultiplexorAbove) {
  const Database database = database_of("multiplexed.dbc");
  const Message& extended = database.messages[1];
  const Signal& leaf = *find_signal(extended, "leaf_a");  // present if inner is 0..3 or 5 and top is 1
  EXPECT_TRUE(is_present(extended, leaf, std::array<std::uint8_t, 8>{0x10, 5}));
  EXPECT_FALSE(is_present(extended, leaf, std::array<std::uint8_t, 8>{0x10, 4}));
  EXPECT_FALSE(is_present(extended, leaf, std::array<std::uint8_t, 8>{0x20, 5}));
}

TEST(RunTimeCodec, EncodesMultiplexorsBeforeWhatTheyDecide) {
  const Database database = database_of("multiplexed.dbc");
  const Message& extended = database.messages[1];
  const auto data = encode(extended, std::array{NamedValue{"leaf_a", 2.5}, NamedValue{"inner", 5},
                                                NamedValue{"top", 1}, NamedValue{"other", 65535}});
  ASSERT_TRUE(data);
  EXPECT_EQ(*data, (std::vector<std::uint8_t>{0x10, 0x05, 0x00, 0x50, 0, 0, 0, 0}));
}

TEST(RunTimeCodec, WrongInputIsOneLine) {
  const Database database = database_of("motorola.dbc");
  const std::array<std::uint8_t, 3> few{};
  EXPECT_EQ(decode(database.messages[0], few).error().message,
            "frame of message Classic has 3 bytes, expected 8");
  EXPECT_EQ(encode(database.messages[0], std::array{NamedValue{"x", 1}}).error().message,
            "message Classic has no signal 'x', expected one of its DBC");
}

TEST(RunTimeCodec, SaturatesAndTakesNanForTheMinimum) {
  const Database database = database_of("motorola.dbc");
  const Signal& temperature =
      *find_signal(database.messages[0], "temperature");  // [-100|150], raw -600..1900
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(to_raw(temperature, infinity), 1900U);
  EXPECT_EQ(to_raw(temperature, -infinity), static_cast<std::uint64_t>(-600) & 0xFFFU);
  EXPECT_EQ(to_raw(temperature, std::nan("")), static_cast<std::uint64_t>(-600) & 0xFFFU);
}

Signal any_signal() {
  Signal signal;
  signal.length = *rc::gen::inRange(1U, 53U);
  signal.byte_order = *rc::gen::element(ByteOrder::little_endian, ByteOrder::big_endian);
  signal.type = *rc::gen::element(RawType::unsigned_integer, RawType::signed_integer);
  const unsigned first = *rc::gen::inRange(0U, 512 - signal.length + 1);
  const bool motorola = signal.byte_order == ByteOrder::big_endian;
  signal.start_bit = motorola ? first / 8 * 8 + 7 - first % 8 : first;
  signal.scale = *rc::gen::element(1.0, 0.1, -0.25, 3e-7, 1000.0);
  signal.offset = *rc::gen::element(0.0, 7.0, -273.15);
  return signal;
}

RC_GTEST_PROP(RunTimeCodecProperty, RawBitsComeBackAndOthersStay, (std::uint64_t raw, std::uint8_t fill)) {
  const Signal signal = any_signal();
  std::array<std::uint8_t, 64> before{};
  before.fill(fill);
  auto data = before;
  put_raw_bits(signal, raw, data);
  RC_ASSERT(raw_bits(signal, data) == (raw & wire::mask(signal.length)));
  put_raw_bits(signal, raw_bits(signal, before), data);
  RC_ASSERT(data == before);
}

// Up to 48 bits: with an offset of 273.15 and a scale of 3e-7, half an LSB is still above the rounding of
// doubles.
RC_GTEST_PROP(RunTimeCodecProperty, PhysicalValuesGiveBackTheRawValue, (std::uint64_t any)) {
  Signal signal = any_signal();
  signal.length = std::min(signal.length, 48U);
  const std::uint64_t raw = any & wire::mask(signal.length);
  RC_ASSERT(to_raw(signal, to_physical(signal, raw)) == raw);
}

}  // namespace
}  // namespace canhil::dbc
