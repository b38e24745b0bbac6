#include "bench/plant/glide/wind.hpp"

#include <gtest/gtest.h>

#include "bench/world/units.hpp"

namespace canhil::plant::glide {
namespace {

using world::units::deg;

TEST(WindProfile, IsTheTableAtItsLevels) {
  const WindProfile march(Season::march);
  const double from = 264 * deg;
  EXPECT_LT((march.at(10'000) - 58 * Vector3(-std::cos(from), -std::sin(from), 0)).norm(), 1e-12);
  EXPECT_NEAR(march.at(10'000).x(), 6.06265, 1e-5);  // the first row of the published run
  EXPECT_NEAR(march.at(10'000).y(), 57.68227, 1e-5);
  EXPECT_NEAR(WindProfile(Season::june).at(0).norm(), 2, 1e-12);
  EXPECT_NEAR(WindProfile(Season::september).at(15'000).norm(), 9, 1e-12);
  EXPECT_NEAR(WindProfile(Season::december).at(11'000).norm(), 70, 1e-12);
  EXPECT_GT(WindProfile(Season::december).at(11'000).y(), 69);  // from the west
}

TEST(WindProfile, JoinsComponentsByLines) {
  const WindProfile september(Season::september);
  for (int km = 0; km < 15; ++km) {
    const double h = 1000.0 * km;
    EXPECT_LT((september.at(h + 250) - 0.75 * september.at(h) - 0.25 * september.at(h + 1000)).norm(), 1e-12);
  }
  EXPECT_EQ(september.at(-10), september.at(0));
  EXPECT_EQ(september.at(20'000), september.at(15'000));
}

TEST(Gusts, HaveTheirSigmaAndTheirTime) {
  Gusts gusts({.sigma = 2, .time = 3}, Stream(1, 2, "gusts"));
  constexpr int count = 200'000;
  constexpr int lag = 30;  // 3 s
  std::vector<double> north;
  for (int i = 0; i < count; ++i) {
    north.push_back(gusts.now().x());
    gusts.advance(0.1);
  }
  double power = 0;
  double product = 0;
  for (int i = 0; i + lag < count; ++i) {
    power += north[i] * north[i] / (count - lag);
    product += north[i] * north[i + lag] / (count - lag);
  }
  // The series lasts 6667 correlation times. One standard error of the mean square is sigma^2 sqrt(2 / 6667),
  // 1.7 % of sigma^2; the limits are about five standard errors.
  EXPECT_NEAR(power, 4, 0.4);
  EXPECT_NEAR(product / power, std::exp(-1), 0.06);
}

TEST(Gusts, NoneWithoutSigma) {
  Gusts none({}, Stream(1, 2, "gusts"));
  none.advance(0.01);
  EXPECT_TRUE(none.now().isZero());
}

}  // namespace
}  // namespace canhil::plant::glide
