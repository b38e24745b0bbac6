#include "bench/plant/glide/coefficient_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace canhil::plant::glide {
namespace {

constexpr std::int64_t step_us = 10'000;

// The factor of one part of a coefficient at every step of a run.
std::vector<double> factors_of(const CoefficientErrorModel& model, std::size_t coefficient, std::size_t part,
                               int count) {
  CoefficientErrors errors(model, Stream(7, 0, "coefficients"));
  std::vector<double> all;
  for (int i = 0; i < count; ++i) {
    all.push_back(errors.now()[coefficient][part]);
    errors.advance((i + 1) * step_us, step_us);
  }
  return all;
}

TEST(CoefficientErrors, HeldAreNewWhenTheirTimeIsOver) {
  const auto f = factors_of({.level = 0.2, .kind = ErrorKind::held, .time_us = 50'000}, 4, 0, 100);
  for (std::size_t i = 1; i < f.size(); ++i) EXPECT_EQ(f[i] != f[i - 1], i % 5 == 0) << i;
}

TEST(CoefficientErrors, WhiteAreNewEachStepAndConstantNever) {
  const auto white = factors_of({.level = 0.2, .kind = ErrorKind::white}, 4, 0, 50);
  const auto constant = factors_of({.level = 0.2, .kind = ErrorKind::constant}, 4, 0, 50);
  for (std::size_t i = 1; i < white.size(); ++i) {
    EXPECT_NE(white[i], white[i - 1]);
    EXPECT_EQ(constant[i], constant[0]);
  }
  EXPECT_NE(constant[0], 1);
}

TEST(CoefficientErrors, HaveTheirLevel) {
  for (const ErrorKind kind : {ErrorKind::white, ErrorKind::held, ErrorKind::markov}) {
    const auto f = factors_of({.level = 0.2, .kind = kind, .time_us = 50'000}, 2, 1, 100'000);
    double power = 0;
    for (const double each : f) power += (each - 1) * (each - 1) / static_cast<double>(f.size());
    EXPECT_NEAR(std::sqrt(power), 0.2, 0.005);  // at least 10 000 independent draws: sigma of 0.7 %
  }
}

TEST(CoefficientErrors, MarkovForgetsInItsTime) {
  const auto f = factors_of({.level = 1, .kind = ErrorKind::markov, .time_us = 50'000}, 0, 0, 100'000);
  double product = 0;
  for (std::size_t i = 0; i + 5 < f.size(); ++i)
    product += (f[i] - 1) * (f[i + 5] - 1) / static_cast<double>(f.size());
  EXPECT_NEAR(product, std::exp(-1), 0.05);
}

TEST(CoefficientErrors, PartsAreApartOrTogether) {
  const CoefficientErrors apart({.level = 0.2}, Stream(7, 0, "coefficients"));
  const CoefficientErrors together({.level = 0.2, .per_part = false}, Stream(7, 0, "coefficients"));
  for (std::size_t c = 0; c < coefficient_count; ++c) {
    EXPECT_NE(apart.now()[c][0], apart.now()[c][1]);
    EXPECT_EQ(together.now()[c][0], together.now()[c][1]);
    EXPECT_EQ(together.now()[c][0], together.now()[c][2]);
    if (c > 0) {
      EXPECT_NE(together.now()[c][0], together.now()[c - 1][0]);
    }
  }
}

TEST(CoefficientErrors, OfForcesAlone) {
  const CoefficientErrors errors({.level = 0.2, .moments = false}, Stream(7, 0, "coefficients"));
  for (std::size_t c = 0; c < coefficient_count; ++c) {
    for (const double factor : errors.now()[c]) EXPECT_EQ(factor == 1, c > 2) << c;
  }
}

TEST(CoefficientErrors, NoneAtLevelZero) {
  EXPECT_EQ(CoefficientErrors({}, Stream(7, 0, "coefficients")).now(), nominal);
}

}  // namespace
}  // namespace canhil::plant::glide
