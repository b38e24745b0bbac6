// Uses the generated headers, with values computed by hand from the DBC.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "dbc/parser/parse.hpp"
#include "dbc/wire/message.hpp"
#include "messages/canhil.hpp"
#include "test_messages/fd.hpp"
#include "test_messages/floats.hpp"
#include "test_messages/motorola.hpp"
#include "test_messages/multiplexed.hpp"

namespace canhil {
namespace {

using messages::SlaveImuDeltaTheta;
using messages::Validity;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

template <class Message>
constexpr std::array<std::uint8_t, Message::size> packed(const Message& message) {
  std::array<std::uint8_t, Message::size> bytes{};
  message.pack(bytes);
  return bytes;
}

template <class Message>
constexpr Message repacked(const Message& message) {
  return Message::unpack(packed(message));
}

// By hand: x is 0.1 / 2e-6 = 50000 at bit 12. y is limited to -0.131, and -0.131 / 2e-6 = -65500 is at bit
// 29. The validity is at bit 63.
TEST(Generated, PacksSlaveImuDeltaThetaAsTheDbcLaysItOut) {
  constexpr SlaveImuDeltaTheta message{
      .delta_theta_x_rad = 0.1, .delta_theta_y_rad = -1, .gyro_validity = Validity::valid};
  constexpr std::uint64_t word =
      (50000ULL << 12U) | ((static_cast<std::uint64_t>(-65500) & 0x1FFFFU) << 29U) | (1ULL << 63U);
  constexpr auto bytes = packed(message);
  static_assert(wire::load_le<0, 8>(bytes.data()) == word);
  EXPECT_EQ((wire::load_le<0, 8>(packed(message).data())), word);  // the same at run time
}

TEST(Generated, ProtectionFieldsAreLeftZeroForE2e) {
  auto bytes = packed(messages::Sync{.time_us = 0xFFFFFFFFFF, .step = 2047, .lockstep = 1});
  EXPECT_EQ(bytes[0], 0);
  EXPECT_EQ(bytes[1] & 0x0F, 0);
}

TEST(Generated, RoundsHalvesToEven) {
  const auto raw = [](double value) {
    const auto bytes = packed(messages::SlaveImuStatus{.interval_us = value});
    return (wire::load_le<0, 8>(bytes.data()) >> 44U) & 0xFFFU;
  };
  EXPECT_EQ(raw(5), 0U);
  EXPECT_EQ(raw(15), 2U);
  EXPECT_EQ(raw(25), 2U);
  EXPECT_EQ(raw(std::nextafter(25, 30)), 3U);
}

TEST(Generated, SaturatesAndTakesNanForTheMinimum) {
  const auto velocity = [](double value) {
    return repacked(messages::AlignVelocityNE{.velocity_north_mps = value}).velocity_north_mps;
  };
  EXPECT_DOUBLE_EQ(velocity(1e9), 1677);
  EXPECT_DOUBLE_EQ(velocity(infinity), 1677);
  EXPECT_DOUBLE_EQ(velocity(-infinity), -1677);
  EXPECT_DOUBLE_EQ(velocity(nan), -1677);
}

TEST(Generated, NanOnANegativeScaleIsThePhysicalMinimumToo) {
  using test_messages::motorola::Classic;
  const double lowest = repacked(Classic{.wide = -infinity}).wide;
  EXPECT_DOUBLE_EQ(lowest, 4294967295 * -0.001 + 7);
  EXPECT_EQ(repacked(Classic{.wide = nan}).wide, lowest);
  EXPECT_EQ(repacked(Classic{.wide = infinity}).wide, 7);
}

TEST(Generated, IntegersSaturateAtTheRangeNotAtTheType) {
  using test_messages::motorola::Mixed;
  EXPECT_EQ(repacked(Mixed{.intel = 255}).intel, 200);
  EXPECT_EQ(repacked(Mixed{.intel = -255}).intel, -200);
  EXPECT_EQ(repacked(messages::TargetCounters{.frames_lost = 65535}).frames_lost, 8191);
}

TEST(Generated, FloatsKeepTheirBitsInsideTheRange) {
  using test_messages::floats::Single;
  EXPECT_EQ(repacked(Single{.little = 1.25e-30F}).little, 1.25e-30F);
  EXPECT_EQ(repacked(Single{.little = std::numeric_limits<float>::infinity()}).little,
            std::numeric_limits<float>::max());
  EXPECT_EQ(repacked(Single{.big = std::numeric_limits<float>::quiet_NaN()}).big, -1);
  EXPECT_EQ(packed(Single{.big = 0.5F})[4], 0x3F);
}

// By hand: the raw value is (25.3 + 40) / 0.1 = 653 = 0x28D. A Motorola signal of 12 bits from bit 7 on lies
// in byte 0 and in the high nibble of byte 1.
TEST(Generated, MotorolaMostSignificantByteFirst) {
  using test_messages::motorola::Classic;
  const auto bytes = packed(Classic{.temperature = 25.3, .pressure = 100, .wide = 7});
  EXPECT_EQ(bytes[0], 0x28);
  EXPECT_EQ(bytes[1] & 0xF0, 0xD0);
}

TEST(Generated, UnknownEnumeratorsAreKept) {
  messages::TargetHeartbeat heartbeat{.state = static_cast<messages::TargetState>(6)};
  EXPECT_EQ(static_cast<int>(repacked(heartbeat).state), 6);
  EXPECT_EQ(messages::name_of(heartbeat.state), "");
}

TEST(Generated, EnumeratorsHaveTheNamesOfTheDbc) {
  EXPECT_EQ(messages::name_of(messages::Parameter::h2_alpha_rule), "h2_alpha_rule");
  EXPECT_EQ(messages::from_name<messages::Parameter>("closed_loop"), messages::Parameter::closed_loop);
  EXPECT_EQ(messages::from_name<messages::Parameter>("open_loop"), std::nullopt);
  EXPECT_EQ(messages::enumerators<messages::FixSource>.size(), 3U);
  EXPECT_EQ(static_cast<int>(test_messages::motorola::Gear::reverse), -1);
  static_assert(std::is_same_v<std::underlying_type_t<test_messages::motorola::Gear>, std::int8_t>);
}

TEST(Generated, NamesThatAreNoIdentifiersAreMadeOnes) {
  using Mode = test_messages::multiplexed::Simple_mode;
  EXPECT_EQ(static_cast<int>(Mode::class_), 2);
  EXPECT_EQ(static_cast<int>(Mode::a_b), 3);
  EXPECT_EQ(static_cast<int>(Mode::a_b_4), 4);
  EXPECT_EQ(name_of(Mode::a_b_4), "a-b");
  const test_messages::motorola::Mixed keywords{.Mixed_ = 1, .size_ = -3, .int_ = 4};
  EXPECT_EQ(repacked(keywords), keywords);
}

TEST(Generated, MembersAreTheSmallestTypesThatHoldTheSignal) {
  static_assert(std::is_same_v<decltype(messages::Sync::time_us), std::uint64_t>);
  static_assert(std::is_same_v<decltype(messages::Sync::step), std::uint16_t>);
  static_assert(std::is_same_v<decltype(messages::Sync::lockstep), std::uint8_t>);
  static_assert(std::is_same_v<decltype(messages::SlaveImuStatus::temperature_degc), std::int8_t>);
  static_assert(std::is_same_v<decltype(messages::SlaveImuStatus::interval_us), double>);
  static_assert(std::is_same_v<decltype(messages::ParamSet::value), float>);
  static_assert(std::is_same_v<decltype(messages::SlaveImuDeltaTheta::gyro_validity), Validity>);
  static_assert(std::is_same_v<decltype(messages::SlaveImuDeltaV::accel_validity), Validity>);
}

TEST(Generated, OnlyTheMultiplexedSignalsOfThePageTravel) {
  using test_messages::multiplexed::Simple;
  const Simple sent{.page = 0, .always = -2, .voltage = 5, .current = -1, .name = 0xFFFFFFFFFFFFFF};
  const Simple received = repacked(sent);
  EXPECT_DOUBLE_EQ(received.voltage, 5);
  EXPECT_DOUBLE_EQ(received.current, -1);
  EXPECT_EQ(received.name, 0U);
  EXPECT_EQ(received.always, -2);
}

TEST(Generated, NestedMultiplexingAsksEveryMultiplexor) {
  using test_messages::multiplexed::Extended;
  EXPECT_EQ(repacked(Extended{.top = 1, .inner = 5, .leaf_a = 2.5}).leaf_a, 2.5);
  EXPECT_EQ(repacked(Extended{.top = 1, .inner = 4, .leaf_a = 2.5}).leaf_a, 0);
  EXPECT_EQ(repacked(Extended{.top = 2, .inner = 5, .leaf_a = 2.5}).leaf_a, 0);
  EXPECT_EQ(repacked(Extended{.top = 9, .rest = 77}).rest, 77);
  EXPECT_EQ(repacked(Extended{.top = 5, .rest = 77}).rest, 0);
}

TEST(Generated, SixtyFourBytesWithSignalsOverNineBytes) {
  using test_messages::fd::Long;
  static_assert(Long::info.fd && Long::size == 64);
  const Long sent{.first = -12.3,
                  .nine_bytes = -0x123456789ABCDE,
                  .nine_bytes_big = 0x123456789ABCDEF,
                  .whole = std::numeric_limits<std::int64_t>::min(),
                  .whole_big = std::numeric_limits<std::uint64_t>::max(),
                  .unsigned_wide = 1e19,
                  .double_crooked = -1.5e300,
                  .float_big = 2.5F,
                  .last = -64};
  const Long received = repacked(sent);
  EXPECT_DOUBLE_EQ(received.first, sent.first);
  EXPECT_EQ(received.unsigned_wide, 9223372036854774784.0);  // saturated: (2^64 - 2048) / 2
  EXPECT_EQ(received.nine_bytes, sent.nine_bytes);
  EXPECT_EQ(received.nine_bytes_big, sent.nine_bytes_big);
  EXPECT_EQ(received.whole, sent.whole);
  EXPECT_EQ(received.whole_big, sent.whole_big);
  EXPECT_EQ(received.double_crooked, sent.double_crooked);
  EXPECT_EQ(received.float_big, sent.float_big);
  EXPECT_EQ(received.last, sent.last);
}

TEST(Generated, DirectoryFindsMessagesById) {
  ASSERT_NE(messages::find_message(0x80), nullptr);
  EXPECT_EQ(messages::find_message(0x80)->name, "SlaveImuDeltaTheta");
  EXPECT_EQ(messages::find_message(0x80)->cycle_time_us, 10'000);
  EXPECT_EQ(messages::find_message(0x80)->sample_group, "SlaveImu");
  EXPECT_TRUE(messages::find_message(0x80)->answers.empty());
  EXPECT_TRUE(std::ranges::equal(messages::FixUpdate::info.answers, std::array{"Ssbl", "Gps"}));
  EXPECT_EQ(messages::find_message(0x80, true), nullptr);
  EXPECT_EQ(messages::find_message(0x7FF), nullptr);
  ASSERT_NE(test_messages::fd::find_message(0x18FEF100, true), nullptr);
  EXPECT_TRUE(std::ranges::is_sorted(messages::all_messages, {}, &MessageInfo::id));
}

TEST(Generated, FoldedHashIsTheXorOfThe24BitPieces) {
  static_assert(dbc::fold24(0x1234'56789A'BCDEF0U) == (0x1234U ^ 0x56789AU ^ 0xBCDEF0U));
}

TEST(ToFrame, ProtectsWhatHasADataIdAndLeavesOthersAlone) {
  const Frame frame = to_frame(messages::Sync{.time_us = 5}, 7);
  EXPECT_EQ(frame.id, 160U);
  EXPECT_EQ(e2e::counter(frame.payload()), 7);
  EXPECT_EQ(frame.data[0], e2e::crc(frame.payload(), messages::Sync::info.e2e_data_id));
  EXPECT_EQ(from_frame<messages::Sync>(frame).time_us, 5U);
  const Frame plain = to_frame(test_messages::motorola::Byte{.only = 10}, 7);
  EXPECT_EQ(plain.data[0], 5);
  const Frame fd = to_frame(test_messages::fd::Twelve{}, 0);
  EXPECT_TRUE(fd.fd && fd.brs && fd.extended);
}

}  // namespace
}  // namespace canhil
