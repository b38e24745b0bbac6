// As wind_test.cpp, of the in-flight alignment.
#include "tests/papers/bars.hpp"

namespace canhil::papers {
namespace {

TEST(Honesty, OfTheInflightAlignment) {
  expect_bars_met("bench/monte_carlo/honesty/inflight_alignment.toml", 104, 40);
}

}  // namespace
}  // namespace canhil::papers
