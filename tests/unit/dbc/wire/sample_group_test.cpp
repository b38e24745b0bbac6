#include "dbc/wire/sample_group.hpp"

#include <gtest/gtest.h>

#include "messages/canhil.hpp"

namespace canhil {
namespace {

using messages::SlaveImuDeltaTheta;
using messages::SlaveImuDeltaV;
using messages::SlaveImuStatus;
using Group = SampleGroup<SlaveImuDeltaTheta, SlaveImuDeltaV, SlaveImuStatus>;
using Outcome = Group::Outcome;

TEST(SampleGroup, IsCompleteWithItsLastMessageInAnyOrder) {
  Group group;
  EXPECT_EQ(group.put(SlaveImuStatus{.time_of_validity_us = 7}, 3), Outcome::waiting);
  EXPECT_EQ(group.put(SlaveImuDeltaTheta{.delta_theta_x_rad = 0.25}, 3), Outcome::waiting);
  EXPECT_EQ(group.put(SlaveImuDeltaV{.delta_v_x_mps = 0.5}, 3), Outcome::complete);
  EXPECT_EQ(group.counter(), 3);
  EXPECT_EQ(group.get<SlaveImuStatus>().time_of_validity_us, 7U);
  EXPECT_EQ(group.get<SlaveImuDeltaTheta>().delta_theta_x_rad, 0.25);
  EXPECT_EQ(group.get<SlaveImuDeltaV>().delta_v_x_mps, 0.5);
}

TEST(SampleGroup, NeedsEveryMessageAnewForTheNextGroup) {
  Group group;
  group.put(SlaveImuDeltaTheta{}, 0);
  group.put(SlaveImuDeltaV{}, 0);
  ASSERT_EQ(group.put(SlaveImuStatus{}, 0), Outcome::complete);
  EXPECT_EQ(group.put(SlaveImuStatus{}, 1), Outcome::waiting);
  EXPECT_EQ(group.put(SlaveImuDeltaTheta{}, 1), Outcome::waiting);
  EXPECT_EQ(group.put(SlaveImuDeltaV{}, 1), Outcome::complete);
}

TEST(SampleGroup, AnotherCounterDropsTheGroupInProgress) {
  Group group;
  group.put(SlaveImuDeltaTheta{}, 4);
  group.put(SlaveImuDeltaV{}, 4);
  EXPECT_EQ(group.put(SlaveImuStatus{}, 5), Outcome::dropped_previous);
  EXPECT_EQ(group.counter(), 5);
  EXPECT_EQ(group.put(SlaveImuDeltaTheta{}, 5), Outcome::waiting);
  EXPECT_EQ(group.put(SlaveImuDeltaV{}, 5), Outcome::complete);
}

TEST(SampleGroup, TheSameMessageTwiceDoesNotMakeItWhole) {
  Group group;
  group.put(SlaveImuDeltaTheta{}, 4);
  EXPECT_EQ(group.put(SlaveImuDeltaTheta{}, 4), Outcome::waiting);
  EXPECT_EQ(group.put(SlaveImuDeltaTheta{}, 4), Outcome::waiting);
}

TEST(SampleGroup, DiscardForgetsAndSaysSo) {
  Group group;
  EXPECT_FALSE(group.discard());
  group.put(SlaveImuDeltaTheta{}, 4);
  EXPECT_TRUE(group.discard());
  EXPECT_FALSE(group.discard());
  EXPECT_EQ(group.put(SlaveImuDeltaV{}, 5), Outcome::waiting);
}

TEST(SampleGroup, OfOneMessageIsCompleteAtOnce) {
  SampleGroup<SlaveImuStatus> group;
  EXPECT_EQ(group.put(SlaveImuStatus{}, 1), SampleGroup<SlaveImuStatus>::Outcome::complete);
}

}  // namespace
}  // namespace canhil
