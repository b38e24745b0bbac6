// What befalls frames on their way to the bus.
#include "bench/drive/frame_faults.hpp"

#include <gmock/gmock.h>

#include "dbc/wire/e2e.hpp"
#include "dbc/wire/message.hpp"
#include "messages/canhil.hpp"

namespace canhil::drive {
namespace {

using messages::SlaveImuDeltaTheta;
using messages::SlaveImuDeltaV;
using scenario::Fault;
using scenario::FaultKind;
using testing::HasSubstr;
using testing::SizeIs;

const std::vector<Frame> imu_frames{
    to_frame(SlaveImuDeltaTheta{.delta_theta_x_rad = 0.01, .gyro_validity = messages::Validity::valid}, 3),
    to_frame(SlaveImuDeltaV{}, 3)};

Fault fault(FaultKind kind) {
  return {.kind = kind,
          .messages = {"SlaveImuDeltaTheta"},
          .from_us = 100,
          .to_us = 200,
          .where = "fault[1].messages"};
}

std::vector<Frame> befallen(const Fault& one, std::int64_t t_us = 150) {
  const std::vector<Fault> all{one};
  auto faults = FrameFaults::make(all);
  EXPECT_TRUE(faults);
  const auto left = faults->befall(imu_frames, t_us);
  return {left.begin(), left.end()};
}

bool crc_is_right(const Frame& frame) {
  return frame.data[0] == e2e::crc(frame.payload(), SlaveImuDeltaTheta::info.e2e_data_id);
}

TEST(FrameFaults, BefallTheirMessageInTheirTime) {
  EXPECT_THAT(befallen(fault(FaultKind::lost)), testing::ElementsAre(imu_frames[1]));
  EXPECT_EQ(befallen(fault(FaultKind::lost), 99), imu_frames);
  EXPECT_EQ(befallen(fault(FaultKind::lost), 201), imu_frames);
}

TEST(FrameFaults, EachKindDoesWhatItSays) {
  const auto damaged = befallen(fault(FaultKind::damaged));
  EXPECT_FALSE(crc_is_right(damaged.at(0)));
  EXPECT_NE(from_frame<SlaveImuDeltaTheta>(damaged.at(0)).delta_theta_x_rad,
            from_frame<SlaveImuDeltaTheta>(imu_frames[0]).delta_theta_x_rad);
  EXPECT_THAT(befallen(fault(FaultKind::repeated)),
              testing::ElementsAre(imu_frames[0], imu_frames[0], imu_frames[1]));
  EXPECT_EQ(befallen(fault(FaultKind::too_short)).at(0).size, 7);
  EXPECT_TRUE(befallen(fault(FaultKind::foreign)).at(0).extended);
  Fault changed = fault(FaultKind::changed);
  changed.signal = "delta_theta_y_rad";
  changed.value = -0.05;
  const Frame frame = befallen(changed).at(0);
  EXPECT_TRUE(crc_is_right(frame));
  EXPECT_EQ(e2e::counter(frame.payload()), 3);
  const auto message = from_frame<SlaveImuDeltaTheta>(frame);
  EXPECT_NEAR(message.delta_theta_y_rad, -0.05, 1e-6);
  EXPECT_NEAR(message.delta_theta_x_rad, 0.01, 1e-6);
  EXPECT_EQ(message.gyro_validity, messages::Validity::valid);
}

TEST(FrameFaults, TakeEverySoManyth) {
  Fault third = fault(FaultKind::lost);
  third.every = 3;
  const std::vector<Fault> all{third};
  auto faults = FrameFaults::make(all);
  std::vector<std::size_t> left;
  for (int i = 0; i < 7; ++i) left.push_back(faults->befall(imu_frames, 150).size());
  EXPECT_THAT(left, testing::ElementsAre(1, 2, 2, 1, 2, 2, 1));
}

TEST(FrameFaults, OfNobodyAreRefused) {
  const auto refused = [](Fault one) {
    const std::vector<Fault> all{std::move(one)};
    const auto made = FrameFaults::make(all);
    return made ? std::string() : made.error().message;
  };
  Fault of_target = fault(FaultKind::lost);
  of_target.messages = {"AlignUpdate"};
  EXPECT_THAT(refused(of_target),
              HasSubstr("key 'fault[1].messages': AlignUpdate is no sample of a node of the bench"));
  Fault unknown = fault(FaultKind::changed);
  unknown.signal = "none";
  EXPECT_THAT(refused(unknown), HasSubstr("SlaveImuDeltaTheta has no signal 'none'"));
  Fault beyond = fault(FaultKind::changed);
  beyond.signal = "delta_theta_x_rad";
  beyond.value = 5;
  EXPECT_THAT(refused(beyond), HasSubstr("is 5, expected -0.131 to 0.131"));
}

}  // namespace
}  // namespace canhil::drive
