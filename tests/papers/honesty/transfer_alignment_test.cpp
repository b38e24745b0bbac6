// As wind_test.cpp, of the transfer alignment.
#include "tests/papers/bars.hpp"

namespace canhil::papers {
namespace {

TEST(Honesty, OfTheTransferAlignment) {
  expect_bars_met("bench/monte_carlo/honesty/transfer_alignment.toml", 61, 100);
}

}  // namespace
}  // namespace canhil::papers
