// The wind estimator through the device: temporary bad input is reported, bridged, and has no lasting effect.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/unit/target/device/glider.hpp"

namespace canhil::target {
namespace {

using namespace messages;
using wind::FinFrame;
using wind::Navigation;

constexpr std::size_t rows = 1001;
constexpr std::size_t bad_from = 500, bad_to = 550;  // 1 s

bool is_bad(std::size_t k) { return k >= bad_from && k < bad_to; }

// Mean error of the wind over the last second of the run; this second has the last 50 elements of `winds`.
double final_error(const std::vector<Eigen::Vector3d>& winds) {
  double sum = 0;
  for (std::size_t i = 1; i <= 50; ++i)
    sum += (winds[winds.size() - i] - recorded().true_wind(rows - i)).norm() / 50;
  return sum;
}

double undisturbed_error() {
  static const double error = [] {
    Glider bench;
    bench.fly(0, rows);
    return final_error(bench.winds());
  }();
  return error;
}

// All frames that were sent contain valid values: no signal is at the end of its range, to which NaN would be
// converted. The target is still running.
void expect_sound(const Glider& bench) {
  for (const auto& w : bench.winds()) ASSERT_LT(w.cwiseAbs().maxCoeff(), 190);
  for (const auto& a : bench.all<WindAirVelocity>()) ASSERT_LT(std::abs(a.air_velocity_x_mps), 600);
  for (const auto& s : bench.all<WindSigma>()) {
    ASSERT_GT(std::min({s.wind_sigma_north_mps, s.wind_sigma_east_mps, s.wind_sigma_down_mps}), 0);
  }
  for (const auto& h : bench.all<TargetHeartbeat>()) {
    ASSERT_NE(h.state, TargetState::fault);
    ASSERT_EQ(h.error_numeric, 0);
  }
}

// In the last second of the run, the effect of the fault is below a margin [m/s].
void expect_recovered(const Glider& bench, double margin = 0.5) {
  expect_sound(bench);
  const auto status = bench.all<WindSpeed>();
  for (std::size_t i = 1; i <= 50; ++i) {
    const WindSpeed& s = status[status.size() - i];
    ASSERT_EQ(s.outcome, WindOutcome::updated);
    ASSERT_EQ(s.fault, WindFault::none);
    ASSERT_EQ(s.fins_late + s.fins_missing + s.fins_not_physical + s.outside_altitude, 0);
  }
  EXPECT_LT(final_error(bench.winds()), undisturbed_error() + margin);
}

TEST(Wind, StartsWithTheFirstUsableSampleWhereTheAirVelocityIsNotKnown) {
  Glider bench(Glider::Release{.air_velocity_known = false, .parameters = {}});
  bench.fly(0, rows, [](std::size_t k, Navigation& n, FinFrame&) { n.valid = k >= 10; });
  const auto status = bench.all<WindSpeed>();
  EXPECT_EQ(status[9].outcome, WindOutcome::waiting);
  EXPECT_EQ(status[9].fault, WindFault::invalid);
  EXPECT_EQ(bench.all<WindVector>()[9].started, 0);
  EXPECT_NEAR(bench.all<WindSigma>()[9].wind_sigma_north_mps, 20, 0.1);
  EXPECT_EQ(status[10].outcome, WindOutcome::started);
  EXPECT_EQ(bench.all<WindVector>()[10].started, 1);
  EXPECT_EQ(status[11].outcome, WindOutcome::updated);
  expect_recovered(bench, 1.0);  // 20 s after a start with unknown wind, the along-track wind is less exact
}

struct Bad {
  const char* name;
  WindFault fault;
  std::uint16_t bad_groups;  // out of 50
  void (*spoil)(Navigation&);
};

class BadNavigation : public testing::TestWithParam<Bad> {};

TEST_P(BadNavigation, IsNamedCoastedOverAndForgotten) {
  for (const Algorithm algorithm : {Algorithm::ekf, Algorithm::h_infinity, Algorithm::adaptive_q}) {
    Glider bench(Glider::Release{.algorithm = algorithm, .parameters = {}});
    const Navigation kept = recorded().navigation(bad_from);
    bench.fly(0, rows, [&kept](std::size_t k, Navigation& n, FinFrame&) {
      if (!is_bad(k)) return;
      if (GetParam().fault == WindFault::stale)
        n = {n.t_us, kept.v_eb_n, kept.omega, kept.attitude, n.altitude, true};
      GetParam().spoil(n);
    });
    const auto status = bench.all<WindSpeed>();
    const auto updates = bench.all<WindUpdate>();
    const auto sigmas = bench.all<WindSigma>();
    ASSERT_EQ(status.size(), rows);
    const std::size_t noticed = GetParam().fault == WindFault::stale ? bad_from + 6 : bad_from;
    // A persistent jump is accepted after 20 samples.
    const std::size_t last = GetParam().fault == WindFault::jump ? bad_from + 20 : bad_to;
    for (std::size_t k = noticed; k < last; ++k) {
      ASSERT_EQ(status[k].outcome, WindOutcome::coasting) << k;
      ASSERT_EQ(status[k].fault, GetParam().fault) << k;
      ASSERT_EQ(updates[k].nis, 0) << k;
    }
    EXPECT_GT(sigmas[last - 1].wind_sigma_north_mps, sigmas[noticed].wind_sigma_north_mps);
    EXPECT_EQ(status[bad_to].outcome, WindOutcome::updated);
    EXPECT_EQ(bench.last<TargetCounters>()->bad_group, GetParam().bad_groups);
    if (algorithm == Algorithm::ekf) expect_recovered(bench);
    expect_sound(bench);
  }
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    Navigation, BadNavigation,
    testing::Values(
        Bad{"ThatSaysSo", WindFault::invalid, 50, [](Navigation& n) { n.valid = false; }},
        Bad{"TooFast", WindFault::not_physical, 50, [](Navigation& n) { n.v_eb_n.x() = 650; }},
        Bad{"TooMuchRate", WindFault::not_physical, 50,
            [](Navigation& n) { n.omega.z() = 320 * Glider::deg; }},
        Bad{"OfVelocitiesThatAreNoNumbers", WindFault::not_physical, 50,
            [](Navigation& n) { n.v_eb_n.setConstant(nan); }},
        Bad{"NoseUp", WindFault::pitch, 0, [](Navigation& n) { n.attitude.y() = 89.9 * Glider::deg; }},
        Bad{"NoseDown", WindFault::pitch, 0, [](Navigation& n) { n.attitude.y() = -90 * Glider::deg; }},
        Bad{"ThatStandsStill", WindFault::stale, 44, [](Navigation&) {}},
        Bad{"OfAnotherHeading", WindFault::jump, 0,
            [](Navigation& n) {
              if (n.t_us < 20'000L * 520) n.attitude.z() += 1;
            }}),
    [](const auto& which) { return which.param.name; });

// An encoder that does not check for NaN sends the raw minimum instead of NaN.
TEST(Wind, TheRawMinimumIsNoAngle) {
  Glider bench;
  bench.fly(0, 10);
  bench.send(GliderNavVelocityNE{.velocity_north_mps = 250, .height_m = 10'000});
  Outbox<1> out;
  out.send(GliderNavAttitude{.navigation_validity = Validity::valid});
  Frame frame = out.frames().front();
  frame.data[3] |= 0x10U;  // bit 28: the sign of roll_deg, whose other bits are 0
  e2e::protect({frame.data.data(), frame.size}, GliderNavAttitude::info.e2e_data_id, 10);
  ASSERT_LT(from_frame<GliderNavAttitude>(frame).roll_deg, -181);
  bench.feed(frame);
  bench.send(GliderNavRates{});
  bench.send(GliderNavVelocityD{.time_of_validity_us = 200'000});
  EXPECT_EQ(bench.last<WindSpeed>()->outcome, WindOutcome::coasting);
  EXPECT_EQ(bench.last<WindSpeed>()->fault, WindFault::not_finite);
}

TEST(Wind, AltitudeOutsideTheAtmosphereIsFlagged) {
  for (const double altitude : {-5000.0, 60'000.0, 94'000.0}) {
    Glider bench;
    bench.fly(0, rows, [altitude](std::size_t k, Navigation& n, FinFrame&) {
      if (is_bad(k)) n.altitude = altitude;
    });
    const auto status = bench.all<WindSpeed>();
    EXPECT_EQ(status[bad_from].outside_altitude, 0);
    for (std::size_t k = bad_from + 1; k <= bad_to; ++k) {  // the step after each bad sample
      ASSERT_EQ(status[k].outside_altitude, 1) << k;
      ASSERT_EQ(status[k].outcome, WindOutcome::updated) << k;
    }
    expect_recovered(bench);
  }
}

TEST(Wind, AFlightOutsideTheModelsRangeIsFlagged) {
  struct Case {
    Eigen::Vector3d air_velocity;
    std::uint8_t WindSpeed::*flag;
  };
  for (const Case& c :
       {Case{{20, 0, 1}, &WindSpeed::outside_speed}, Case{{0, 0, 0}, &WindSpeed::outside_speed},
        Case{{100, 0, 90}, &WindSpeed::outside_alpha}, Case{{150, 140, 10}, &WindSpeed::outside_beta},
        Case{{320, 0, 10}, &WindSpeed::outside_mach}, Case{{nan, nan, nan}, &WindSpeed::outside_speed}}) {
    Glider bench(Glider::Release{.air_velocity = c.air_velocity, .parameters = {}});
    bench.fly(0, 100);
    EXPECT_EQ(bench.all<WindSpeed>()[1].*c.flag, 1) << c.air_velocity.transpose();
    EXPECT_EQ(bench.last<TargetHeartbeat>()->state, TargetState::running);
    EXPECT_EQ(bench.last<TargetHeartbeat>()->error_numeric, 0);
  }
}

TEST(Wind, DeflectionsThatAreNotPhysicalAreRefused) {
  for (const double angle_deg : {25.0, -40.9, nan}) {
    Glider bench;
    bench.fly(0, rows, [angle_deg](std::size_t k, Navigation&, FinFrame& fins) {
      if (is_bad(k)) fins.deflection.aileron = angle_deg * Glider::deg;
    });
    const auto status = bench.all<WindSpeed>();
    for (std::size_t k = bad_from; k < bad_to; ++k) ASSERT_EQ(status[k].fins_not_physical, 1) << k;
    EXPECT_EQ(status[bad_from + 1].fins_missing, 0);
    EXPECT_EQ(status[bad_from + 10].fins_missing, 1);
    EXPECT_EQ(status[bad_to].fins_not_physical, 0);
    EXPECT_EQ(bench.last<TargetCounters>()->bad_group, 50);
    expect_recovered(bench);
  }
}

// The process noise does not adapt here, so that only its increase for missing fins is visible.
TEST(Wind, MissingFinsAreFlaggedAndWidenTheSigmas) {
  Glider::Release release;
  release.parameters = {{.parameter = Parameter::process_noise, .value = 0},
                        {.parameter = Parameter::body_rate_noise_degpsprts, .value = 0.5F}};
  Glider bench(release);
  bench.fly(0, rows, [](std::size_t k, Navigation&, FinFrame& fins) { fins.arrives = !is_bad(k); });
  const auto status = bench.all<WindSpeed>();
  EXPECT_EQ(status[bad_from - 1].fins_late, 0);
  EXPECT_EQ(status[bad_from].fins_late, 0);  // the last fins are 20 ms old
  EXPECT_EQ(status[bad_from + 1].fins_late, 1);
  EXPECT_EQ(status[bad_from + 1].fins_missing, 0);
  EXPECT_EQ(status[bad_to - 1].fins_missing, 1);
  EXPECT_EQ(status[bad_to - 1].outcome, WindOutcome::updated);
  const auto sigmas = bench.all<WindSigma>();
  EXPECT_GT(sigmas[bad_to - 1].wind_sigma_north_mps, 1.2 * sigmas[bad_from - 1].wind_sigma_north_mps);
  expect_recovered(bench);
}

// Fins that arrive 60 ms after their time of validity take effect at that time of validity, not at their
// arrival.
TEST(Wind, LateFinsAreFlaggedAndUsedAtTheirTimeOfValidity) {
  Glider bench;
  bench.fly(0, rows, [](std::size_t k, Navigation&, FinFrame& fins) {
    if (!is_bad(k)) return;
    fins.t_us -= 60'000;
    fins.deflection = recorded().inputs[k - 3].fins;
  });
  const auto status = bench.all<WindSpeed>();
  EXPECT_EQ(status[bad_from + 5].fins_late, 1);
  EXPECT_EQ(status[bad_from + 5].fins_missing, 0);
  EXPECT_EQ(bench.last<TargetCounters>()->late, 3) << "three came a second time";
  expect_recovered(bench);
}

TEST(Wind, FinsOfBetweenTwoSamplesActOverTheirShareOfTheStep) {
  const auto rate_after = [](double at_middle_deg) {
    Glider bench;
    bench.fly(0, 2, [&](std::size_t k, Navigation&, FinFrame&) {
      if (k == 1) bench.fins(10'000, {at_middle_deg * Glider::deg, 0, 0});
    });
    return bench.last<WindAttitude>()->pitch_deg;
  };
  EXPECT_NE(rate_after(10), rate_after(-10));
}

TEST(Wind, AnIncompleteGroupIsDroppedAndBridged) {
  Glider bench;
  bench.fly(0, 100);
  bench.send(GliderNavVelocityNE{});
  bench.send(GliderNavAttitude{});
  bench.lose(GliderNavRates{});
  bench.send(GliderNavVelocityD{.time_of_validity_us = 2'000'000});
  EXPECT_EQ(bench.all<WindUpdate>().size(), 100U);
  bench.fly(101, rows);
  EXPECT_EQ(bench.all<WindUpdate>()[100].cause_time_us, 2'020'000U);
  EXPECT_EQ(bench.all<WindSpeed>()[100].outcome, WindOutcome::updated);
  EXPECT_EQ(bench.last<TargetCounters>()->bad_group, 1);
  expect_recovered(bench);
}

TEST(Wind, SilentNavigationIsNamedWhileItLastsAndBridged) {
  Glider bench;
  bench.fly(0, 550, [](std::size_t k, Navigation& n, FinFrame&) {
    if (is_bad(k)) n.t_us = -1;
  });
  EXPECT_EQ(bench.all<WindUpdate>().size(), 500U);
  EXPECT_EQ(bench.last<TargetHeartbeat>()->error_input_silent, 1);
  EXPECT_EQ(bench.last<TargetHeartbeat>()->state, TargetState::running);
  bench.fly(550, rows);
  EXPECT_EQ(bench.all<WindSpeed>()[500].outcome, WindOutcome::updated);
  EXPECT_EQ(bench.last<TargetHeartbeat>()->error_input_silent, 0);
  expect_recovered(bench);
}

TEST(Wind, ALongSilenceStartsItAgainWithTheWindThatWasKnown) {
  Glider bench;
  bench.fly(0, rows, [](std::size_t k, Navigation& n, FinFrame&) {
    if (k >= 500 && k < 650) n.t_us = -1;
  });
  EXPECT_EQ(bench.all<WindSpeed>()[500].outcome, WindOutcome::started);
  EXPECT_LT(bench.all<WindSigma>()[500].wind_sigma_north_mps, 5);
  EXPECT_EQ(bench.all<WindSpeed>()[501].outcome, WindOutcome::updated);
  expect_sound(bench);
}

struct Untimely {
  const char* name;
  WindOutcome outcome;
  std::uint16_t bad_groups, late;
  std::int64_t t_us;
};

class UntimelyNavigation : public testing::TestWithParam<Untimely> {};

TEST_P(UntimelyNavigation, IsAnsweredWithItsReasonAndLeavesNoTrace) {
  const auto flight = [](bool untimely) {
    Glider bench;
    bench.fly(0, 500);
    if (untimely) {
      Navigation navigation = recorded().navigation(300);
      navigation.t_us = GetParam().t_us;
      bench.navigate(navigation);
      EXPECT_EQ(bench.last<WindSpeed>()->outcome, GetParam().outcome);
      EXPECT_EQ(bench.last<WindUpdate>()->cause_time_us, wrap_us(GetParam().t_us));
      EXPECT_EQ(bench.last<WindUpdate>()->nis, 0);
    }
    bench.forget();
    bench.fly(500, 600);
    if (untimely) {
      EXPECT_EQ(bench.last<TargetCounters>()->bad_group, GetParam().bad_groups);
      EXPECT_EQ(bench.last<TargetCounters>()->late, GetParam().late);
    }
    EXPECT_EQ(bench.all<WindUpdate>().size(), 100U);
    return bench.winds();
  };
  EXPECT_EQ(flight(true), flight(false));
}

INSTANTIATE_TEST_SUITE_P(
    Navigation, UntimelyNavigation,
    testing::Values(Untimely{"FromTheFuture", WindOutcome::future, 1, 0, 12'000'000},
                    Untimely{"TwiceTheSame", WindOutcome::out_of_order, 0, 1, 499 * 20'000L},
                    Untimely{"FromThePast", WindOutcome::out_of_order, 0, 1, 5'000'000},
                    Untimely{"BeforeTheStart", WindOutcome::out_of_order, 0, 1, -20'000}),
    [](const auto& which) { return which.param.name; });

}  // namespace
}  // namespace canhil::target
