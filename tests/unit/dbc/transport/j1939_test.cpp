// The transport protocol of SAE J1939-21.
#include "dbc/transport/j1939.hpp"

#include <gmock/gmock.h>

#include <numeric>
#include <string>

namespace canhil::transport {
namespace {

using testing::ElementsAre;

// PGN 65259 (component identification) of the node 5, with priority 6.
constexpr std::uint32_t component_id = 0x18FEEB05;

std::vector<std::uint8_t> j1939_message(std::size_t size, std::uint8_t first = 1) {
  std::vector<std::uint8_t> bytes(size);
  std::iota(bytes.begin(), bytes.end(), first);
  return bytes;
}

Frame j1939_frame(std::uint32_t id, const std::vector<std::uint8_t>& bytes) {
  Frame frame{.id = id, .size = static_cast<std::uint8_t>(bytes.size()), .extended = true};
  std::ranges::copy(bytes, frame.data.begin());
  return frame;
}
Frame packet(std::uint8_t number, std::uint8_t destination = 0, std::uint8_t source = 5) {
  std::vector<std::uint8_t> bytes(8, static_cast<std::uint8_t>(10 * number));
  bytes[0] = number;
  return j1939_frame(0x1CEB0000U | std::uint32_t{destination} << 8U | source, bytes);
}

struct TakenMessage {
  std::uint32_t id = 0;
  std::vector<std::uint8_t> bytes;
  bool operator==(const TakenMessage&) const = default;
};
std::optional<TakenMessage> take(J1939Receiver& receiver, const Frame& frame) {
  EXPECT_TRUE(J1939Receiver::carries(frame));
  const auto whole = receiver.take(frame);
  if (!whole) return std::nullopt;
  return TakenMessage{whole->id, {whole->bytes.begin(), whole->bytes.end()}};
}
std::optional<TakenMessage> take_all(J1939Receiver& receiver, std::span<const Frame> frames) {
  std::optional<TakenMessage> last;
  for (const Frame& frame : frames) last = take(receiver, frame);
  return last;
}

// A message of 39 bytes has 6 packets; the last one has 4 bytes.
TEST(J1939, BroadcastIsAnAnnouncementAndPacketsOfSevenBytes) {
  const auto frames = split_j1939(j1939_message(39), component_id);
  ASSERT_EQ(frames.size(), 7U);
  EXPECT_EQ(frames[0].id, 0x1CECFF05U);
  EXPECT_THAT(frames[0].payload(), ElementsAre(32, 39, 0, 6, 0xFF, 0xEB, 0xFE, 0x00));
  EXPECT_EQ(frames[1].id, 0x1CEBFF05U);
  EXPECT_THAT(frames[1].payload(), ElementsAre(1, 1, 2, 3, 4, 5, 6, 7));
  EXPECT_THAT(frames[6].payload(), ElementsAre(6, 36, 37, 38, 39, 0xFF, 0xFF, 0xFF));
}

TEST(J1939, MessageOfAnySizeIsPutTogether) {
  J1939Receiver receiver;
  for (std::size_t size = fewest_j1939_bytes; size <= most_j1939_bytes; ++size) {
    const auto frames = split_j1939(j1939_message(size), component_id);
    ASSERT_EQ(frames.size(), 1 + j1939_packets(size));
    ASSERT_EQ(take_all(receiver, std::span(frames).first(frames.size() - 1)), std::nullopt);
    ASSERT_EQ(take(receiver, frames.back()), (TakenMessage{0x1CFEEB05, j1939_message(size)})) << size;
  }
  EXPECT_EQ(receiver.lost(), 0U);
  EXPECT_EQ(receiver.open(), 0U);
  EXPECT_EQ(j1939_packets(1785), 255U);
}

TEST(J1939, MessageWithAMissingFrameIsLostOnce) {
  const auto first = split_j1939(j1939_message(39), component_id),
             second = split_j1939(j1939_message(39, 50), component_id);
  for (std::size_t missing = 0; missing < first.size(); ++missing) {
    SCOPED_TRACE(missing);
    J1939Receiver receiver;
    for (std::size_t i = 0; i < first.size(); ++i) {
      if (i == missing) continue;
      EXPECT_EQ(take(receiver, first[i]), std::nullopt);
    }
    EXPECT_EQ(receiver.lost() + receiver.open(), 1U);
    EXPECT_EQ(take_all(receiver, second), (TakenMessage{0x1CFEEB05, j1939_message(39, 50)}));
    EXPECT_EQ(receiver.lost(), 1U);
    EXPECT_EQ(receiver.open(), 0U);
  }
}

// The packets of two sources come alternately.
TEST(J1939, SourcesDoNotDisturbEachOther) {
  const auto a = split_j1939(j1939_message(20), component_id),
             b = split_j1939(j1939_message(20, 50), component_id + 1);
  J1939Receiver receiver;
  std::optional<TakenMessage> of_a, of_b;
  for (std::size_t i = 0; i < a.size(); ++i) {
    of_a = take(receiver, a[i]);
    of_b = take(receiver, b[i]);
  }
  EXPECT_EQ(of_a, (TakenMessage{0x1CFEEB05, j1939_message(20)}));
  EXPECT_EQ(of_b, (TakenMessage{0x1CFEEB06, j1939_message(20, 50)}));
}

// Node 5 sends 20 bytes of PGN 61184 (PDU1) to node 0, which wants packet 2 again.
TEST(J1939, MessageToOneNodeFollowsWhatTheNodeWants) {
  J1939Receiver receiver;
  const auto management = [&](std::uint32_t id, const std::vector<std::uint8_t>& bytes) {
    EXPECT_EQ(take(receiver, j1939_frame(id, bytes)), std::nullopt);
  };
  management(0x1CEC0005, {16, 20, 0, 3, 255, 0x00, 0xEF, 0x00});
  management(0x1CEC0500, {17, 2, 1, 255, 255, 0x00, 0xEF, 0x00});
  take(receiver, packet(1));
  take(receiver, packet(2));
  management(0x1CEC0500, {17, 0, 255, 255, 255, 0x00, 0xEF, 0x00});  // wait
  management(0x1CEC0500, {17, 2, 2, 255, 255, 0x00, 0xEF, 0x00});
  take(receiver, packet(2));
  const auto whole = take(receiver, packet(3));
  management(0x1CEC0500, {19, 20, 0, 3, 255, 0x00, 0xEF, 0x00});
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->id, 0x1CEF0005U);
  EXPECT_THAT(whole->bytes,
              ElementsAre(10, 10, 10, 10, 10, 10, 10, 20, 20, 20, 20, 20, 20, 20, 30, 30, 30, 30, 30, 30));
  EXPECT_EQ(receiver.lost(), 0U);
}

TEST(J1939, AbortedMessageIsLost) {
  for (const std::uint32_t by : {0x1CEC0005U, 0x1CEC0500U}) {
    J1939Receiver receiver;
    take(receiver, j1939_frame(0x1CEC0005, {16, 20, 0, 3, 255, 0x00, 0xEF, 0x00}));
    take(receiver, packet(1));
    take(receiver, j1939_frame(by, {255, 3, 255, 255, 255, 0x00, 0xEF, 0x00}));
    take(receiver, packet(2));
    EXPECT_EQ(take(receiver, packet(3)), std::nullopt);
    EXPECT_EQ(receiver.lost(), 1U);
  }
}

TEST(J1939, AnnouncementThatContradictsItselfIsLost) {
  using Bytes = std::vector<std::uint8_t>;
  for (const Bytes& sizes : {Bytes{8, 0, 2}, Bytes{39, 0, 5}, Bytes{0xFA, 6, 255}, Bytes{0, 0, 0}}) {
    J1939Receiver receiver;
    take(receiver, j1939_frame(0x1CECFF05, {32, sizes[0], sizes[1], sizes[2], 255, 0xEB, 0xFE, 0x00}));
    EXPECT_EQ(take(receiver, packet(1, 255)), std::nullopt);
    EXPECT_EQ(receiver.lost(), 1U);
  }
}

// A log may begin inside of a message, and a node may ask again when nobody answers.
TEST(J1939, PacketsWithoutAnAnnouncementAreOneLostMessage) {
  J1939Receiver receiver;
  for (const std::uint8_t number : std::vector<std::uint8_t>{4, 5, 6, 1, 2})
    take(receiver, packet(number, 255));
  EXPECT_EQ(receiver.lost(), 2U);
}
TEST(J1939, RepeatedRequestIsOneMessage) {
  J1939Receiver receiver;
  for (int i = 0; i < 3; ++i) take(receiver, j1939_frame(0x1CEC0005, {16, 9, 0, 2, 255, 0x00, 0xEF, 0x00}));
  take(receiver, packet(1));
  EXPECT_TRUE(take(receiver, packet(2)));
  EXPECT_EQ(receiver.lost(), 0U);
}

TEST(J1939, OtherFramesAreNotOfTheProtocol) {
  EXPECT_FALSE(J1939Receiver::carries({.id = component_id, .size = 8, .extended = true}));
  EXPECT_FALSE(J1939Receiver::carries({.id = 0x1CECFF05, .size = 8}));
  EXPECT_FALSE(J1939Receiver::carries({.id = 0x1CECFF05, .size = 8, .extended = true, .fd = true}));
}

}  // namespace
}  // namespace canhil::transport
