#include "target/estimators/strapdown/earth.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace canhil::strapdown {
namespace {

// The values are from NIMA TR8350.2 (2000), tables 3.1 to 3.4.
TEST(Earth, RadiiAndGravityAreThoseOfWgs84) {
  const LocalEarth equator = local_earth(0, 0);
  EXPECT_NEAR(equator.transverse_radius, 6378137.0, 1e-9);
  EXPECT_NEAR(equator.meridian_radius, 6335439.3273, 1e-4);
  EXPECT_NEAR(equator.gravity, 9.7803253359, 1e-10);
  const LocalEarth pole = local_earth(std::numbers::pi / 2, 0);
  EXPECT_NEAR(pole.transverse_radius, 6399593.6258, 1e-4);
  EXPECT_NEAR(pole.meridian_radius, 6399593.6258, 1e-4);
  EXPECT_NEAR(pole.gravity, 9.8321849378, 1e-8);
}

TEST(Earth, GravityFallsWithHeight) {
  const LocalEarth low = local_earth(0.6, 0), high = local_earth(0.6, 1000);
  EXPECT_NEAR(low.gravity - high.gravity, 3.086e-3, 1e-12);
  EXPECT_EQ(low.ellipsoid_gravity, high.ellipsoid_gravity);
}

// Westward flight at the speed of the earth's surface is at rest in inertial space: the n axes do not rotate.
TEST(Earth, TransportRateCancelsEarthRateForWestwardFlightAtEarthSpeed) {
  const double latitude = 0.65, height = 5000;
  const LocalEarth earth = local_earth(latitude, height);
  EXPECT_NEAR(earth.omega_ie_n.norm(), earth_rate, 1e-19);
  const double speed = earth_rate * (earth.transverse_radius + height) * std::cos(latitude);
  const Eigen::Vector3d omega_in = earth.omega_ie_n + transport_rate(earth, height, {0, -speed, 0});
  EXPECT_LT(omega_in.norm(), 1e-18);
}

// Northward flight rotates the n axes about west, at the rate velocity over radius.
TEST(Earth, TransportRateOfNorthwardFlightIsAboutWest) {
  const LocalEarth earth = local_earth(-0.3, 100);
  const Eigen::Vector3d omega_en = transport_rate(earth, 100, {200, 0, 5});
  EXPECT_EQ(omega_en.x(), 0);
  EXPECT_NEAR(omega_en.y(), -200 / (earth.meridian_radius + 100), 1e-19);
  EXPECT_EQ(omega_en.z(), 0);
}

}  // namespace
}  // namespace canhil::strapdown
