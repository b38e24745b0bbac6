#include "bench/world/stream.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "bench/world/hash.hpp"

namespace canhil::world {
namespace {

TEST(Hash, IsFnv1aAsPublished) {
  // Test vectors of draft-eastlake-fnv.
  EXPECT_EQ(fnv1a_64(""), 0xcbf29ce484222325U);
  EXPECT_EQ(fnv1a_64("a"), 0xaf63dc4c8601ec8cU);
  EXPECT_EQ(fnv1a_64("foobar"), 0x85944171f73967e8U);
}

TEST(Stream, SameNameSameNumbers) {
  Stream a(7, 3, "slave_imu");
  Stream b(7, 3, "slave_imu");
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(a.normal(), b.normal());
    EXPECT_EQ(a.uniform(), b.uniform());
  }
}

TEST(Stream, TheNumbersAreTheSameOnEveryMachine) {
  Stream stream(7, 0, "slave_imu");
  const std::array<double, 3> expected{0.31274652416880755, 1.2034464091347952, -0.8177524116203686};
  for (const double value : expected) EXPECT_DOUBLE_EQ(stream.normal(), value);
}

double correlation(Stream a, Stream b, int n) {
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += a.normal() * b.normal();
  return sum / n;
}

TEST(Stream, SeedRunAndNameEachMakeAnotherStream) {
  constexpr int n = 100'000;
  const double bound = 5 / std::sqrt(n);  // 5 sigma of the mean of products of independent normals
  const Stream base(7, 3, "slave_imu");
  EXPECT_GT(correlation(base, base, n), 0.9) << "the measure sees dependence";
  EXPECT_LT(std::abs(correlation(base, Stream(8, 3, "slave_imu"), n)), bound);
  EXPECT_LT(std::abs(correlation(base, Stream(7, 4, "slave_imu"), n)), bound);
  EXPECT_LT(std::abs(correlation(base, Stream(7, 3, "master_ins"), n)), bound);
  EXPECT_LT(std::abs(correlation(base, Stream(3, 7, "slave_imu"), n)), bound) << "seed and run are not alike";
}

TEST(Stream, FirstNumbersOfManyRunsAreNormal) {
  // A campaign takes few numbers from each of many streams, so the seeding must be as random as the stepping.
  constexpr int n = 20'000;
  double sum = 0;
  double squares = 0;
  double fourth = 0;
  double neighbours = 0;
  double last = 0;
  for (std::uint64_t run = 0; run < n; ++run) {
    const double x = Stream(1, run, "initial_error").normal();
    sum += x;
    squares += x * x;
    fourth += x * x * x * x;
    neighbours += x * last;
    last = x;
  }
  // 5 sigma: variances of x, x^2 and x^4 are 1, 2 and 96.
  EXPECT_NEAR(sum / n, 0, 5 / std::sqrt(n));
  EXPECT_NEAR(squares / n, 1, 5 * std::sqrt(2.0 / n));
  EXPECT_NEAR(fourth / n, 3, 5 * std::sqrt(96.0 / n));
  EXPECT_NEAR(neighbours / n, 0, 5 / std::sqrt(n));
}

TEST(RandomConstant, IsValuePlusSigmaTimesNormalAndAlwaysTakesThree) {
  Stream a(1, 2, "x");
  Stream b(1, 2, "x");
  const Vector3 n = b.normal3();
  const Vector3 expected = Vector3(1, 2, 3) + Vector3(0.1 * n.x(), 0, 10 * n.z());
  EXPECT_EQ(draw({.value = {1, 2, 3}, .sigma = {0.1, 0, 10}}, a), expected);
  EXPECT_EQ(draw({.value = {1, 2, 3}, .sigma = Vector3::Zero()}, a), Vector3(1, 2, 3));
  b.normal3();
  EXPECT_EQ(a.normal(), b.normal());
}

}  // namespace
}  // namespace canhil::world
