#include "bench/observe/bus_watch.hpp"

#include <gmock/gmock.h>
#include <linux/can/error.h>

#include "tests/unit/bench/drive/fake_port.hpp"

namespace canhil::observe {
namespace {

using namespace drive;

class Bus : public testing::Test {
 protected:
  void error_frame(std::uint32_t classes, std::uint8_t state = 0, std::int64_t t_ns = 0) {
    Frame frame{.id = classes, .size = CAN_ERR_DLC, .error = true};
    frame.data[1] = state;
    watch_.received({.frame = frame, .t_ns = t_ns});
  }
  [[nodiscard]] std::string outage() const {
    return watch_.outage() ? std::string(watch_.outage()->what) : "";
  }
  FakePort port_;
  BusWatch watch_{port_};
};

TEST_F(Bus, RecordsChangesOfStateAndCountsTheRest) {
  error_frame(CAN_ERR_ACK);
  error_frame(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE, 5);
  error_frame(CAN_ERR_BUSOFF, 0, 6);
  watch_.interface_changed(false, 7);
  const checks::BusRecord& record = watch_.record();
  EXPECT_EQ(record.errors.frames, 3U);
  EXPECT_EQ(record.downs, 1U);
  ASSERT_EQ(record.incidents.size(), 3U);
  EXPECT_EQ(record.incidents[0].t_ns, 5);
  EXPECT_EQ(record.incidents[0].event, BusEvent::error_passive);
  EXPECT_EQ(record.incidents[1].event, BusEvent::bus_off);
  EXPECT_EQ(record.incidents[2].event, BusEvent::down);
}

TEST_F(Bus, ABusOffLastsUntilARestartOrAFrame) {
  error_frame(CAN_ERR_BUSOFF);
  EXPECT_EQ(outage(), "the bus is off");
  error_frame(CAN_ERR_RESTARTED);
  EXPECT_EQ(outage(), "");
  EXPECT_GT(watch_.ended_ns(), 0);
  error_frame(CAN_ERR_BUSOFF);
  watch_.received({.frame = {.id = 1}});
  EXPECT_EQ(outage(), "");
}

TEST_F(Bus, ADownInterfaceIsDownUntilItIsUpWhateverWasInItsQueue) {
  watch_.interface_changed(false, 0);
  watch_.received({.frame = {.id = 1}});
  error_frame(CAN_ERR_CRTL, CAN_ERR_CRTL_ACTIVE);
  EXPECT_EQ(outage(), "the interface is down");
  watch_.interface_changed(true, 0);
  EXPECT_EQ(outage(), "");
}

TEST_F(Bus, AnOutageThatBecomesAnotherBeganWithTheFirst) {
  error_frame(CAN_ERR_BUSOFF);
  const std::int64_t since_ns = watch_.outage()->since_ns;
  watch_.interface_changed(false, 0);
  EXPECT_EQ(watch_.outage()->since_ns, since_ns);
}

TEST_F(Bus, AFlickeringBusFillsNoMemory) {
  for (std::size_t n = 0; n < 2 * checks::BusRecord::max_incidents; ++n)
    error_frame(CAN_ERR_CRTL, n % 2 == 0 ? CAN_ERR_CRTL_RX_PASSIVE : CAN_ERR_CRTL_ACTIVE);
  EXPECT_EQ(watch_.record().incidents.size(), checks::BusRecord::max_incidents);
  EXPECT_EQ(watch_.record().more_incidents, checks::BusRecord::max_incidents);
}

}  // namespace
}  // namespace canhil::observe
