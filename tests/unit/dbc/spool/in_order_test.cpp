// A series whose items came out of order.
#include "dbc/spool/in_order.hpp"

#include <gmock/gmock.h>

#include <random>

namespace canhil {
namespace {

struct Item {
  std::int64_t t_us = 0;
  std::int64_t number = 0;  // in order of arrival
  double more[14] = {};
  bool operator==(const Item& other) const { return t_us == other.t_us && number == other.number; }
};

// Items of which each `late`-th is late by up to `by` items; some have the same time.
std::vector<Item> arrived(std::size_t count, std::size_t late, std::int64_t by) {
  std::mt19937 random(count + late);
  std::vector<Item> items(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto now = static_cast<std::int64_t>(i / 2);
    const std::int64_t age = i % late == 0 ? std::uniform_int_distribution<std::int64_t>(0, by)(random) : 0;
    items[i] = {.t_us = now - age, .number = static_cast<std::int64_t>(i)};
  }
  return items;
}

void expect_sorted(std::vector<Item> items) {
  const TimeOrdered<Item, &Item::t_us> series(items);
  std::ranges::stable_sort(items, {}, &Item::t_us);
  ASSERT_EQ(series.size(), items.size());
  EXPECT_TRUE(std::ranges::equal(series, items));
}

TEST(InOrder, EachItemIsWhereAStableSortPutsIt) {
  for (const std::size_t count : {0, 1, 2, 3, 1000}) {
    for (const std::size_t late : {1, 2, 7, 5000}) expect_sorted(arrived(count, late, 50));
  }
}

TEST(InOrder, ASeriesThatWasReadMayGrow) {
  TimeOrdered<Item, &Item::t_us> series;
  EXPECT_EQ(series.latest(), std::nullopt);
  for (const std::int64_t t_us : {5, 3, 4}) series.push_back({.t_us = t_us});
  EXPECT_EQ(series.front().t_us, 3);
  for (const std::int64_t t_us : {1, 6, 2}) series.push_back({.t_us = t_us});
  EXPECT_EQ(series.latest(), 6);
  std::vector<std::int64_t> times;
  for (const Item& item : series) times.push_back(item.t_us);
  EXPECT_THAT(times, testing::ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST(InOrder, AlsoIfTheSeriesDoesNotFitIntoMemory) {
  constexpr std::size_t many = 3 * Spool<Item>::most_in_memory + 17;
  expect_sorted(arrived(many, 1000, 20));
  expect_sorted(arrived(many, 2, many));  // every second item belongs anywhere
}

}  // namespace
}  // namespace canhil
