#include "bench/live/feed.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <thread>
#include <vector>

#ifndef CANHIL_SANITIZED  // a sanitizer has an allocator of its own
namespace {
thread_local std::size_t allocations = 0;
}
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
#endif

namespace canhil::live {
namespace {

class Seen final : public observe::Observer {
 public:
  void transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) override {
    sent.push_back(frame.id);
    last_ns = t_ns;
    last_late_ns = late_ns;
  }
  void received(const Received& received) override { answers.push_back(received.t_ns); }
  void time_set(std::int64_t t_ns) override { virtual_ns = t_ns; }
  std::vector<std::uint32_t> sent;
  std::vector<std::int64_t> answers;
  std::int64_t last_ns = 0, last_late_ns = 0, virtual_ns = 0;
};

TEST(LiveFeed, GivesWhatWasSeenInOrder) {
  Feed feed;
  feed.transmitted({.id = 1}, 10, 2);
  feed.received({.frame = {.id = 7}, .t_ns = 20});
  feed.time_set(30);
  feed.transmitted({.id = 2}, 40, 3);
  Seen seen;
  EXPECT_EQ(feed.drain(seen, {}), 4U);
  EXPECT_EQ(seen.sent, (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(seen.answers, std::vector<std::int64_t>{20});
  EXPECT_EQ(seen.virtual_ns, 30);
  EXPECT_EQ(seen.last_ns, 40);
  EXPECT_EQ(seen.last_late_ns, 3);
  EXPECT_EQ(feed.dropped(), 0U);
}

TEST(LiveFeed, DropsAndCountsWhatFindsNoRoom) {
  Feed feed(8);
  for (std::uint32_t id = 0; id < 20; ++id) feed.transmitted({.id = id}, 0, 0);
  EXPECT_EQ(feed.dropped(), 12U);
  Seen seen;
  EXPECT_EQ(feed.drain(seen, {}), 8U);
  EXPECT_EQ(seen.sent.back(), 7U);  // a full feed keeps its frames and drops new ones
  feed.transmitted({.id = 20}, 0, 0);
  EXPECT_EQ(feed.drain(seen, {}), 1U);
  EXPECT_EQ(feed.dropped(), 12U);
}

TEST(LiveFeed, CopiesTheRowsOfEachPlant) {
  std::vector<world::PlantRecord> flown, copies;
  for (auto* records : {&flown, &copies}) {
    records->emplace_back(std::vector<world::PlantRecord::Column>{{.name = "plant.a"}, {.name = "plant.b"}});
    records->emplace_back(std::vector<world::PlantRecord::Column>{{.name = "plant.c"}});
  }
  Feed feed;
  feed.follow({&flown[0], &flown[1]});
  for (const std::int64_t t_us : {0, 5000, 10'000}) {
    const auto t = static_cast<double>(t_us);
    flown[0].add(t_us, std::array{t, -t});
    if (t_us > 0) flown[1].add(t_us, std::array{2 * t});
    if (t_us == 10'000) flown[0].ended_us = t_us;
    feed.transmitted({}, t_us * 1000, 0);
  }
  Seen seen;
  feed.drain(seen, copies);
  for (std::size_t i = 0; i < flown.size(); ++i) {
    EXPECT_TRUE(std::ranges::equal(copies[i].times_us(), flown[i].times_us()));
    EXPECT_EQ(copies[i].ended_us, flown[i].ended_us);
    for (std::size_t column = 0; column < flown[i].columns().size(); ++column)
      EXPECT_EQ(copies[i].value(column, 1), flown[i].value(column, 1));
  }
}

#ifndef CANHIL_SANITIZED
TEST(LiveFeed, DoesNotAllocateWhereTheFlightIs) {
  Feed feed(64);
  const Received answer{.frame = {.id = 3, .size = 8}, .t_ns = 1};
  const std::size_t before = allocations;
  for (int i = 0; i < 200; ++i) {  // first with room, then with a full feed
    feed.transmitted({.id = 1}, i, 0);
    feed.received(answer);
    feed.time_set(i);
  }
  EXPECT_EQ(allocations, before);
  EXPECT_GT(feed.dropped(), 0U);
}
#endif

TEST(LiveFeed, LosesNothingUncountedBetweenTwoThreads) {
  constexpr std::uint32_t frames = 100'000;
  Feed feed(256);
  Seen seen;
  std::atomic<bool> over = false;
  std::thread reader([&] {
    while (!over) feed.drain(seen, {});
    feed.drain(seen, {});
  });
  for (std::uint32_t id = 0; id < frames; ++id) feed.transmitted({.id = id}, id, 0);
  over = true;
  reader.join();
  EXPECT_EQ(seen.sent.size() + feed.dropped(), frames);
  EXPECT_TRUE(std::ranges::is_sorted(seen.sent));
  EXPECT_GT(seen.sent.size(), 0U);
}

}  // namespace
}  // namespace canhil::live
