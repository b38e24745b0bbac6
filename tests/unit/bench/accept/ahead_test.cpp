#include "bench/accept/ahead.hpp"

#include <gtest/gtest.h>

#include <array>
#include <barrier>

namespace canhil::accept {
namespace {

constexpr std::chrono::milliseconds a_moment(2);
using Numbers = Ahead<int, int>;

class AheadOfTheCaller : public testing::Test {
 protected:
  std::vector<const int*> tasks(std::size_t count) {
    std::vector<const int*> them;
    for (std::size_t i = 0; i < count; ++i) them.push_back(&numbers_.at(i));
    return them;
  }
  static int wait_for_stop(const int& task, const std::atomic<bool>& stop) {
    while (!stop) std::this_thread::sleep_for(a_moment);
    return task;
  }

  std::array<int, 5> numbers_{0, 1, 2, 3, 4};
  std::atomic<bool> stop_ = false;
};

TEST_F(AheadOfTheCaller, TheFirstTaskIsSlowAndItsResultComesFirst) {
  const auto uneven = [](const int& task, const std::atomic<bool>&) {
    if (task == 0) std::this_thread::sleep_for(20 * a_moment);
    return task;
  };
  Numbers ahead(tasks(5), 4, uneven, stop_);
  for (const int number : numbers_) EXPECT_EQ(ahead.next(), number);
}

TEST_F(AheadOfTheCaller, TwoThreadsWorkAtTheSameTime) {
  std::barrier both(2);  // a task alone would wait for ever
  const auto meet = [&](const int& task, const std::atomic<bool>&) {
    both.arrive_and_wait();
    return task;
  };
  Numbers ahead(tasks(2), 2, meet, stop_);
  EXPECT_EQ(ahead.next(), 0);
  EXPECT_EQ(ahead.next(), 1);
}

TEST_F(AheadOfTheCaller, OneThreadWorksOnOneTaskAtATime) {
  std::atomic<int> at_work = 0, most = 0;
  const auto alone = [&](const int& task, const std::atomic<bool>&) {
    most = std::max<int>(most, ++at_work);
    std::this_thread::sleep_for(a_moment);
    --at_work;
    return task;
  };
  Numbers ahead(tasks(5), 1, alone, stop_);
  for (const int number : numbers_) EXPECT_EQ(ahead.next(), number);
  EXPECT_EQ(most, 1);
}

TEST_F(AheadOfTheCaller, TasksWhoseResultsNobodyTakesAreStopped) {
  std::atomic<int> stopped = 0;
  const auto count = [&](const int& task, const std::atomic<bool>& stop) {
    ++stopped;
    return wait_for_stop(task, stop);
  };
  {
    const Numbers ahead(tasks(5), 2, count, stop_);
    while (stopped < 2) std::this_thread::sleep_for(a_moment);
  }
  EXPECT_EQ(stopped, 2);
}

TEST_F(AheadOfTheCaller, AStopReachesTheTaskThatTheCallerWaitsFor) {
  Numbers ahead(tasks(1), 1, wait_for_stop, stop_);
  stop_ = true;
  EXPECT_EQ(ahead.next(), 0);
}

}  // namespace
}  // namespace canhil::accept
