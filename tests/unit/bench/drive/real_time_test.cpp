#include "bench/drive/real_time.hpp"
#include "bench/protocol/contract_watch.hpp"

#include <gmock/gmock.h>
#include <linux/can/error.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>

#include "bench/nodes/time_keeper.hpp"
#include "tests/unit/bench/drive/fake_port.hpp"

namespace canhil::drive {
namespace {

using messages::TargetHeartbeat;
using messages::TargetState;

class RealTime : public testing::Test {
 protected:
  Ending run(std::int64_t silence_limit_ns) {
    Link link(port_);
    Schedule schedule({}, std::make_unique<nodes::TimeKeeper>(50'000, false));
    protocol::ContractWatch watch;
    return run_real_time(link, schedule, watch, silence_limit_ns, stop_, [](std::int64_t) {});
  }
  static constexpr std::int64_t patient_ns = 60'000'000'000;
  static constexpr std::int64_t impatient_ns = 30'000'000;

  FakePort port_;
  std::atomic<bool> stop_ = false;
};

TEST_F(RealTime, SendsTheWholeSchedule) {
  EXPECT_EQ(run(patient_ns).kind, Ending::Kind::completed);
  EXPECT_EQ(port_.sent.size(), 6U);
}

// A link does not sleep on FakePort, which has no descriptor, even if `spin_ns` is 0 (no polling). Therefore
// this port has a descriptor, on which nothing arrives.
class SilentPort final : public FakePort {
 public:
  SilentPort() { EXPECT_EQ(::pipe(ends_.data()), 0); }
  ~SilentPort() override {
    ::close(ends_[0]);
    ::close(ends_[1]);
  }
  [[nodiscard]] int descriptor() const override { return ends_[0]; }
  std::optional<Received> receive() override {
    ++looks;
    return FakePort::receive();
  }
  int looks = 0;

 private:
  std::array<int, 2> ends_{};
};

TEST_F(RealTime, LooksAtTheBusAllTheTimeThatItSpins) {
  const auto looks = [&](std::int64_t spin_ns) {
    SilentPort port;
    Link link(port);
    Schedule schedule({}, std::make_unique<nodes::TimeKeeper>(50'000, false));
    protocol::ContractWatch watch;
    EXPECT_EQ(run_real_time(
                  link, schedule, watch, patient_ns, stop_, [](std::int64_t) {}, spin_ns)
                  .kind,
              Ending::Kind::completed);
    EXPECT_EQ(port.sent.size(), 6U);
    return port.looks;
  };
  const int asleep = looks(0), spinning = looks(5'000'000);
  EXPECT_LT(asleep, 50) << "it sleeps up to its deadline";
  EXPECT_GT(spinning, 10 * asleep);
}

TEST_F(RealTime, ASignalThatEndsAWaitMakesNoFrameEarly) {
  class Lateness final : public observe::Observer {
   public:
    void transmitted(const Frame& /*frame*/, std::int64_t /*t_ns*/, std::int64_t late_ns) override {
      least_ns = std::min(least_ns, late_ns);
    }
    std::int64_t least_ns = patient_ns;
  };
  SilentPort port;
  Link link(port);
  Lateness lateness;
  const Attached attached(link, lateness);
  Schedule schedule({}, std::make_unique<nodes::TimeKeeper>(50'000, false));
  const auto before = std::signal(SIGALRM, [](int) {});
  const itimerval often{.it_interval = {0, 1000}, .it_value = {0, 1000}}, never{};
  ::setitimer(ITIMER_REAL, &often, nullptr);
  protocol::ContractWatch watch;
  const Ending ending = run_real_time(link, schedule, watch, patient_ns, stop_, [](std::int64_t) {});
  ::setitimer(ITIMER_REAL, &never, nullptr);
  std::signal(SIGALRM, before);
  EXPECT_EQ(ending.kind, Ending::Kind::completed);
  EXPECT_EQ(port.sent.size(), 6U);
  EXPECT_GE(lateness.least_ns, 0);
}

TEST_F(RealTime, NamesASilentTarget) {
  const Ending ending = run(impatient_ns);
  EXPECT_EQ(ending.kind, Ending::Kind::target_silent);
  EXPECT_THAT(ending.detail, testing::HasSubstr("target silent since t="));
}

TEST_F(RealTime, AnErrorFrameIsNoSignOfLife) {
  static_assert(CAN_ERR_CNT == messages::AlignInnovation::info.id);
  // The class bits of error frames with error counters look like the id of AlignInnovation.
  port_.on_send = [&](const Frame&) { port_.give(Frame{.id = CAN_ERR_CNT, .size = 8, .error = true}); };
  EXPECT_EQ(run(impatient_ns).kind, Ending::Kind::target_silent);
}

TEST_F(RealTime, EndsWithAFaultOfTheTarget) {
  port_.on_send = [&](const Frame&) { port_.give(TargetHeartbeat{.state = TargetState::fault}); };
  EXPECT_EQ(run(patient_ns).kind, Ending::Kind::target_fault);
  EXPECT_LE(port_.sent.size(), 2U);
}

TEST_F(RealTime, AFaultOfAnEstimatorThatThereIsNotIsReported) {
  port_.on_send = [&](const Frame&) {
    port_.give(
        TargetHeartbeat{.state = TargetState::fault, .estimator = static_cast<messages::Estimator>(7)});
  };
  EXPECT_EQ(run(patient_ns).detail, "the target reported a fault of its estimator 7, its errors: none");
}

TEST_F(RealTime, EndsWhenTheBusIsDownOrFullOrTheUserSaysSo) {
  port_.outcome = SendOutcome::down;
  EXPECT_EQ(run(patient_ns).kind, Ending::Kind::bus_down);
  port_.outcome = SendOutcome::queue_full;
  EXPECT_EQ(run(impatient_ns).kind, Ending::Kind::target_silent);
  port_.outcome = SendOutcome::sent;
  stop_ = true;
  EXPECT_EQ(run(patient_ns).kind, Ending::Kind::interrupted);
}

// The target answers every frame except the second. After the second frame, the bus accepts no frame for one
// and a half times the silence limit.
class Trouble : public RealTime {
 protected:
  static constexpr std::int64_t silence_limit_ns = 1'000'000'000;
  Ending run_with(
      SendOutcome trouble, const std::function<void()>& begin = [] {}) {
    port_.on_send = [&, trouble, begin](const Frame&) {
      if (port_.sent.size() == 2) {
        port_.trouble = trouble;
        port_.trouble_until_ns = clock_ns(CLOCK_MONOTONIC) + silence_limit_ns * 3 / 2;
        return begin();  // the target does not answer this frame
      }
      port_.give(TargetHeartbeat{.state = TargetState::running});
    };
    return run(silence_limit_ns);
  }
};

TEST_F(Trouble, AnInterfaceThatComesBackIsWaitedFor) {
  EXPECT_EQ(run_with(SendOutcome::down).kind, Ending::Kind::completed);
  EXPECT_EQ(port_.sent.size(), 6U) << "nothing was left out";
}

TEST_F(Trouble, ABusOffIsWaitedForToo) {
  const Ending ending = run_with(SendOutcome::queue_full,
                                 [&] { port_.give(Frame{.id = CAN_ERR_BUSOFF, .size = 8, .error = true}); });
  EXPECT_EQ(ending.kind, Ending::Kind::completed) << ending.detail;
  EXPECT_EQ(port_.sent.size(), 6U);
}

TEST_F(Trouble, AFullQueueIsNot) {
  const Ending ending = run_with(SendOutcome::queue_full);
  EXPECT_EQ(ending.kind, Ending::Kind::target_silent);
  EXPECT_THAT(ending.detail, testing::HasSubstr("the bus has accepted no frame since t="));
  EXPECT_THAT(ending.detail, testing::StartsWith("target silent since t=")) << "nor did it say anything";
}

TEST(LinkWaits, ForAnInterfaceThatIsAway) {
  FakePort port;
  Link link(port);
  port.trouble_until_ns = clock_ns(CLOCK_MONOTONIC) + 50'000'000;
  EXPECT_EQ(link.send({.id = 1}, 60'000'000'000), LinkState::up);
  port.trouble_until_ns = clock_ns(CLOCK_MONOTONIC) + 60'000'000'000;
  EXPECT_EQ(link.send({.id = 1}, 50'000'000), LinkState::down) << "but not for ever";
}

TEST(LateInQueue, CountsFramesThatWaitedBeyondTheirDeadline) {
  FakePort port;
  Link link(port);
  const auto now_ns = [] { return clock_ns(CLOCK_MONOTONIC); };
  constexpr std::int64_t patient_ns = 60'000'000'000;
  ASSERT_EQ(link.send({.id = 1}, patient_ns, now_ns() - 1'000'000'000), LinkState::up);
  EXPECT_EQ(link.late_in_queue(), 0U) << "late, but not for want of room";
  port.trouble = SendOutcome::queue_full;
  port.trouble_until_ns = now_ns() + 30'000'000;
  ASSERT_EQ(link.send({.id = 1}, patient_ns, now_ns()), LinkState::up);
  EXPECT_EQ(link.late_in_queue(), 1U);
  port.trouble_until_ns = now_ns() + 1'000'000;
  ASSERT_EQ(link.send({.id = 1}, patient_ns, now_ns() + 60'000'000'000), LinkState::up);
  EXPECT_EQ(link.late_in_queue(), 1U) << "it waited, and was in time";
  port.trouble_until_ns = now_ns() + 30'000'000;
  ASSERT_EQ(link.send({.id = 1}, patient_ns), LinkState::up);
  EXPECT_EQ(link.late_in_queue(), 1U) << "no deadline";
}

// Observes the lateness that the bench reports.
class Lateness final : public observe::Observer {
 public:
  void transmitted(const Frame&, std::int64_t, std::int64_t late_ns) override { late = late_ns; }
  std::int64_t late = -1;
};

TEST_F(RealTime, AFrameThatWaitedForRoomIsAsLateAsItWasSent) {
  Lateness lateness;
  Link link(port_);
  link.attach(lateness);
  const std::int64_t due_ns = clock_ns(CLOCK_MONOTONIC);
  port_.outcome = SendOutcome::queue_full;
  std::int64_t room_ns = 0;
  class OpenTheBus final : public observe::Observer {
   public:
    OpenTheBus(FakePort& port, std::int64_t& room_ns) : port_(port), room_ns_(room_ns) {}
    void received(const Received&) override {
      port_.outcome = SendOutcome::sent;
      room_ns_ = clock_ns(CLOCK_MONOTONIC);
    }

   private:
    FakePort& port_;
    std::int64_t& room_ns_;
  } opener(port_, room_ns);
  link.attach(opener);
  port_.give(Frame{.id = 1});  // received while the link waits for room
  ASSERT_EQ(link.send(Frame{.id = 2}, patient_ns, due_ns), LinkState::up);
  EXPECT_GE(lateness.late, room_ns - due_ns);
  ASSERT_EQ(link.send(Frame{.id = 2}, patient_ns), LinkState::up);
  EXPECT_EQ(lateness.late, 0) << "no deadline, no lateness";
}

}  // namespace
}  // namespace canhil::drive
