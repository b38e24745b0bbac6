// The tests use artificial control messages, because no virtual interface has hardware time stamps.
#include "dbc/ports/ancillary.hpp"

#include <gmock/gmock.h>
#include <linux/errqueue.h>

#include <array>
#include <cstring>

namespace canhil {
namespace {

class ControlMessages : public testing::Test {
 protected:
  template <class Content>
  void put(int level, int type, const Content& content) {
    auto* part = reinterpret_cast<cmsghdr*>(buffer_.data() + message_.msg_controllen);
    part->cmsg_level = level;
    part->cmsg_type = type;
    part->cmsg_len = CMSG_LEN(sizeof content);
    std::memcpy(CMSG_DATA(part), &content, sizeof content);
    message_.msg_control = buffer_.data();
    message_.msg_controllen += CMSG_SPACE(sizeof content);
  }
  void stamp(timespec software, timespec hardware) {
    scm_timestamping stamps{};
    stamps.ts[0] = software;
    stamps.ts[1] = {.tv_sec = 77, .tv_nsec = 77};  // the legacy hardware time stamp
    stamps.ts[2] = hardware;
    put(SOL_SOCKET, SO_TIMESTAMPING, stamps);
  }
  msghdr message_{};

 private:
  alignas(cmsghdr) std::array<char, 512> buffer_{};
};

TEST_F(ControlMessages, HaveBothStamps) {
  stamp({.tv_sec = 5, .tv_nsec = 6}, {.tv_sec = 1, .tv_nsec = 2});
  const Ancillary said = read_ancillary(message_);
  EXPECT_EQ(said.software_ns, 5'000'000'006);
  EXPECT_EQ(said.hardware_ns, 1'000'000'002);
}

TEST_F(ControlMessages, HaveNoHardwareStampWhereTheDriverGivesNone) {
  stamp({.tv_sec = 5, .tv_nsec = 6}, {});
  EXPECT_EQ(read_ancillary(message_).hardware_ns, 0);
}

TEST_F(ControlMessages, OfOtherKindsArePassedOver) {
  put(SOL_SOCKET, SO_RXQ_OVFL, std::uint32_t{7});
  put(SOL_SOCKET + 1, SO_TIMESTAMPING, scm_timestamping{.ts = {{9, 9}, {9, 9}, {9, 9}}});
  stamp({.tv_sec = 5, .tv_nsec = 6}, {});
  EXPECT_EQ(read_ancillary(message_).software_ns, 5'000'000'006);
}

}  // namespace
}  // namespace canhil
