// Every class of error frame of linux/can/error.h.
#include "dbc/ports/bus_errors.hpp"

#include <gmock/gmock.h>
#include <linux/can/error.h>

#include <array>

namespace canhil {
namespace {

Frame error_frame(std::uint32_t classes, const std::array<std::uint8_t, 8>& data = {}) {
  Frame frame{.id = classes, .size = CAN_ERR_DLC, .error = true};
  std::copy(data.begin(), data.end(), frame.data.begin());
  return frame;
}

struct Case {
  std::uint32_t classes;
  std::array<std::uint8_t, 8> data;
  std::uint64_t BusErrors::*counter;
  std::optional<BusEvent> event;
};

class ErrorClass : public testing::TestWithParam<Case> {};

TEST_P(ErrorClass, IsCountedAndNothingElse) {
  const Case& one = GetParam();
  BusErrors errors;
  EXPECT_EQ(add(errors, error_frame(one.classes, one.data)), one.event);
  BusErrors expected{.frames = 1};
  expected.*one.counter = 1;
  EXPECT_EQ(errors, expected);
  add(errors, error_frame(one.classes, one.data));
  EXPECT_EQ(errors.*one.counter, 2U);
}

constexpr std::nullopt_t no_event = std::nullopt;
INSTANTIATE_TEST_SUITE_P(
    Every, ErrorClass,
    testing::Values(
        Case{CAN_ERR_TX_TIMEOUT, {}, &BusErrors::tx_timeout, no_event},
        Case{CAN_ERR_LOSTARB, {12}, &BusErrors::lost_arbitration, no_event},
        Case{CAN_ERR_PROT, {0, 0, CAN_ERR_PROT_STUFF, CAN_ERR_PROT_LOC_DATA}, &BusErrors::protocol, no_event},
        Case{CAN_ERR_TRX, {0, 0, 0, 0, CAN_ERR_TRX_CANH_NO_WIRE}, &BusErrors::transceiver, no_event},
        Case{CAN_ERR_ACK, {}, &BusErrors::no_ack, no_event},
        Case{CAN_ERR_BUSERROR, {}, &BusErrors::bus_error, no_event},
        Case{CAN_ERR_BUSOFF, {}, &BusErrors::bus_off, BusEvent::bus_off},
        Case{CAN_ERR_RESTARTED, {}, &BusErrors::restarted, BusEvent::restarted},
        Case{CAN_ERR_CRTL, {0, CAN_ERR_CRTL_RX_OVERFLOW}, &BusErrors::rx_overflow, no_event},
        Case{CAN_ERR_CRTL, {0, CAN_ERR_CRTL_TX_OVERFLOW}, &BusErrors::tx_overflow, no_event},
        Case{CAN_ERR_CRTL, {0, CAN_ERR_CRTL_RX_WARNING}, &BusErrors::warning, BusEvent::error_warning},
        Case{CAN_ERR_CRTL, {0, CAN_ERR_CRTL_TX_WARNING}, &BusErrors::warning, BusEvent::error_warning},
        Case{CAN_ERR_CRTL, {0, CAN_ERR_CRTL_RX_PASSIVE}, &BusErrors::passive, BusEvent::error_passive},
        Case{CAN_ERR_CRTL, {0, CAN_ERR_CRTL_TX_PASSIVE}, &BusErrors::passive, BusEvent::error_passive},
        Case{CAN_ERR_CRTL, {0, CAN_ERR_CRTL_ACTIVE}, &BusErrors::active, BusEvent::error_active}));

TEST(BusErrors, OneFrameMaySaySeveralThingsAndTheGravestIsTheEvent) {
  BusErrors errors;
  EXPECT_EQ(add(errors, error_frame(CAN_ERR_CRTL | CAN_ERR_PROT | CAN_ERR_BUSERROR | CAN_ERR_BUSOFF,
                                    {0, CAN_ERR_CRTL_TX_PASSIVE | CAN_ERR_CRTL_TX_WARNING, 1})),
            BusEvent::bus_off);
  EXPECT_EQ(errors.frames, 1U);
  EXPECT_EQ(errors.bus_off + errors.passive + errors.warning + errors.protocol + errors.bus_error, 5U);
}

TEST(BusErrors, TheControllersCountersAreTakenWhereTheyAreReported) {
  BusErrors errors;
  add(errors, error_frame(CAN_ERR_CNT, {0, 0, 0, 0, 0, 0, 136, 7}));
  EXPECT_EQ(errors.tx_counter, 136);
  EXPECT_EQ(errors.rx_counter, 7);
  add(errors, error_frame(CAN_ERR_BUSERROR | CAN_ERR_PROT, {0, 0, 0, 0, 0, 0, 99, 99}));
  EXPECT_EQ(errors.tx_counter, 136) << "no counters without CAN_ERR_CNT";
  add(errors, error_frame(CAN_ERR_CRTL, {0, CAN_ERR_CRTL_RX_WARNING, 0, 0, 0, 0, 0, 96}));
  EXPECT_EQ(errors.tx_counter, 0) << "but a kernel before 6.0 says them with the state";
  EXPECT_EQ(errors.rx_counter, 96);
  add(errors, error_frame(CAN_ERR_CRTL, {0, CAN_ERR_CRTL_ACTIVE}));
  EXPECT_EQ(errors.rx_counter, 96) << "or not at all";
  add(errors, error_frame(CAN_ERR_CNT, {0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(errors.rx_counter, 0);
  EXPECT_EQ(errors.tx_counter_max, 136);
  EXPECT_EQ(errors.rx_counter_max, 96);
}

TEST(BusErrors, AShortFrameHasNoDetails) {
  BusErrors errors;
  Frame frame = error_frame(CAN_ERR_CRTL | CAN_ERR_CNT, {0, CAN_ERR_CRTL_TX_PASSIVE, 0, 0, 0, 0, 128, 0});
  frame.size = 1;
  EXPECT_EQ(add(errors, frame), std::nullopt);
  EXPECT_EQ(errors, BusErrors{.frames = 1});
}

TEST(BusErrors, InWords) {
  BusErrors errors;
  EXPECT_EQ(to_text(errors), "");
  add(errors, error_frame(0));
  EXPECT_EQ(to_text(errors), "of an unknown class");
  add(errors, error_frame(CAN_ERR_BUSOFF));
  add(errors, error_frame(CAN_ERR_ACK));
  add(errors, error_frame(CAN_ERR_ACK | CAN_ERR_CNT, {0, 0, 0, 0, 0, 0, 136, 0}));
  EXPECT_EQ(to_text(errors), "bus off 1, no acknowledgement 2; error counters at most tx 136, rx 0");
}

}  // namespace
}  // namespace canhil
