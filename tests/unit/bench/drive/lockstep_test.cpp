#include "bench/drive/lockstep.hpp"
#include "bench/protocol/contract_watch.hpp"

#include <gmock/gmock.h>

#include "bench/nodes/time_keeper.hpp"
#include "tests/unit/bench/drive/fake_port.hpp"

namespace canhil::drive {
namespace {

using messages::StepDone;
using messages::Sync;

class Lockstep : public testing::Test {
 protected:
  Ending run(std::int64_t step_limit_ns = 50'000'000) {
    Link link(port_);
    Schedule schedule({}, std::make_unique<nodes::TimeKeeper>(50'000, true));
    protocol::ContractWatch watch;
    return run_lockstep(link, schedule, watch, step_limit_ns, stop_, [](std::int64_t) {});
  }
  static std::uint16_t step_of(const Frame& frame) { return from_frame<Sync>(frame).step; }

  FakePort port_;
  std::atomic<bool> stop_ = false;
};

TEST_F(Lockstep, RunsToTheEndAsTheTargetAnswers) {
  port_.on_send = [&](const Frame& frame) { port_.give(StepDone{.step = step_of(frame)}); };
  const Ending ending = run();
  EXPECT_EQ(ending.kind, Ending::Kind::completed) << ending.detail;
  EXPECT_EQ(ending.t_us, 50'000);
  EXPECT_EQ(port_.sent.size(), 6U);
}

TEST_F(Lockstep, NamesTheStepThatWasNotAnswered) {
  port_.on_send = [&](const Frame& frame) {
    if (step_of(frame) < 3) port_.give(StepDone{.step = step_of(frame)});
  };
  const Ending ending = run();
  EXPECT_EQ(ending.kind, Ending::Kind::target_silent);
  EXPECT_EQ(ending.t_us, 30'000);
  EXPECT_THAT(ending.detail, testing::HasSubstr("step 3 was not answered"));
  EXPECT_EQ(port_.sent.size(), 4U) << "the next step must not open";
}

TEST_F(Lockstep, TheAnswerToAnotherStepIsNone) {
  port_.on_send = [&](const Frame& frame) {
    port_.give(StepDone{.step = static_cast<std::uint16_t>(step_of(frame) + 1)});
  };
  EXPECT_EQ(run().kind, Ending::Kind::target_silent);
  EXPECT_EQ(port_.sent.size(), 1U);
}

TEST_F(Lockstep, ABrokenAnswerOrAnErrorFrameIsNone) {
  port_.on_send = [&](const Frame& frame) {
    port_.target.clear();
    port_.target.send(StepDone{.step = step_of(frame)});
    Frame broken = port_.target.frames().front();
    broken.data[0] ^= 1U;
    port_.give(broken);
    Frame error = port_.target.frames().front();
    error.error = true;
    port_.give(error);
  };
  EXPECT_EQ(run().kind, Ending::Kind::target_silent);
}

TEST_F(Lockstep, EndsWithAFaultOfTheTarget) {
  port_.on_send = [&](const Frame& frame) {
    if (step_of(frame) == 2) port_.give(messages::TargetHeartbeat{.state = messages::TargetState::fault});
    port_.give(StepDone{.step = step_of(frame)});
  };
  const Ending ending = run();
  EXPECT_EQ(ending.kind, Ending::Kind::target_fault);
  EXPECT_EQ(ending.t_us, 20'000);
}

TEST_F(Lockstep, EndsWhenTheBusIsDownOrTheUserSaysSo) {
  port_.outcome = SendOutcome::down;
  EXPECT_EQ(run().kind, Ending::Kind::bus_down);
  port_.outcome = SendOutcome::sent;
  stop_ = true;
  EXPECT_EQ(run().kind, Ending::Kind::interrupted);
}

}  // namespace
}  // namespace canhil::drive
