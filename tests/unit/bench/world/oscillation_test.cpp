#include "bench/world/motion/oscillation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bench/world/flight_record.hpp"
#include "bench/world/units.hpp"

namespace canhil::world {
namespace {

using units::deg;

constexpr double pi = std::numbers::pi;
constexpr double g = units::standard_gravity;
const Position here{.latitude = 0.6, .longitude = 2, .height = 5};
const SPath turning{.speed = 6,
                    .heading = 0.4,
                    .heading_amplitude = 60 * deg,
                    .heading_period = 40,
                    .roll_amplitude = 5 * deg,
                    .roll_period = 40,
                    .depth = {}};
const SeaModel rough{.significant_height = 3,
                     .peak_period = 8,
                     .peakedness = 3.3,
                     .from = 70 * deg,
                     .length = 30,
                     .roll_period = 9};

OscillationModel everything() {
  return {.sinusoids = {{.frequency = 25, .acceleration = {1, 2, 3}, .angle = {1e-3, 2e-3, 3e-3}},
                        {.frequency = 3, .angle = {0, 0.1, 0.1}, .phase = Vector3(0, 0, pi / 2)}},
          .random = {{.from = 10, .to = 90, .psd = {0.01, 0.02, 0.05}, .lines = 8}},
          .sea = rough};
}

Flight on(const BuiltInMotion& base, OscillationModel model, std::uint64_t seed = 7) {
  return drawn({.start = here,
                .motion = std::visit([](const auto& own) -> Motion { return own; }, base),
                .oscillations = std::make_shared<const OscillationModel>(std::move(model))},
               seed);
}

Kinematics headed(double heading) { return kinematics(Rest{.angles = {.heading = heading}}, 0); }

TEST(Oscillation, HasTheDerivativesOfItsVelocityAndAttitude) {
  const Flight flight = on(turning, everything());
  const double h = 1e-5;
  for (double t = 0.1; t < 60; t += 1.117) {
    const Movement now = movement(flight.motion, t);
    const Movement after = movement(flight.motion, t + h), before = movement(flight.motion, t - h);
    EXPECT_EQ(now.v_eb_n, velocity(flight.motion, t));
    // The error of the difference is h^2 / 6 times the third derivative, (2 pi 90 Hz)^2 of the rates.
    EXPECT_LT(((after.v_eb_n - before.v_eb_n) / (2 * h) - now.v_eb_n_rate).norm(), 1e-4) << t;
    const Matrix3 C_rate = (after.C_bn - before.C_bn) / (2 * h);
    EXPECT_LT((now.C_bn.transpose() * C_rate - skew(now.omega_nb_b)).norm(), 1e-5) << t;
    EXPECT_LT((now.C_bn.transpose() * now.C_bn - Matrix3::Identity()).norm(), 1e-14);
  }
}

TEST(Oscillation, TheImuSeesTheSinusoid) {
  OscillationModel model{.sinusoids = {{.frequency = 20,
                                        .acceleration = {0, 0, 2},
                                        .angle = {0, 1e-3, 0},
                                        .phase = Vector3(0, 0, pi / 2)}}};
  const FlightRecord still({.start = here, .motion = Rest{.angles = {.heading = 1}}}, 1'000'000, 1'000);
  const FlightRecord shaken(on(Rest{.angles = {.heading = 1}}, model), 1'000'000, 1'000);
  for (std::size_t k = 0; k <= 1000; ++k) {
    const double w = 2 * pi * 20, t = 1e-3 * static_cast<double>(k);
    const Vector3 force = shaken.epochs()[k].f_ib_b - still.epochs()[k].f_ib_b;
    const Vector3 rate = shaken.epochs()[k].omega_ib_b - still.epochs()[k].omega_ib_b;
    // The rotation of 1 mrad turns gravity by 10 mm/s^2, and the vibration by 2 mm/s^2.
    EXPECT_NEAR(force.z(), 2 * std::cos(w * t), 2e-5) << k;
    EXPECT_NEAR(force.x(), 1e-3 * std::sin(w * t) * (g - 2 * std::cos(w * t)), 1e-4) << k;
    EXPECT_NEAR(rate.y(), 1e-3 * w * std::cos(w * t), 1e-6) << k;
  }
}

// At 3 Hz and 90 Hz, an interval of 10 ms is divided into pieces of an eighth of the shortest period at most.
TEST(Oscillation, IncrementsOfACoarseGridAreTheSumsOfAFineOne) {
  const Flight flight = on(turning, everything());
  const FlightRecord coarse(flight, 2'000'000, 10'000);
  const FlightRecord fine(flight, 2'000'000, 500);
  double greatest = 0;
  for (std::size_t k = 0; k < coarse.increments().size(); ++k) {
    Vector3 theta = Vector3::Zero();
    Vector3 v = Vector3::Zero();
    for (std::size_t j = 20 * k; j < 20 * k + 20; ++j) {
      theta += fine.increments()[j].delta_theta;
      v += fine.increments()[j].delta_v;
    }
    // Increments of 30 mrad and 0.15 m/s.
    EXPECT_LT((coarse.increments()[k].delta_theta - theta).norm(), 30e-3 * 1e-13);
    EXPECT_LT((coarse.increments()[k].delta_v - v).norm(), 0.15 * 1e-13);
    greatest = std::max(greatest, theta.norm());
  }
  EXPECT_GT(greatest, 5e-3);
}

TEST(Oscillation, RandomVibrationHasThePowerOfItsDensity) {
  OscillationModel model{.random = {{.from = 20, .to = 200, .psd = {0, 0, 0.04}, .lines = 100}}};
  const Flight flight = on(Rest{}, model);
  double sum = 0;
  constexpr int count = 20'000;
  for (int k = 0; k < count; ++k) sum += std::pow(movement(flight.motion, 1e-3 * k).v_eb_n_rate.z(), 2);
  const double variance = sum / count;
  EXPECT_NEAR(variance, 0.04 * 180, 0.04 * 180 * 0.03);
}

// The mean square of the heave over a time T has, for a Gaussian process of spectrum S, the variance
// 2 pi / T times the integral of S^2.
TEST(Oscillation, HeaveHasTheSpectrumOfTheSea) {
  for (const double peakedness : {1.0, 3.3}) {
    SeaModel sea = rough;
    sea.peakedness = peakedness;
    sea.length = 0.1;
    const double hours = 3, T = hours * 3600, m0 = sea.significant_height * sea.significant_height / 16;
    double area = 0, squares = 0;
    const double step = 1e-3;
    for (double omega = 0.2; omega < 6; omega += step) {
      area += wave_spectrum(sea, omega) * step;
      squares += std::pow(wave_spectrum(sea, omega), 2) * step;
    }
    const double sigma = std::sqrt(2 * pi / T * squares) * m0 / area;
    EXPECT_LT(sigma, 0.1 * m0);
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      Stream stream(seed, 0, "sea");
      const Sea waves(sea, stream);
      double sum = 0, mean = 0;
      int count = 0;
      for (double t = 0; t < T; t += 0.5, ++count) {
        const double up = -waves.displacement(t).z();
        mean += up;
        sum += up * up;
      }
      EXPECT_NEAR(sum / count, m0, 4 * sigma) << seed;
      EXPECT_NEAR(mean / count, 0, 0.05);
    }
  }
}

TEST(Oscillation, ALongVesselHeavesLessAndAVesselHeadingIntoTheWavesDoesNotRoll) {
  SeaModel sea = rough;
  const auto heave = [&](double length) {
    sea.length = length;
    Stream stream(1, 0, "sea");
    const Sea waves(sea, stream);
    double sum = 0;
    for (double t = 0; t < 2000; t += 0.5) sum += waves.displacement(t).squaredNorm();
    return sum;
  };
  EXPECT_LT(heave(100), 0.5 * heave(10));
  Stream stream(1, 0, "sea");
  const Sea waves(sea, stream);
  double rolled = 0, pitched = 0;
  for (double t = 0; t < 300; t += 0.1) {
    Kinematics ahead = headed(sea.from), abeam = headed(sea.from - 90 * deg);
    waves.add_to(ahead, t);
    waves.add_to(abeam, t);
    EXPECT_NEAR(ahead.angles.roll, 0, 1e-12);
    EXPECT_NEAR(abeam.angles.pitch, 0, 1e-12);
    rolled = std::max(rolled, abeam.angles.roll);
    pitched = std::max(pitched, ahead.angles.pitch);
  }
  EXPECT_GT(rolled, 5 * deg);
  EXPECT_GT(pitched, 1 * deg);
}

// A vessel that follows the slope at once (a short natural period): before a crest from ahead, the bow is up
// while the water rises.
TEST(Oscillation, TheBowRisesWithTheWaterAhead) {
  SeaModel sea = rough;
  sea.pitch_period = sea.roll_period = 0.2;
  sea.pitch_damping = sea.roll_damping;
  Stream stream(1, 0, "sea");
  const Sea waves(sea, stream);
  double agreed = 0;
  for (double t = 0; t < 300; t += 0.1) {
    Kinematics bow = headed(sea.from), port = headed(sea.from + 90 * deg);
    waves.add_to(bow, t);
    waves.add_to(port, t);
    const double rising = -bow.v_eb_n.z();
    // From ahead: the slope towards the bow has the sign of the rising water. From port: the starboard side
    // goes down, which is a positive roll, while the water rises.
    agreed += rising * bow.angles.pitch;
    EXPECT_NEAR(port.angles.roll, bow.angles.pitch, 1e-12);
  }
  EXPECT_GT(agreed, 1.0);
}

TEST(Oscillation, IsDrawnFromTheSeedAndStartsAtTheDisplacedPosition) {
  const Flight one = on(Rest{}, everything(), 7), same = on(Rest{}, everything(), 7);
  const Flight other = on(Rest{}, everything(), 8);
  EXPECT_EQ(velocity(one.motion, 3.3), velocity(same.motion, 3.3));
  EXPECT_NE(velocity(one.motion, 3.3), velocity(other.motion, 3.3));
  const FlightRecord record(on(Rest{}, {.sea = rough}), 100'000'000, 20'000);
  double sum = 0;
  for (const Truth& truth : record.epochs()) sum += truth.position.height;
  EXPECT_NEAR(sum / static_cast<double>(record.epochs().size()), here.height, 0.2)
      << "the mean is the start's";
  EXPECT_GT(std::abs(record.epochs()[0].position.height - here.height), 0.01);
}

}  // namespace
}  // namespace canhil::world
