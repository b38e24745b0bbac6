// What is recommended beyond the papers says how well it knows: the campaigns of bench/monte_carlo/honesty,
// which are judged with 200 runs, with as many as CTest has time for.
#include "tests/papers/bars.hpp"

namespace canhil::papers {
namespace {

TEST(Honesty, OfTheWind) { expect_bars_met("bench/monte_carlo/honesty/wind.toml", 17, 24); }

}  // namespace
}  // namespace canhil::papers
