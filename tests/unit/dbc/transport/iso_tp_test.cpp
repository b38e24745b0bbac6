// The transport protocol of diagnostics, with the forms of frames that ISO 15765-2 defines.
#include "dbc/transport/iso_tp.hpp"

#include <gmock/gmock.h>

#include <numeric>

namespace canhil::transport {
namespace {

using testing::ElementsAre;
using testing::Optional;

Bytes counted(std::size_t size) {
  Bytes bytes(size);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{1});
  return bytes;
}

// Carries a message from a sender to a receiver, which paces it.
std::optional<Bytes> carried(const Bytes& message, const IsoTpSettings& settings, std::uint8_t block = 0) {
  IsoTpSender sender(message, settings);
  IsoTpReceiver receiver(settings);
  for (unsigned since = 0; !sender.over() || sender.may_send();) {
    const auto frame = sender.next();
    if (!frame) return std::nullopt;
    auto taken = receiver.take(*frame);
    if (taken.message) return taken.message;
    if (taken.flow_control) {
      (*taken.flow_control)[1] = block;
      sender.take(*taken.flow_control);
      since = 0;
    } else if (block > 0 && ++since == block) {
      EXPECT_FALSE(sender.may_send()) << "it must wait after each block";
      sender.take(Bytes{0x30, block, 0});
      since = 0;
    }
  }
  return std::nullopt;
}

TEST(IsoTpSending, SevenBytesAreASingleFrame) {
  IsoTpSender sender({0x22, 0xF1, 0x90}, {});
  EXPECT_THAT(sender.next(), Optional(ElementsAre(0x03, 0x22, 0xF1, 0x90, 0xCC, 0xCC, 0xCC, 0xCC)));
  EXPECT_TRUE(sender.over());
}

TEST(IsoTpSending, MoreWaitForFlowControl) {
  IsoTpSender sender(counted(20), {});
  EXPECT_THAT(sender.next(), Optional(ElementsAre(0x10, 20, 1, 2, 3, 4, 5, 6)));
  EXPECT_FALSE(sender.may_send());
  sender.take(Bytes{0x31, 0, 0});  // wait
  EXPECT_FALSE(sender.may_send());
  sender.take(Bytes{0x30, 0, 0xF3});
  EXPECT_EQ(sender.separation_us(), 300);
  EXPECT_THAT(sender.next(), Optional(ElementsAre(0x21, 7, 8, 9, 10, 11, 12, 13)));
  EXPECT_THAT(sender.next(), Optional(ElementsAre(0x22, 14, 15, 16, 17, 18, 19, 20)));
  EXPECT_TRUE(sender.over());
  EXPECT_EQ(sender.failure(), "");
}

TEST(IsoTpSending, OverflowEndsIt) {
  IsoTpSender sender(counted(20), {});
  sender.next();
  sender.take(Bytes{0x32, 0, 0});
  EXPECT_TRUE(sender.over());
  EXPECT_NE(sender.failure(), "");
}

// 9.6.5.4: 0 to 127 ms, 0xF1 to 0xF9 are 100 to 900 us, a reserved value is 127 ms.
TEST(IsoTpSending, SeparationHasTwoScales) {
  const auto separation = [](std::uint8_t st_min) {
    IsoTpSender sender(counted(20), {});
    sender.next();
    sender.take(Bytes{0x30, 0, st_min});
    return sender.separation_us();
  };
  EXPECT_EQ(separation(0), 0);
  EXPECT_EQ(separation(20), 20'000);
  EXPECT_EQ(separation(0xF1), 100);
  EXPECT_EQ(separation(0xF9), 900);
  EXPECT_EQ(separation(0x80), 127'000);
  EXPECT_EQ(separation(0xFA), 127'000);
}

TEST(IsoTp, AnySizeArrives) {
  for (const std::size_t size : {1U, 7U, 8U, 62U, 63U, 100U, 111U, 4095U, 4096U, 70'000U}) {
    for (const unsigned frame_bytes : {8U, 64U}) {
      for (const std::uint8_t block : Bytes{0, 1, 3}) {
        EXPECT_THAT(carried(counted(size), {.frame_bytes = frame_bytes}, block), Optional(counted(size)))
            << size << " bytes in frames of " << frame_bytes << ", blocks of " << int{block};
      }
    }
  }
}

// With CAN FD a single frame of more than 7 bytes has its length in byte 1, and padding up to the next size
// of a frame.
TEST(IsoTp, CanFdHasLongSingleFrames) {
  IsoTpSender sender(counted(9), {.frame_bytes = 64});
  EXPECT_THAT(sender.next(), Optional(ElementsAre(0x00, 9, 1, 2, 3, 4, 5, 6, 7, 8, 9, 0xCC)));
  IsoTpSender longest(counted(62), {.frame_bytes = 64});
  EXPECT_EQ(longest.next()->size(), 64U);
  EXPECT_TRUE(longest.over());
}

TEST(IsoTpReceiving, FirstFrameIsAnsweredByFlowControl) {
  IsoTpReceiver receiver({});
  const auto taken = receiver.take(Bytes{0x10, 9, 1, 2, 3, 4, 5, 6});
  EXPECT_THAT(taken.flow_control, Optional(ElementsAre(0x30, 0, 0, 0xCC, 0xCC, 0xCC, 0xCC, 0xCC)));
  EXPECT_THAT(receiver.take(Bytes{0x21, 7, 8, 9, 0, 0, 0, 0}).message, Optional(counted(9)));
}

TEST(IsoTpReceiving, MissingFrameLosesTheMessage) {
  IsoTpReceiver receiver({});
  receiver.take(Bytes{0x10, 20, 1, 2, 3, 4, 5, 6});
  EXPECT_EQ(receiver.take(Bytes{0x22, 14, 15, 16, 17, 18, 19, 20}).broken,
            "the consecutive frame 2 came, expected 1");
  EXPECT_FALSE(receiver.take(Bytes{0x21, 7, 8, 9, 10, 11, 12, 13}).message);
}

TEST(IsoTpReceiving, NewMessageEndsTheOpenOne) {
  IsoTpReceiver receiver({});
  receiver.take(Bytes{0x10, 20, 1, 2, 3, 4, 5, 6});
  const auto taken = receiver.take(Bytes{0x01, 0x54});
  EXPECT_NE(taken.broken, "");
  EXPECT_THAT(taken.message, Optional(ElementsAre(0x54)));
}

TEST(IsoTpReceiving, FramesThatAreNoneDoNothing) {
  IsoTpReceiver receiver({});
  for (const Bytes& frame : {Bytes{}, Bytes{0x00}, Bytes{0x10}, Bytes{0x10, 0x00, 0, 0}, Bytes{0x21, 1},
                             Bytes{0x30, 0, 0}, Bytes{0x40}}) {
    const auto taken = receiver.take(frame);
    EXPECT_FALSE(taken.message || taken.flow_control);
  }
  EXPECT_NE(receiver.take(Bytes{0x07, 1}).broken, "");
  const auto too_long = receiver.take(Bytes{0x10, 0, 0xFF, 0xFF, 0xFF, 0xFF, 1, 2});
  EXPECT_THAT(too_long.flow_control, Optional(testing::Contains(0x32)));
}

}  // namespace
}  // namespace canhil::transport
