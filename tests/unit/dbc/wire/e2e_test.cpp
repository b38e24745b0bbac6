#include "dbc/wire/e2e.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

namespace canhil::e2e {
namespace {

constexpr std::uint16_t data_id = 0x0123;
using Bytes = std::array<std::uint8_t, 8>;

Bytes protected_frame(std::uint8_t counter, Bytes data = {}) {
  protect(data, data_id, counter);
  return data;
}

// AUTOSAR PRS_E2EProtocol, profile 11, variant A: data id 0x0123, payload of zeros.
TEST(E2e, KnownVectorsOfProfile11) {
  EXPECT_EQ(protected_frame(0), (Bytes{0xCC, 0x00}));
  EXPECT_EQ(protected_frame(1), (Bytes{0x91, 0x01}));
}

// The catalogue's check value of CRC-8/SAE-J1850 on "123456789" is 0x4B; this CRC has 0xFF as start value and
// as final xor. CRC-8/GSM-A has the same polynomial, but both values are 0; its check value is 0x37. The test
// passes "12" as data id, so the frame contains "3456789".
TEST(E2e, PolynomialIsThatOfTheCatalogue) {
  const std::array<std::uint8_t, 8> data{0, '3', '4', '5', '6', '7', '8', '9'};
  EXPECT_EQ(crc(data, ('2' << 8U) | '1'), 0x37);
}

TEST(E2e, ProtectLeavesTheHighNibbleToThePayload) {
  const Bytes frame = protected_frame(5, {0xFF, 0xAF, 1, 2, 3});
  EXPECT_EQ(frame[1], 0xA5);
  EXPECT_EQ(counter(frame), 5);
}

TEST(E2e, CounterRunsFrom0To14) {
  EXPECT_EQ(next(0), 1);
  EXPECT_EQ(next(13), 14);
  EXPECT_EQ(next(14), 0);
}

// A CRC-8 with this polynomial detects every single-bit error and every burst of up to 8 bits.
RC_GTEST_PROP(E2e, FindsEveryBurstOfUpTo8Bits, ()) {
  const auto payload = *rc::gen::container<std::vector<std::uint8_t>>(8, rc::gen::arbitrary<std::uint8_t>());
  Bytes frame{};
  std::ranges::copy(payload, frame.begin());
  protect(frame, data_id, 3);
  const auto pattern = *rc::gen::inRange(1U, 256U);
  const auto shift = *rc::gen::inRange(0U, 57U);
  const std::uint64_t error = std::uint64_t{pattern} << shift;
  for (std::size_t i = 0; i < 8; ++i) frame[7 - i] ^= static_cast<std::uint8_t>(error >> (8 * i));
  Receiver receiver;
  RC_ASSERT(receiver.check(frame, data_id) == Check::wrong_crc);
}

TEST(E2eReceiver, TakesFramesThatFollow) {
  Receiver receiver;
  std::uint8_t counter = 9;
  for (int i = 0; i < 40; ++i, counter = next(counter)) {
    EXPECT_EQ(receiver.check(protected_frame(counter), data_id), Check::ok);
    EXPECT_EQ(receiver.lost(), 0);
  }
}

TEST(E2eReceiver, WrapsFrom14To0) {
  Receiver receiver;
  receiver.check(protected_frame(14), data_id);
  EXPECT_EQ(receiver.check(protected_frame(0), data_id), Check::ok);
}

TEST(E2eReceiver, CountsWhatIsMissing) {
  Receiver receiver;
  receiver.check(protected_frame(13), data_id);
  EXPECT_EQ(receiver.check(protected_frame(2), data_id), Check::some_lost);  // 14, 0 and 1 are lost
  EXPECT_EQ(receiver.lost(), 3);
  EXPECT_EQ(receiver.check(protected_frame(1), data_id), Check::some_lost);
  EXPECT_EQ(receiver.lost(), 13);
}

TEST(E2eReceiver, SeesARepeatedFrame) {
  Receiver receiver;
  receiver.check(protected_frame(4), data_id);
  EXPECT_EQ(receiver.check(protected_frame(4), data_id), Check::repeated);
  EXPECT_EQ(receiver.lost(), 0);
}

TEST(E2eReceiver, DropsAnotherMessagesFrame) {
  Receiver receiver;
  EXPECT_EQ(receiver.check(protected_frame(4), data_id + 1), Check::wrong_crc);
}

TEST(E2eReceiver, AWrongFrameDoesNotMoveTheCounter) {
  Receiver receiver;
  receiver.check(protected_frame(4), data_id);
  Bytes broken = protected_frame(5);
  broken[3] ^= 0x10;
  EXPECT_EQ(receiver.check(broken, data_id), Check::wrong_crc);
  EXPECT_EQ(receiver.check(protected_frame(5), data_id), Check::ok);
}

TEST(E2eReceiver, Counter15AndShortFramesAreWrong) {
  Receiver receiver;
  EXPECT_EQ(receiver.check(protected_frame(15), data_id), Check::wrong_crc);
  const std::array<std::uint8_t, 1> one{};
  EXPECT_EQ(receiver.check(one, data_id), Check::wrong_crc);
  EXPECT_EQ(receiver.check({}, data_id), Check::wrong_crc);
}

TEST(E2eReceiver, TakesAnyCounterAfterReset) {
  Receiver receiver;
  receiver.check(protected_frame(4), data_id);
  receiver.reset();
  EXPECT_EQ(receiver.check(protected_frame(11), data_id), Check::ok);
  EXPECT_EQ(receiver.lost(), 0);
}

}  // namespace
}  // namespace canhil::e2e
