// The compiled codec, compared with a codec that handles one bit at a time, on random layouts.
#include "dbc/parser/plan.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "dbc/parser/codec.hpp"
#include "dbc/parser/parse.hpp"
#include "dbc/wire/bits.hpp"
#include "dbc/wire/quantise.hpp"

namespace canhil::dbc {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::uint64_t bits_of(double value) { return std::bit_cast<std::uint64_t>(value); }

/// The place in the message at which bit i of the raw value lies, as the DBC format defines it. Bit 0 of the
/// raw value is its least significant bit.
unsigned position(const Signal& signal, unsigned i) {
  const bool big_endian = signal.byte_order == ByteOrder::big_endian;
  return wire::bit_position(signal.start_bit, big_endian ? signal.length - 1 - i : i, big_endian);
}

std::uint64_t raw_by_bits(const Signal& signal, const Bytes& data) {
  std::uint64_t raw = 0;
  for (unsigned i = 0; i < signal.length; ++i) {
    const unsigned bit = position(signal, i);
    raw |= std::uint64_t{(data[bit / 8] >> (bit % 8)) & 1U} << i;
  }
  return raw;
}

void put_by_bits(const Signal& signal, std::uint64_t raw, Bytes& data) {
  for (unsigned i = 0; i < signal.length; ++i) {
    const unsigned bit = position(signal, i);
    const auto mask = static_cast<std::uint8_t>(1U << (bit % 8));
    data[bit / 8] =
        static_cast<std::uint8_t>(((raw >> i) & 1U) != 0 ? data[bit / 8] | mask : data[bit / 8] & ~mask);
  }
}

double physical_of(const Signal& signal, std::uint64_t raw) {
  const unsigned unused = 64 - signal.length;
  double number = static_cast<double>(raw);
  if (signal.is_signed()) number = static_cast<double>(static_cast<std::int64_t>(raw << unused) >> unused);
  if (signal.type == RawType::float32) number = static_cast<double>(wire::real<float>(raw));
  if (signal.type == RawType::float64) number = wire::real<double>(raw);
  if (signal.scale == 1 && signal.offset == 0) return number;
  return wire::physical(number, signal.scale, signal.offset);
}

bool present_by_bits(const Message& message, const Signal& signal, const Bytes& data) {
  if (signal.multiplexed_by.empty()) return true;
  const Signal& multiplexor = *find_signal(message, signal.multiplexed_by);
  const std::uint64_t raw = raw_by_bits(multiplexor, data);
  return std::ranges::any_of(signal.mux_ranges,
                             [raw](MuxRange r) { return raw >= r.first && raw <= r.last; }) &&
         present_by_bits(message, multiplexor, data);
}

/// A signal at a random place in a message, often with nearly the largest possible length.
Signal any_signal(unsigned size, std::size_t number) {
  Signal signal;
  signal.name = "s" + std::to_string(number);
  signal.type = *rc::gen::element(RawType::unsigned_integer, RawType::signed_integer, RawType::float32,
                                  RawType::float64);
  if (signal.type == RawType::float64 && size < 8) signal.type = RawType::unsigned_integer;
  if (signal.type == RawType::float32 && size < 4) signal.type = RawType::signed_integer;
  const unsigned most = std::min(64U, 8 * size);
  signal.length = signal.type == RawType::float32   ? 32
                  : signal.type == RawType::float64 ? 64
                  : *rc::gen::arbitrary<bool>()     ? *rc::gen::inRange(1U, most + 1)
                                                    : std::max(1U, most - *rc::gen::inRange(0U, 8U));
  signal.byte_order = *rc::gen::element(ByteOrder::little_endian, ByteOrder::big_endian);
  const unsigned first = *rc::gen::inRange(0U, 8 * size - signal.length + 1);
  const bool motorola = signal.byte_order == ByteOrder::big_endian;
  signal.start_bit = motorola ? first / 8 * 8 + 7 - first % 8 : first;
  signal.scale = *rc::gen::element(1.0, 0.1, -0.25, 3e-7, 1000.0);
  signal.offset = *rc::gen::element(0.0, 7.0, -273.15);
  return signal;
}

/// A message whose signals may overlap; some signals lie under multiplexors, possibly in several levels.
Message any_message() {
  Message message;
  message.name = "M";
  message.extended = *rc::gen::arbitrary<bool>();
  message.id = message.extended ? 0x1ABC'DEF0 : 0x123;
  message.size = *rc::gen::element(1U, 2U, 3U, 7U, 8U, 12U, 20U, 64U);
  message.fd = message.size > 8;
  const std::size_t count = *rc::gen::inRange<std::size_t>(1, 12);
  for (std::size_t i = 0; i < count; ++i) {
    Signal signal = any_signal(message.size, i);
    const std::size_t above = *rc::gen::inRange<std::size_t>(0, 2 * i + 1);
    if (above < i && !message.signals[above].is_float()) {
      message.signals[above].multiplexor = true;
      signal.multiplexed_by = message.signals[above].name;
      const auto first = *rc::gen::inRange<std::uint64_t>(0, 4);
      signal.mux_ranges = {{first, first + *rc::gen::inRange<std::uint64_t>(0, 3)}, {9, UINT64_MAX / 2}};
    }
    message.signals.push_back(std::move(signal));
  }
  std::ranges::reverse(message.signals);  // a multiplexor may come after the signals that it selects
  return message;
}

Bytes any_bytes(std::size_t size) {
  return *rc::gen::container<Bytes>(size, rc::gen::element<std::uint8_t>(0, 1, 2, 0x7F, 0x80, 0xA5, 0xFF));
}

RC_GTEST_PROP(PlanProperty, DecodesAsBitByBit, ()) {
  const Message message = any_message();
  const MessagePlan plan(message);
  RC_ASSERT(plan.size() == message.size);
  RC_ASSERT(plan.signals() == message.signals.size());
  const Bytes data = any_bytes(message.size);
  std::vector<double> values(plan.signals());
  RC_ASSERT(plan.decode(data, values));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Signal& signal = message.signals[i];
    const bool is_present = present_by_bits(message, signal, data);
    RC_ASSERT(plan.is_present(i, data) == is_present);
    if (is_present) {
      RC_ASSERT(bits_of(values[i]) == bits_of(physical_of(signal, raw_by_bits(signal, data))));
    } else {
      RC_ASSERT(std::isnan(values[i]));
    }
  }
}

RC_GTEST_PROP(PlanProperty, EncodesAsBitByBit, (double any)) {
  const Message message = any_message();
  const MessagePlan plan(message);
  std::vector<double> values(message.signals.size());
  const double infinity = std::numeric_limits<double>::infinity();
  for (double& value : values)
    value = *rc::gen::element(0.0, 1.0, 2.0, -1.0, 3e9, any, infinity, std::nan(""));
  Bytes data(message.size, 0xA5);
  RC_ASSERT(plan.encode(values, data));

  // Sorts the signals by the number of multiplexors above them, so that each multiplexor precedes its
  // signals.
  std::vector<std::pair<int, std::size_t>> order;
  for (std::size_t i = 0; i < values.size(); ++i) {
    int depth = 0;
    for (const Signal* s = &message.signals[i]; !s->multiplexed_by.empty(); ++depth)
      s = find_signal(message, s->multiplexed_by);
    order.emplace_back(depth, i);
  }
  std::ranges::sort(order);
  Bytes expected(message.size);
  for (const auto& [depth, i] : order) {
    const Signal& signal = message.signals[i];
    if (present_by_bits(message, signal, expected)) put_by_bits(signal, to_raw(signal, values[i]), expected);
  }
  RC_ASSERT(data == expected);
}

// Up to 48 bits, because doubles then represent the physical value within half an LSB.
RC_GTEST_PROP(PlanProperty, RawValuesComeBack, (std::uint64_t any)) {
  Signal signal = any_signal(8, 0);
  RC_PRE(!signal.is_float() && signal.length <= 48);
  Message message;
  message.size = 8;
  message.signals = {signal};
  Bytes data(8);
  put_by_bits(signal, any & wire::mask(signal.length), data);
  const Bytes before = data;
  const MessagePlan plan(message);
  std::array<double, 1> value{};
  RC_ASSERT(plan.decode(data, value));
  RC_ASSERT(plan.encode(value, data));
  RC_ASSERT(data == before);
}

Message multiplexed() {
  const auto database = read_file(TEST_DATA_DIR "/dbc/multiplexed.dbc");
  EXPECT_TRUE(database) << database.error().message;
  return database->messages.at(1);
}

// A float signal without scale and offset is copied without arithmetic.
TEST(Plan, ASignallingNanKeepsItsBits) {
  Message message;
  message.size = 8;
  message.signals.resize(1);
  message.signals[0].length = 64;
  message.signals[0].type = RawType::float64;
  std::array<double, 1> value{};
  ASSERT_TRUE(MessagePlan(message).decode(Bytes{1, 0, 0, 0, 0, 0, 0xF0, 0x7F}, value));
  EXPECT_EQ(bits_of(value[0]), 0x7FF0'0000'0000'0001U);
}

TEST(Plan, LeavesEverythingAloneWhereThereIsTooLittleRoom) {
  const MessagePlan plan(multiplexed());
  Bytes data(plan.size() - 1, 0xA5);
  std::vector<double> values(plan.signals(), -1);
  EXPECT_FALSE(plan.decode(data, values));
  EXPECT_FALSE(plan.encode(values, data));
  EXPECT_EQ(values, std::vector<double>(plan.signals(), -1));
  EXPECT_EQ(data, Bytes(plan.size() - 1, 0xA5));
  data.resize(plan.size());
  values.pop_back();
  EXPECT_FALSE(plan.decode(data, values));
  EXPECT_FALSE(plan.encode(values, data));
}

TEST(Plan, LongerDataStaysBeyondTheMessage) {
  const MessagePlan plan(multiplexed());
  Bytes data(plan.size() + 3, 0xA5);
  std::vector<double> values(plan.signals());
  EXPECT_TRUE(plan.decode(data, values));
  EXPECT_TRUE(plan.encode(values, data));
  EXPECT_EQ(Bytes(data.end() - 3, data.end()), Bytes(3, 0xA5));
}

}  // namespace
}  // namespace canhil::dbc
