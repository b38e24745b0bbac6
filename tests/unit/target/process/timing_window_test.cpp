#include "target/process/timing_window.hpp"

#include <gtest/gtest.h>

namespace canhil::target {
namespace {

TEST(TimingWindow, TakesTheWaitOfEveryFrameAndTheTimeOfThoseAnswered) {
  TimingWindow window;
  window.waited(10'000);
  window.waited(30'000);
  window.computed(500'000);
  window.waited(20'000);
  window.computed(100'000);
  const messages::TargetTiming message = window.take();
  EXPECT_EQ(message.queue_max_us, 30);
  EXPECT_EQ(message.queue_mean_us, 20);
  EXPECT_EQ(message.compute_max_us, 500);
  EXPECT_EQ(message.compute_mean_us, 300);
  const messages::TargetTiming empty = window.take();
  EXPECT_EQ(empty.queue_max_us, 0);
  EXPECT_EQ(empty.compute_mean_us, 0);
}

TEST(TimingWindow, SaturatesWhereTheMessageDoesAndTakesNoTimeBelowZero) {
  TimingWindow window;
  window.waited(-5'000'000);
  window.computed(9'000'000);
  const messages::TargetTiming message = window.take();
  EXPECT_EQ(message.queue_mean_us, 0);
  EXPECT_EQ(message.compute_max_us, 8191);
}

}  // namespace
}  // namespace canhil::target
