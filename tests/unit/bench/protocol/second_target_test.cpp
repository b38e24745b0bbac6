// Detects two targets on one bus, and does not mistake one target for two.
#include "bench/protocol/second_target.hpp"
#include "bench/protocol/contract_watch.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <optional>
#include <utility>
#include <vector>

#include "bench/drive/lockstep.hpp"
#include "bench/drive/real_time.hpp"
#include "bench/nodes/time_keeper.hpp"
#include "target/device/device.hpp"
#include "tests/unit/bench/drive/fake_port.hpp"

namespace canhil::protocol {
namespace {

using namespace drive;

using messages::TargetHeartbeat;

constexpr std::int64_t cycle_ns = TargetHeartbeat::info.cycle_time_us * 1000;

// Passes frames of targets to the watch. The frames of a target are recognised only by their counter.
class Watch : public testing::Test {
 protected:
  template <class Message = TargetHeartbeat>
  void hear(int counter, std::int64_t t_ns) {
    Outbox<1> out;
    out.send(Message{});
    Frame frame = out.frames().front();
    e2e::protect(std::span(frame.data).first(frame.size), Message::info.e2e_data_id,
                 static_cast<std::uint8_t>(counter % e2e::counter_period));
    watch_->received({.frame = frame, .t_ns = t_ns});
  }
  std::optional<SecondTarget> watch_{std::in_place};
};

TEST_F(Watch, FindsTwoWhateverTheirCounters) {
  for (int apart = 0; apart < e2e::counter_period; ++apart) {
    watch_.emplace();
    for (int cycle = 0; cycle < 10; ++cycle) {
      hear(cycle, cycle * cycle_ns);
      hear(cycle + apart, cycle * cycle_ns + cycle_ns / 3);
    }
    EXPECT_TRUE(watch_->found()) << apart;
  }
}

TEST_F(Watch, FindsTwoThatAccountForThemselves) {
  for (int cycle = 0; cycle < 10; ++cycle) {
    hear<messages::TargetTiming>(cycle, cycle * cycle_ns);
    hear<messages::TargetTiming>(cycle + 5, cycle * cycle_ns + cycle_ns / 3);
  }
  EXPECT_TRUE(watch_->found());
  watch_.emplace();
  for (int cycle = 0; cycle < 10; ++cycle) {
    hear<messages::TargetCounters>(cycle, cycle * cycle_ns);
    hear<messages::TargetTiming>(cycle + 5, cycle * cycle_ns);
  }
  EXPECT_FALSE(watch_->found());
  for (int cycle = 10; cycle < 20; ++cycle) {
    hear<messages::TargetCounters>(cycle, cycle * cycle_ns);
    hear<messages::TargetCounters>(cycle + 5, cycle * cycle_ns + cycle_ns / 3);
  }
  EXPECT_TRUE(watch_->found());
}

TEST_F(Watch, FindsTwoThatRunFourEstimatorsEach) {
  for (int apart = 0; apart < e2e::counter_period; ++apart) {
    watch_.emplace();
    for (int cycle = 0; cycle < 20; ++cycle) {
      for (int estimator = 0; estimator < 4; ++estimator) hear(4 * cycle + estimator, cycle * cycle_ns);
      for (int estimator = 0; estimator < 4; ++estimator)
        hear(4 * cycle + estimator + apart, cycle * cycle_ns + cycle_ns / 3);
    }
    EXPECT_TRUE(watch_->found()) << apart;
  }
}

TEST_F(Watch, OneThatLosesFramesIsOne) {
  for (int lost = 0; lost < 3 * e2e::counter_period; ++lost) {
    watch_.emplace();
    for (int n = 0, counter = 0; n < 100; ++n, counter += n % 3 == 0 ? 1 + lost : 1)
      hear(counter, counter * cycle_ns);
    EXPECT_FALSE(watch_->found()) << lost << " in a row";
  }
}

TEST_F(Watch, OneWhoseCounterStandsStillIsOne) {
  for (int n = 0; n < 100; ++n) hear(7, n * cycle_ns);
  EXPECT_FALSE(watch_->found());
}

TEST_F(Watch, OneThatCountsAnewAfterEachCommandIsOne) {
  Outbox<1> out;
  out.send(messages::TargetCommand{});
  for (int n = 0; n < 100; ++n) {
    watch_->transmitted(out.frames().front(), 0, 0);
    for (int counter = 0; counter < n % 4; ++counter) hear(counter, n);
  }
  EXPECT_FALSE(watch_->found());
}

// Each target is a real Device that receives the frames of the bench.
class Targets : public testing::Test {
 protected:
  explicit Targets(int count = 2) : devices_(static_cast<std::size_t>(count)) {
    port_.on_send = [this](const Frame& frame) {
      for (target::Device& device : devices_) {
        for (const Frame& answer : device.receive(frame)) port_.give(answer);
      }
    };
  }
  Ending lockstep() {
    Link link(port_);
    Schedule schedule({}, std::make_unique<nodes::TimeKeeper>(2'000'000, true));
    protocol::ContractWatch watch;
    return run_lockstep(link, schedule, watch, 5'000'000'000, stop_, [](std::int64_t) {});
  }
  Ending real_time() {
    Link link(port_);
    Schedule schedule({}, std::make_unique<nodes::TimeKeeper>(2'000'000, false));
    protocol::ContractWatch watch;
    return run_real_time(link, schedule, watch, 5'000'000'000, stop_, [](std::int64_t) {});
  }
  FakePort port_;
  std::vector<target::Device> devices_;
  std::atomic<bool> stop_ = false;
};

class OneTarget : public Targets {
 protected:
  OneTarget() : Targets(1) {}
};

TEST_F(Targets, EndARunInLockstep) {
  const Ending ending = lockstep();
  EXPECT_EQ(ending.kind, Ending::Kind::target_fault);
  EXPECT_EQ(ending.detail, "a second target answers on this bus");
}

TEST_F(Targets, EndARunInRealTime) {
  const Ending ending = real_time();
  EXPECT_EQ(ending.kind, Ending::Kind::target_fault);
  EXPECT_EQ(ending.detail, "a second target answers on this bus");
}

TEST_F(OneTarget, IsOne) {
  EXPECT_EQ(lockstep().kind, Ending::Kind::completed);
  EXPECT_EQ(real_time().kind, Ending::Kind::completed);
}

}  // namespace
}  // namespace canhil::protocol
