#include "bench/drive/schedule.hpp"

#include <gmock/gmock.h>

#include "messages/canhil.hpp"

namespace canhil::drive {
namespace {

using messages::ParamSet;
using messages::StepDone;
using messages::Sync;

// Sends one message every period, up to an end.
template <class Message>
class Periodic final : public nodes::Node {
 public:
  Periodic(std::int64_t first_us, std::int64_t period_us, std::int64_t end_us)
      : due_us_(first_us), period_us_(period_us), end_us_(end_us) {}
  [[nodiscard]] std::int64_t due_us() const override { return due_us_ > end_us_ ? nodes::never_us : due_us_; }
  void transmit(nodes::Transmission& out) override {
    out.send(Message{});
    due_us_ += period_us_;
  }

 private:
  std::int64_t due_us_;
  std::int64_t period_us_;
  std::int64_t end_us_;
};

TEST(Schedule, GoesByTimeAndAmongEqualsByPrecedenceWithTheKeeperLast) {
  std::vector<std::unique_ptr<nodes::Node>> sensors;
  sensors.push_back(std::make_unique<Periodic<ParamSet>>(10, 10, 30));
  sensors.push_back(std::make_unique<Periodic<StepDone>>(15, 15, 30));
  Schedule schedule(std::move(sensors), std::make_unique<Periodic<Sync>>(0, 10, 30));
  std::vector<std::pair<std::int64_t, std::uint32_t>> order;
  while (schedule.due_us() != nodes::never_us) {
    const std::int64_t due_us = schedule.due_us();
    const auto frames = schedule.take();
    ASSERT_EQ(frames.size(), 1U);
    order.emplace_back(due_us, frames.front().id);
  }
  const auto first = ParamSet::info.id;
  const auto second = StepDone::info.id;
  const auto keeper = Sync::info.id;
  using testing::Pair;
  EXPECT_THAT(order, testing::ElementsAre(Pair(0, keeper), Pair(10, first), Pair(10, keeper),
                                          Pair(15, second), Pair(20, first), Pair(20, keeper),
                                          Pair(30, first), Pair(30, second), Pair(30, keeper)));
}

TEST(Schedule, CountersGoOnFromFrameToFrame) {
  Schedule schedule({}, std::make_unique<Periodic<Sync>>(0, 10, 200));
  for (int k = 0; k < 20; ++k) EXPECT_EQ(e2e::counter(schedule.take().front().payload()), k % 15);
}

}  // namespace
}  // namespace canhil::drive
