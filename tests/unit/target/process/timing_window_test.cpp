// The times that the target measures and reports.
#include "target/process/timing_window.hpp"

#include <gtest/gtest.h>

namespace canhil::target {
namespace {

TEST(TimingWindow, HasMeanAndLargestOfEachWindow) {
  TimingWindow window;
  window.add(10'000, 2'000);
  window.add(30'400, 7'600);
  const messages::TargetTiming reported = window.take();
  EXPECT_EQ(reported.queue_max_us, 30);
  EXPECT_EQ(reported.queue_mean_us, 20);
  EXPECT_EQ(reported.compute_max_us, 8);
  EXPECT_EQ(reported.compute_mean_us, 5);
  EXPECT_EQ(window.take().queue_max_us, 0) << "a new window";
}

TEST(TimingWindow, SaturatesAsTheMessageDoes) {
  TimingWindow window;
  window.add(20'000'000, -5'000);  // as after a change of the clock
  const messages::TargetTiming reported = window.take();
  EXPECT_EQ(reported.queue_max_us, 8191);
  EXPECT_EQ(reported.queue_mean_us, 8191);
  EXPECT_EQ(reported.compute_max_us, 0);
  EXPECT_EQ(reported.compute_mean_us, 0);
}

}  // namespace
}  // namespace canhil::target
