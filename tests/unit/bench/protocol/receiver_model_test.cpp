// The counts that a receiver must report for frames that are missing, damaged, repeated or out of date.
#include "bench/protocol/receiver_model.hpp"

#include <gmock/gmock.h>

#include "dbc/wire/time_base.hpp"
#include "dbc/wire/transmit.hpp"

namespace canhil::protocol {
namespace {

using namespace messages;

class Model : public testing::Test {
 protected:
  // Passes the frames of one IMU sample to the model. Before this, `spoil` may remove or change frames.
  template <class Spoil>
  void imu(std::int64_t valid_us, const Spoil& spoil, Validity validity = Validity::valid) {
    out_.clear();
    out_.send(SlaveImuDeltaTheta{.gyro_validity = validity});
    out_.send(SlaveImuDeltaV{.accel_validity = Validity::valid});
    out_.send(SlaveImuStatus{.time_of_validity_us = wrap_us(valid_us)});
    std::vector<Frame> frames(out_.frames().begin(), out_.frames().end());
    spoil(frames);
    for (const Frame& frame : frames) {
      const bool closes = frame.id == SlaveImuStatus::info.id;
      model_.sent(frame, closes ? std::optional(valid_us) : std::nullopt, now_us_);
    }
  }
  void imu(std::int64_t valid_us, Validity validity = Validity::valid) {
    imu(
        valid_us, [](std::vector<Frame>&) {}, validity);
  }
  void sync(bool lockstep = true) { model_.synchronised(lockstep); }
  [[nodiscard]] checks::LossCounts least() const { return model_.expected().least; }
  [[nodiscard]] checks::LossCounts most() const { return model_.expected().most; }

  ReceiverModel model_{{{"SlaveImu", 2}}};  // two estimators receive the group
  Outbox<3> out_;
  std::int64_t now_us_ = 0;
};

TEST_F(Model, AWholeGroupThatIsWithheldIsLostFramesAndNoBadGroup) {
  imu(10'000);
  imu(20'000, [](std::vector<Frame>& frames) { frames.clear(); });
  sync();
  EXPECT_EQ(least().frames_lost, 0U) << "nobody knows before the next one comes";
  imu(30'000);
  sync();
  EXPECT_EQ(least().frames_lost, 3U);
  EXPECT_EQ(most().bad_group, 0U);
}

TEST_F(Model, AGroupWithAMessageMissingIsDroppedByEachEstimatorThatTakesIt) {
  imu(10'000);
  imu(20'000, [](std::vector<Frame>& frames) { frames.erase(frames.begin()); });
  imu(30'000);
  sync();
  EXPECT_EQ(least().frames_lost, 1U);
  EXPECT_EQ(least().bad_group, 2U);
  EXPECT_EQ(most().bad_group, 2U);
}

TEST_F(Model, ADamagedOrShortFrameCountsAsDamagedAndAsLost) {
  imu(10'000);
  imu(20'000, [](std::vector<Frame>& frames) { frames[0].data[3] ^= 1U; });
  imu(30'000, [](std::vector<Frame>& frames) { --frames[1].size; });
  imu(40'000);
  sync();
  EXPECT_EQ(least().bad_crc, 2U);
  EXPECT_EQ(least().frames_lost, 2U);
  EXPECT_EQ(least().bad_group, 4U);
}

TEST_F(Model, ARepeatedFrameIsLateAndSoIsTheFirstAfterAWholePeriodOfTheCounter) {
  imu(10'000, [](std::vector<Frame>& frames) { frames.push_back(frames.back()); });
  sync();
  EXPECT_EQ(least().late, 1U);
  for (int k = 1; k < e2e::counter_period; ++k)
    imu(10'000L * (k + 1), [](std::vector<Frame>& frames) { frames.clear(); });
  imu(160'000);
  sync();
  EXPECT_EQ(least().late, 4U) << "the counter says that they were there before";
  EXPECT_EQ(least().frames_lost, 0U);
}

TEST_F(Model, AFrameThatIsForeignIsNotThere) {
  imu(10'000);
  imu(20'000, [](std::vector<Frame>& frames) { frames[2].extended = true; });
  imu(30'000);
  sync();
  EXPECT_EQ(least().frames_lost, 1U);
  EXPECT_EQ(least().bad_crc, 0U);
  EXPECT_EQ(least().bad_group, 2U);
}

TEST_F(Model, WhatAnEstimatorMayRefuseLeavesRoomAndNoMore) {
  now_us_ = 1'000'000;
  imu(1'000'000);
  imu(1'010'000, Validity::invalid);
  sync();
  EXPECT_EQ(least().bad_group, 0U);
  EXPECT_EQ(most().bad_group, 2U);
  EXPECT_EQ(most().late, 0U);
  imu(500'000);    // 0.5 s too old
  imu(1'020'000);  // in order again
  imu(1'020'000);  // repeated
  sync();
  EXPECT_EQ(least().late, 0U);
  EXPECT_EQ(most().late, 4U);
  EXPECT_EQ(most().bad_group, 2U);
  imu(2'000'000);  // nearly 1 s in the future
  sync();
  EXPECT_EQ(most().bad_group, 4U);
}

TEST_F(Model, WhileTheImuStaysAwayAMasterVelocityMayBeRefused) {
  ReceiverModel both{{{"SlaveImu", 1}, {"MasterIns", 1}}};
  Outbox<5> master;
  const auto hand_over = [&](std::span<const Frame> frames, std::int64_t valid_us) {
    for (const Frame& frame : frames)
      both.sent(frame, &frame == &frames.back() ? std::optional(valid_us) : std::nullopt, valid_us);
  };
  const auto master_ins = [&](std::int64_t valid_us) {
    master.clear();
    master.send(MasterInsVelocityNE{.velocity_validity = Validity::valid});
    master.send(MasterInsAttitude{});
    master.send(MasterInsLatitude{});
    master.send(MasterInsLongitude{});
    master.send(MasterInsVelocityD{.time_of_validity_us = wrap_us(valid_us)});
    hand_over(master.frames(), valid_us);
    return both.expected().most.bad_group;
  };
  imu(10'000);
  hand_over(out_.frames(), 10'000);
  EXPECT_EQ(master_ins(200'000), 0U);
  EXPECT_EQ(master_ins(300'000), 1U) << "it waits for a time that does not come";
  imu(310'000);
  hand_over(out_.frames(), 310'000);
  EXPECT_EQ(master_ins(400'000), 1U);
}

TEST_F(Model, GroupsThatNobodyTakesAreNotCounted) {
  Outbox<1> out;
  out.send(SeekerAngles{});
  model_.sent(out.frames().front(), std::nullopt, 0);
  out.clear();
  out.send(SeekerAngles{});
  model_.sent(out.frames().front(), std::nullopt, 0);
  sync();
  EXPECT_EQ(most().bad_group, 0U);
}

TEST_F(Model, InRealTimeTheTargetMayBeAPeriodOfItsCountersBehind) {
  imu(10'000);
  imu(20'000, [](std::vector<Frame>& frames) { frames.clear(); });
  imu(30'000);
  for (int k = 0; k < 9; ++k) sync(false);
  EXPECT_EQ(least().frames_lost, 3U);
  imu(40'000, [](std::vector<Frame>& frames) { frames.clear(); });
  imu(50'000);
  sync(false);
  EXPECT_EQ(least().frames_lost, 3U);
  EXPECT_EQ(most().frames_lost, 6U);
  sync(true);
  EXPECT_EQ(least().frames_lost, 6U) << "in lockstep it has read all of it";
}

}  // namespace
}  // namespace canhil::protocol
