// Fast packets of NMEA 2000.
#include "dbc/transport/fast_packet.hpp"

#include <gmock/gmock.h>

#include <array>
#include <numeric>

#include "dbc/wire/j1939.hpp"

namespace canhil::transport {
namespace {

using testing::ElementsAre;

std::vector<std::uint8_t> message(std::size_t size, std::uint8_t first = 1) {
  std::vector<std::uint8_t> bytes(size);
  std::iota(bytes.begin(), bytes.end(), first);
  return bytes;
}
std::optional<std::vector<std::uint8_t>> take(FastPacketReceiver& receiver, const FastPacketFrame& frame) {
  const auto whole = receiver.take(frame);
  if (!whole) return std::nullopt;
  return std::vector<std::uint8_t>(whole->begin(), whole->end());
}

// PGN 129029 (GNSS position data) has 43 bytes: 6 in the first frame, 7 in each of five, 2 in the last.
TEST(FastPacket, HasSixBytesInTheFirstFrameAndSevenInTheOthers) {
  const auto frames = split_fast_packet(message(43), 5);
  ASSERT_EQ(frames.size(), 7U);
  EXPECT_THAT(frames[0], ElementsAre(0xA0, 43, 1, 2, 3, 4, 5, 6));
  EXPECT_THAT(frames[1], ElementsAre(0xA1, 7, 8, 9, 10, 11, 12, 13));
  EXPECT_THAT(frames[6], ElementsAre(0xA6, 42, 43, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF));
}

TEST(FastPacket, OfAnySizeIsPutTogether) {
  FastPacketReceiver receiver;
  for (std::size_t size = fewest_fast_packet_bytes; size <= most_fast_packet_bytes; ++size) {
    const auto frames = split_fast_packet(message(size), static_cast<unsigned>(size));
    ASSERT_EQ(frames.size(), fast_packet_frames(size));
    for (std::size_t i = 0; i + 1 < frames.size(); ++i) ASSERT_EQ(take(receiver, frames[i]), std::nullopt);
    ASSERT_EQ(take(receiver, frames.back()), message(size)) << size;
  }
  EXPECT_EQ(receiver.lost(), 0U);
  EXPECT_EQ(fast_packet_frames(223), 32U);
}

TEST(FastPacket, WithAMissingFrameIsLostOnce) {
  const auto first = split_fast_packet(message(43), 0), second = split_fast_packet(message(43, 50), 1);
  for (std::size_t missing = 0; missing < first.size(); ++missing) {
    FastPacketReceiver receiver;
    for (std::size_t i = 0; i < first.size(); ++i) {
      if (i == missing) continue;
      EXPECT_EQ(take(receiver, first[i]), std::nullopt);
    }
    std::optional<std::vector<std::uint8_t>> got;
    for (const auto& frame : second) got = take(receiver, frame);
    EXPECT_EQ(got, message(43, 50));
    EXPECT_EQ(receiver.lost(), 1U) << missing;
  }
}

// The frames of two messages must not be mixed.
TEST(FastPacket, OfAnotherSequenceIsNotPutTogether) {
  const auto first = split_fast_packet(message(43), 0), second = split_fast_packet(message(43, 50), 1);
  FastPacketReceiver receiver;
  for (std::size_t i = 0; i < 3; ++i) take(receiver, first[i]);
  for (std::size_t i = 3; i < 7; ++i) EXPECT_EQ(take(receiver, second[i]), std::nullopt);
  EXPECT_EQ(receiver.lost(), 2U);
}

TEST(FastPacket, OfAWrongLengthIsLost) {
  for (const std::uint8_t size : std::array<std::uint8_t, 4>{0, 8, 224, 255}) {
    FastPacketReceiver receiver;
    EXPECT_EQ(take(receiver, {0x00, size, 1, 2, 3, 4, 5, 6}), std::nullopt);
    EXPECT_EQ(take(receiver, {0x01, 7, 8, 9, 10, 11, 12, 13}), std::nullopt);
    EXPECT_EQ(receiver.lost(), 1U);
  }
}

TEST(FastPacket, IsAMessageOfDataPageOne) {
  EXPECT_TRUE(wire::is_fast_packet(0x19F80500, true, 43));    // PGN 129029
  EXPECT_FALSE(wire::is_fast_packet(0x19F80500, false, 43));  // 11 bits
  EXPECT_FALSE(wire::is_fast_packet(0x09F11200, true, 8));    // PGN 127250, vessel heading: one frame
  EXPECT_FALSE(wire::is_fast_packet(0x18FECA00, true, 20));   // PGN 65226, J1939 DM1: transport protocol
  EXPECT_FALSE(wire::is_fast_packet(0x19F80500, true, 224));
}

}  // namespace
}  // namespace canhil::transport
