// Delta debugging: the smallest set of elements that still shows a violation.
#include "bench/campaign/matrix/delta.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <numeric>

namespace canhil::campaign::matrix {
namespace {

using testing::ElementsAre;
using testing::Pair;

std::vector<int> numbers(int count) {
  std::vector<int> all(static_cast<std::size_t>(count));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

// A violation that appears if all of the needed elements are present.
std::function<bool(const std::vector<int>&)> with(std::vector<int> needed, int& flights) {
  return [needed = std::move(needed), &flights](const std::vector<int>& items) {
    ++flights;
    return std::ranges::all_of(needed, [&](int one) { return std::ranges::find(items, one) != items.end(); });
  };
}

TEST(LeastOf, LeavesWhatIsNeeded) {
  int flights = 0;
  for (int one = 0; one < 9; ++one)
    EXPECT_THAT(least_of<int>(numbers(9), with({one}, flights)), ElementsAre(one));
  EXPECT_THAT(least_of<int>(numbers(20), with({3, 17}, flights)), ElementsAre(3, 17));
  EXPECT_THAT(least_of<int>(numbers(7), with({0, 3, 6}, flights)), ElementsAre(0, 3, 6));
  EXPECT_THAT(least_of<int>(numbers(3), with({0, 1, 2}, flights)), ElementsAre(0, 1, 2));
  EXPECT_THAT(least_of<int>({5}, with({5}, flights)), ElementsAre(5));
}

TEST(LeastOf, FindsOneOfManyInAFewFlights) {
  int flights = 0;
  EXPECT_THAT(least_of<int>(numbers(64), with({40}, flights)), ElementsAre(40));
  EXPECT_LE(flights, 2 * 6) << "by halves";
}

TEST(LeastStretch, CutsBothEnds) {
  const auto covers = [](std::int64_t first, std::int64_t last) {
    return [=](std::int64_t from, std::int64_t to) { return from <= first && to >= last; };
  };
  EXPECT_THAT(least_stretch(0, 1000, 10, covers(400, 400)), Pair(400, 400));
  EXPECT_THAT(least_stretch(0, 1000, 10, covers(120, 730)), Pair(120, 730));
  EXPECT_THAT(least_stretch(0, 1000, 10, covers(0, 1000)), Pair(0, 1000));
  EXPECT_THAT(least_stretch(5, 8, 10, covers(5, 8)), Pair(5, 8)) << "less than a step";
  const auto [from, to] = least_stretch(7, 1000, 10, covers(401, 403));
  EXPECT_GT(from + 10, 401);
  EXPECT_LT(to - 10, 403);
}

}  // namespace
}  // namespace canhil::campaign::matrix
