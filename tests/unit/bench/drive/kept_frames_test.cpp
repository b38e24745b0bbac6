// The frames of a flight are kept in order, with the time of the run.
#include "bench/drive/kept_frames.hpp"

#include <gmock/gmock.h>

namespace canhil::drive {
namespace {

Frame frame_of(std::uint32_t id, std::uint8_t size) {
  Frame frame{.id = id, .size = size};
  for (std::uint8_t i = 0; i < size; ++i) frame.data[i] = static_cast<std::uint8_t>(id + i);
  return frame;
}

TEST(KeptFrames, AreThoseOfTheFlightWithTheirBytesAndTimes) {
  KeptFrames kept;
  kept.received({.frame = frame_of(1, 8), .t_ns = 5'000'000});  // before the flight
  kept.transmitted(frame_of(2, 8), 7'000'000, 0);
  kept.received({.frame = frame_of(2, 8), .t_ns = 7'100'000, .own = true});  // its echo
  kept.received({.frame = frame_of(3, 64), .t_ns = 9'000'000});
  kept.transmitted(frame_of(4, 0), 10'000'000, 0);
  ASSERT_EQ(kept.size(), 3U);
  EXPECT_EQ(kept[0].frame, frame_of(2, 8));
  EXPECT_TRUE(kept[0].transmitted);
  EXPECT_EQ(kept[0].t_us, 0);
  EXPECT_EQ(kept[1].frame, frame_of(3, 64));
  EXPECT_FALSE(kept[1].transmitted);
  EXPECT_EQ(kept[1].t_us, 2000);
  EXPECT_EQ(kept[2].frame, frame_of(4, 0));
  EXPECT_EQ(kept.first_from(0), 0U);
  EXPECT_EQ(kept.first_from(1), 1U);
  EXPECT_EQ(kept.first_from(2000), 1U);
  EXPECT_EQ(kept.first_from(3001), 3U);
}

TEST(KeptFrames, OfAStepOfVirtualTimeHaveItsTime) {
  KeptFrames kept;
  kept.time_set(10'000'000);
  kept.transmitted(frame_of(1, 8), 123, 0);
  kept.time_set(20'000'000);
  kept.received({.frame = frame_of(2, 8), .t_ns = 456});
  ASSERT_EQ(kept.size(), 2U);
  EXPECT_EQ(kept[0].t_us, 10'000);
  EXPECT_EQ(kept[1].t_us, 20'000);
}

}  // namespace
}  // namespace canhil::drive
