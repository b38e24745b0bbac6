// What `hil-bench doctor` measures, and how it judges a machine.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include "bench/doctor/jitter.hpp"
#include "bench/doctor/listen.hpp"
#include "bench/doctor/loop.hpp"
#include "bench/doctor/machine_lines.hpp"
#include "dbc/ports/local_bus.hpp"
#include "dbc/wire/transmit.hpp"
#include "messages/canhil.hpp"

namespace canhil::doctor {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

bool never() { return false; }
bool always() { return true; }

std::vector<Grade> grades(const std::vector<Line>& lines) {
  std::vector<Grade> found;
  for (const Line& line : lines) {
    found.push_back(line.grade);
    EXPECT_EQ(line.remedy.empty(), line.grade == Grade::good) << line.subject;
  }
  return found;
}

TEST(MachineLines, AreGoodOnAMachineMadeForIt) {
  const Machine made{.preemption = "PREEMPT_RT",
                     .refusal = "",
                     .governors = {"performance"},
                     .cpus = {0, 1},
                     .isolated = "1"};
  EXPECT_THAT(grades(machine_lines(made)), ElementsAre(Grade::good, Grade::good, Grade::good, Grade::good));
}

TEST(MachineLines, NameEachLackWithItsRemedy) {
  const Machine poor{.preemption = "PREEMPT_DYNAMIC",
                     .refusal = "--realtime: the limit is 0: add a line to a file",
                     .governors = {"powersave"},
                     .cpus = {3},
                     .isolated = ""};
  const std::vector<Line> lines = machine_lines(poor);
  EXPECT_THAT(grades(lines), ElementsAre(Grade::weak, Grade::weak, Grade::weak, Grade::weak));
  EXPECT_EQ(lines[1].found, "the limit is 0");
  EXPECT_EQ(lines[1].remedy, "add a line to a file");
  EXPECT_THAT(lines[2].remedy, HasSubstr("cpupower frequency-set -g performance"));
  EXPECT_EQ(worst(lines), Grade::weak);
}

TEST(Jitter, IsTakenOnceAPeriodAndNeverEarly) {
  const std::vector<double> late_s = measure_jitter(50 * jitter_period_ns, never);
  EXPECT_GE(late_s.size(), 1U);
  EXPECT_LE(late_s.size(), 50U);
  for (const double late : late_s) EXPECT_GE(late, 0);
  EXPECT_TRUE(measure_jitter(50 * jitter_period_ns, always).empty());
}

TEST(Jitter, IsGradedByItsQuantileAndItsMaximum) {
  const auto grade = [](double most_s, double once_s) {
    std::vector<double> late_s(999, most_s);
    late_s.push_back(once_s);
    return jitter_line(late_s, "test").grade;
  };
  EXPECT_EQ(grade(50e-6, 200e-6), Grade::good);
  EXPECT_EQ(grade(50e-6, 2e-3), Grade::weak);
  EXPECT_EQ(grade(200e-6, 200e-6), Grade::weak);
  EXPECT_EQ(grade(2e-3, 2e-3), Grade::bad);
  EXPECT_EQ(jitter_line({}, "test").grade, Grade::weak);
  EXPECT_EQ(jitter_line({10e-6, 30e-6}, "SCHED_FIFO 40").found,
            "min 10 avg 20 p99 30 max 30 us of 2 wake-ups (SCHED_FIFO 40)");
}

class OnABus : public testing::Test {
 protected:
  void SetUp() override {
    auto hosted = host_local_bus(bus_, {});
    ASSERT_TRUE(hosted) << hosted.error().message;
    hub_ = std::move(*hosted);
    auto joined = join_local_bus(bus_, {});
    ASSERT_TRUE(joined) << joined.error().message;
    node_ = std::move(*joined);
    for (int look = 0; look < 10; ++look) hub_->receive();
  }
  const std::string bus_ = fmt::format("local:doctor-{}", getpid());
  std::unique_ptr<LocalHub> hub_;
  std::unique_ptr<Port> node_;
};

TEST_F(OnABus, TheLoopComesBack) {
  const LoopResult result = measure_loop(*hub_, *node_, 50, never);
  EXPECT_EQ(result.sent, 50);
  EXPECT_EQ(result.lost, 0);
  EXPECT_EQ(result.round_trip_s.size(), 50U);
  EXPECT_NE(loop_line(result, "a", "b").grade, Grade::bad);
  EXPECT_EQ(measure_loop(*hub_, *node_, 50, always).sent, 0);
}

TEST_F(OnABus, TheFramesOfTheLoopAreNoneOfTheDbc) {
  auto third = join_local_bus(bus_, {});
  ASSERT_TRUE(third);
  ASSERT_EQ(measure_loop(*hub_, *node_, 1, never).lost, 0);
  int seen = 0;
  while (const auto received = (*third)->receive()) {
    EXPECT_EQ(messages::find_message(received->frame.id), nullptr) << received->frame.id;
    ++seen;
  }
  EXPECT_EQ(seen, 2);
}

// Forwards frames to another port, but loses some of them.
class LossyPort final : public Port {
 public:
  LossyPort(Port& port, int loses_every) : port_(port), loses_every_(loses_every) {}
  SendOutcome send(const Frame& frame) override {
    return ++sent_ % loses_every_ == 0 ? SendOutcome::sent : port_.send(frame);
  }
  std::optional<Received> receive() override { return port_.receive(); }
  [[nodiscard]] int descriptor() const override { return port_.descriptor(); }
  [[nodiscard]] RoomWait room_wait() const override { return port_.room_wait(); }
  [[nodiscard]] bool closed() const override { return port_.closed(); }
  [[nodiscard]] PortCounters counters() const override { return port_.counters(); }
  [[nodiscard]] int stamp_clock() const override { return port_.stamp_clock(); }
  [[nodiscard]] const std::string& name() const override { return port_.name(); }

 private:
  Port& port_;
  int loses_every_;
  int sent_ = 0;
};

TEST_F(OnABus, LostFramesAreCountedAndBad) {
  LossyPort lossy(*hub_, 5);
  const LoopResult some = measure_loop(lossy, *node_, 10, never);
  EXPECT_EQ(some.lost, 2);
  EXPECT_EQ(some.round_trip_s.size(), 8U);
  EXPECT_EQ(loop_line(some, "a", "b").grade, Grade::bad);
  EXPECT_THAT(loop_line(some, "a", "b").found, HasSubstr("2 of 10 frames lost"));
  LossyPort cut(*hub_, 1);
  const LoopResult none = measure_loop(cut, *node_, 1000, never);
  EXPECT_EQ(none.sent, 10) << "given up";
  EXPECT_THAT(loop_line(none, "a", "b").found, HasSubstr("none of 10 frames came back"));
}

TEST(LoopLine, IsGradedByItsQuantile) {
  const auto grade = [](double round_trip_s) {
    return loop_line({.sent = 1, .lost = 0, .round_trip_s = {round_trip_s}}, "a", "b").grade;
  };
  EXPECT_EQ(grade(0.5e-3), Grade::good);
  EXPECT_EQ(grade(4e-3), Grade::weak);
  EXPECT_EQ(grade(11e-3), Grade::bad);
}

std::vector<Line> heard(Port& hub, Port& node, const Frame& frame) {
  EXPECT_EQ(hub.send(frame), SendOutcome::sent);
  return listen(node, 20'000'000, never);
}

Frame heartbeat(std::uint32_t hash) {
  Outbox<1> out;
  out.send(messages::TargetHeartbeat{.dbc_hash = hash});
  return out.frames().front();
}

TEST_F(OnABus, ATargetIsKnownByItsHeartbeatAndItsHash) {
  EXPECT_THAT(grades(listen(*node_, 1'000'000, never)), ElementsAre(Grade::good, Grade::weak));
  EXPECT_THAT(grades(heard(*hub_, *node_, heartbeat(messages::exchange_hash24()))),
              ElementsAre(Grade::good, Grade::good));
  const std::vector<Line> other = heard(*hub_, *node_, heartbeat(messages::exchange_hash24() ^ 1U));
  EXPECT_THAT(grades(other), ElementsAre(Grade::good, Grade::bad));
  EXPECT_THAT(other.back().remedy, HasSubstr("from the same DBC"));
}

TEST_F(OnABus, ErrorFramesAreWeakAndNoHeartbeat) {
  Frame error = heartbeat(messages::exchange_hash24());
  error.error = true;
  const std::vector<Line> lines = heard(*hub_, *node_, error);
  EXPECT_THAT(grades(lines), ElementsAre(Grade::weak, Grade::weak));
  EXPECT_THAT(lines.front().found, HasSubstr("1 error frames"));
}

}  // namespace
}  // namespace canhil::doctor
