#include "bench/doctor/interface.hpp"

#include <gmock/gmock.h>
#include <linux/can/netlink.h>
#include <linux/if_link.h>
#include <linux/net_tstamp.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <net/if_arp.h>

#include <cstring>

namespace canhil::doctor {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

using Message = std::vector<std::byte>;

template <class T>
Message bytes_of(const T& value) {
  Message bytes(sizeof value);
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

// Appends an attribute and pads it to a multiple of four bytes, as the kernel does.
Message with(Message message, int type, const Message& payload) {
  const rtattr header{.rta_len = static_cast<unsigned short>(sizeof header + payload.size()),
                      .rta_type = static_cast<unsigned short>(type)};
  const Message head = bytes_of(header);
  message.insert(message.end(), head.begin(), head.end());
  message.insert(message.end(), payload.begin(), payload.end());
  message.resize((message.size() + 3) / 4 * 4);
  return message;
}

Message text(const char* what) {
  return {reinterpret_cast<const std::byte*>(what),
          reinterpret_cast<const std::byte*>(what) + std::strlen(what) + 1};
}

Message link(unsigned short type, unsigned flags, const Message& info) {
  ifinfomsg header{};
  header.ifi_type = type;
  header.ifi_flags = flags;
  Message message = with(bytes_of(header), IFLA_IFNAME, text("can7"));
  message = with(message, IFLA_TXQLEN, bytes_of(std::uint32_t{10}));
  message = with(message, IFLA_MTU, bytes_of(std::uint32_t{16}));
  return with(message, IFLA_LINKINFO | NLA_F_NESTED, info);
}

Message controller_message() {
  can_bittiming timing{};
  timing.bitrate = 500'000;
  timing.sample_point = 875;
  const can_ctrlmode mode{.mask = ~0U, .flags = CAN_CTRLMODE_LISTENONLY};
  const can_berr_counter errors{.txerr = 128, .rxerr = 3};
  Message data = with({}, IFLA_CAN_BITTIMING, bytes_of(timing));
  data = with(data, IFLA_CAN_STATE, bytes_of(std::uint32_t{CAN_STATE_ERROR_PASSIVE}));
  data = with(data, IFLA_CAN_CTRLMODE, bytes_of(mode));
  data = with(data, IFLA_CAN_RESTART_MS, bytes_of(std::uint32_t{100}));
  data = with(data, IFLA_CAN_BERR_COUNTER, bytes_of(errors));
  data = with(data, IFLA_CAN_TERMINATION, bytes_of(std::uint16_t{120}));
  can_device_stats statistics{};
  statistics.bus_error = 5;
  statistics.bus_off = 2;
  Message info = with({}, IFLA_INFO_KIND, text("can"));
  info = with(info, IFLA_INFO_DATA | NLA_F_NESTED, data);
  return link(ARPHRD_CAN, IFF_UP, with(info, IFLA_INFO_XSTATS, bytes_of(statistics)));
}

TEST(ReadLink, AControllerWithAllThatTheKernelReports) {
  const Interface read = read_link(controller_message());
  EXPECT_EQ(read.name, "can7");
  EXPECT_TRUE(read.is_can);
  EXPECT_TRUE(read.up);
  EXPECT_EQ(read.kind, "can");
  EXPECT_EQ(read.mtu, 16U);
  EXPECT_EQ(read.queue_length, 10U);
  ASSERT_TRUE(read.controller);
  EXPECT_EQ(read.controller->nominal.bitrate, 500'000U);
  EXPECT_EQ(read.controller->nominal.sample_point_permille, 875U);
  EXPECT_EQ(read.controller->data.bitrate, 0U);
  EXPECT_EQ(read.controller->state, CAN_STATE_ERROR_PASSIVE);
  EXPECT_EQ(read.controller->mode, CAN_CTRLMODE_LISTENONLY);
  EXPECT_EQ(read.controller->restart_ms, 100U);
  EXPECT_EQ(read.controller->transmit_errors, 128);
  EXPECT_EQ(read.controller->receive_errors, 3);
  EXPECT_EQ(read.controller->termination_ohm, 120);
  EXPECT_EQ(read.controller->bus_errors, 5U);
  EXPECT_EQ(read.controller->bus_offs, 2U);
}

TEST(ReadLink, WhatIsNoControllerHasNone) {
  const Interface virtual_one = read_link(link(ARPHRD_CAN, 0, with({}, IFLA_INFO_KIND, text("vcan"))));
  EXPECT_EQ(virtual_one.kind, "vcan");
  EXPECT_FALSE(virtual_one.up);
  EXPECT_FALSE(virtual_one.controller);
  EXPECT_FALSE(read_link(link(ARPHRD_ETHER, IFF_UP, {})).is_can);
}

// Reading a truncated or damaged message never accesses memory outside the message (the sanitizers check
// this).
TEST(ReadLink, ADamagedMessageGivesWhatCouldBeRead) {
  const Message whole = controller_message();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const Message cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_LE(read_link(cut).name.size(), 4U);
    Message damaged = whole;
    damaged[size] = std::byte{0xFF};
    EXPECT_LE(read_link(damaged).name.size(), whole.size());
  }
  EXPECT_EQ(read_link(Message(10)).name, "");
}

Interface healthy() {
  return {.name = "can7",
          .is_can = true,
          .up = true,
          .kind = "can",
          .driver = "kvaser_pci at 0000:00:04.0",
          .mtu = 16,
          .queue_length = 10,
          .controller =
              Controller{.nominal = {.bitrate = 1'000'000, .sample_point_permille = 875}, .restart_ms = 100},
          .stamping = std::nullopt};
}

// The lines that report a problem: grade, subject, finding and remedy.
std::vector<std::string> complaints(const Interface& interface) {
  std::vector<std::string> found;
  for (const Line& line : interface_lines(interface)) {
    EXPECT_EQ(line.remedy.empty(), line.grade == Grade::good) << line.subject;
    if (line.grade != Grade::good)
      found.push_back(std::string(name(line.grade)) + " " + line.subject + ": " + line.found + ": " +
                      line.remedy);
  }
  return found;
}

TEST(InterfaceLines, AHealthyControllerIsGoodThroughout) {
  EXPECT_THAT(complaints(healthy()), IsEmpty());
  EXPECT_EQ(interface_lines(healthy()).size(), 10U);
  EXPECT_EQ(interface_lines(healthy()).front().found, "can7: can, driver kvaser_pci at 0000:00:04.0; up");
}

template <class Change>
std::vector<std::string> complaints_after(Change&& change) {
  Interface interface = healthy();
  change(interface);
  return complaints(interface);
}

TEST(InterfaceLines, EachFaultIsNamedWithItsRemedy) {
  const auto controller = [](auto&& change) {
    return complaints_after([&](Interface& interface) { change(*interface.controller); });
  };
  EXPECT_THAT(controller([](Controller& c) { c.state = CAN_STATE_ERROR_WARNING; }),
              ElementsAre(HasSubstr("weak state: error-warning")));
  EXPECT_THAT(controller([](Controller& c) { c.state = CAN_STATE_ERROR_PASSIVE; }),
              ElementsAre(HasSubstr("bad state: error-passive")));
  EXPECT_THAT(controller([](Controller& c) { c.state = CAN_STATE_BUS_OFF; }),
              ElementsAre(HasSubstr("`ip link set can7 type can restart`")));
  EXPECT_THAT(controller([](Controller& c) { c.mode = CAN_CTRLMODE_LISTENONLY; }),
              ElementsAre(HasSubstr("bad mode: listen-only")));
  EXPECT_THAT(controller([](Controller& c) { c.mode = CAN_CTRLMODE_LOOPBACK; }),
              ElementsAre(HasSubstr("bad mode: loopback")));
  EXPECT_THAT(controller([](Controller& c) { c.mode = CAN_CTRLMODE_ONE_SHOT; }),
              ElementsAre(HasSubstr("weak mode: one-shot")));
  EXPECT_THAT(controller([](Controller& c) { c.nominal.bitrate = 250'000; }),
              ElementsAre(HasSubstr("weak bit rate: 250000 bit/s")));
  EXPECT_THAT(controller([](Controller& c) { c.nominal.sample_point_permille = 700; }),
              ElementsAre(HasSubstr("weak sample point: 70.0 % of the bit")));
  EXPECT_THAT(controller([](Controller& c) { c.restart_ms = 0; }), ElementsAre(HasSubstr("restart-ms 100")));
  EXPECT_THAT(controller([](Controller& c) { c.bus_offs = 1; }), ElementsAre(HasSubstr("weak errors: ")));
}

TEST(InterfaceLines, AQueueMayBeTooShortAndTooLong) {
  EXPECT_THAT(complaints_after([](Interface& i) { i.queue_length = 9; }),
              ElementsAre(HasSubstr("`ip link set can7 txqueuelen 100`")));
  EXPECT_THAT(complaints_after([](Interface& i) { i.queue_length = 1001; }),
              ElementsAre(HasSubstr("`ip link set can7 txqueuelen 1000`")));
}

TEST(InterfaceLines, StampsByUsbAreWeakUnlessTheAdapterTakesThem) {
  EXPECT_THAT(complaints_after([](Interface& i) { i.driver = "gs_usb at usb-0000:00:14.0-1"; }),
              ElementsAre(HasSubstr("weak time stamps: by the kernel")));
  EXPECT_THAT(complaints_after([](Interface& i) {
                i.driver = "gs_usb at usb-0000:00:14.0-1";
                i.stamping = SOF_TIMESTAMPING_RX_HARDWARE | SOF_TIMESTAMPING_RAW_HARDWARE;
              }),
              IsEmpty());
}

TEST(InterfaceLines, TwoOnABusMustHaveOneBitRate) {
  Interface other = healthy();
  EXPECT_THAT(mismatch_lines(healthy(), other), IsEmpty());
  other.controller->nominal.bitrate = 500'000;
  ASSERT_EQ(mismatch_lines(healthy(), other).size(), 1U);
  EXPECT_EQ(mismatch_lines(healthy(), other).front().grade, Grade::bad);
  other.controller.reset();
  EXPECT_THAT(mismatch_lines(healthy(), other), IsEmpty());
}

TEST(InterfaceLines, WhatIsDownOrNoCanIsOneLine) {
  EXPECT_THAT(complaints_after([](Interface& i) { i.up = false; }),
              ElementsAre(HasSubstr("bad interface: can7: can, driver kvaser_pci at 0000:00:04.0; down")));
  EXPECT_THAT(complaints_after([](Interface& i) {
                i.up = false;
                i.controller->nominal.bitrate = 0;
              }),
              ElementsAre(HasSubstr("`ip link set can7 up type can bitrate 1000000 restart-ms 100`")));
  EXPECT_THAT(complaints_after([](Interface& i) { i.is_can = false; }),
              ElementsAre(HasSubstr("not a CAN interface")));
  EXPECT_THAT(no_interface("can9").found, HasSubstr("can9: "));
  EXPECT_EQ(no_interface("can9").grade, Grade::bad);
}

TEST(FindInterface, AsksTheKernel) {
  const auto loopback = find_interface("lo");
  ASSERT_TRUE(loopback);
  EXPECT_EQ(loopback->name, "lo");
  EXPECT_FALSE(loopback->is_can);
  EXPECT_GT(loopback->mtu, 0U);
  EXPECT_FALSE(find_interface("no-such-if"));
}

}  // namespace
}  // namespace canhil::doctor
