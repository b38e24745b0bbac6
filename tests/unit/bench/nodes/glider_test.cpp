// The messages of the glider's navigation and fins.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/sensors/fins.hpp"
#include "bench/sensors/glider_nav.hpp"
#include "bench/world/units.hpp"
#include "dbc/wire/time_base.hpp"
#include "tests/unit/bench/nodes/made.hpp"
#include "tests/unit/bench/plant/glide/flown.hpp"

namespace canhil::nodes {
namespace {

using namespace sensors;

using world::Vector3;
using world::units::deg;

constexpr std::int64_t end_us = 20'000'000;

const plant::glide::Flown& glide() {
  static const plant::glide::Flown flown({}, end_us);
  return flown;
}

// A flight record as long as the run.
const world::FlightRecord& flight() {
  static const world::FlightRecord record({.start = {}, .motion = world::Rest{}}, end_us, 10'000);
  return record;
}

template <class Message>
Message message(const Transmission& out, std::size_t place) {
  EXPECT_EQ(out.frames()[place].id, Message::info.id);
  return from_frame<Message>(out.frames()[place]);
}

struct Sample {
  std::int64_t due_us = 0;
  std::uint8_t counter = 0;
  std::int64_t valid_us = 0;
  Vector3 velocity, rates, angles;
  double height = 0;
};

std::vector<Sample> navigation(const GliderNavSettings& config) {
  using namespace messages;
  const auto node = made(glider_nav, config, flight(), {&glide().record()});
  std::vector<Sample> all;
  Transmission out;
  for (; node->due_us() != never_us; out.clear()) {
    Sample sample;
    sample.due_us = node->due_us();
    node->transmit(out);
    if (out.frames().empty()) continue;
    const auto ne = message<GliderNavVelocityNE>(out, 0);
    const auto attitude = message<GliderNavAttitude>(out, 1);
    const auto rates = message<GliderNavRates>(out, 2);
    const auto down = message<GliderNavVelocityD>(out, 3);
    EXPECT_EQ(attitude.navigation_validity, Validity::valid);
    sample.counter = e2e::counter(out.frames()[0].payload());
    for (const Frame& frame : out.frames()) EXPECT_EQ(e2e::counter(frame.payload()), sample.counter);
    sample.valid_us = down.time_of_validity_us;
    sample.velocity = {ne.velocity_north_mps, ne.velocity_east_mps, down.velocity_down_mps};
    sample.rates = Vector3(rates.rate_x_degps, rates.rate_y_degps, rates.rate_z_degps) * deg;
    sample.angles = Vector3(attitude.roll_deg, attitude.pitch_deg, attitude.heading_deg) * deg;
    sample.height = ne.height_m;
    all.push_back(sample);
  }
  return all;
}

Vector3 angles(const plant::glide::Truth& truth) {
  const world::Euler e = world::euler_from(truth.C_bn);
  return {e.roll, e.pitch, e.heading};
}

TEST(GliderNav, SendsTheTruthOfItsTimeOfValidity) {
  GliderNavSettings config;
  config.schedule.latency_us = 30'000;
  const auto samples = navigation(config);
  ASSERT_EQ(samples.size(), 998U);  // every 20 ms; only samples that arrive before the end of the run
  for (const Sample& sample : samples) {
    EXPECT_EQ(sample.due_us, sample.valid_us + 30'000);
    const plant::glide::Truth& truth = glide().at(sample.valid_us);
    EXPECT_LT((sample.velocity - truth.v_eb_n).cwiseAbs().maxCoeff(), 0.0101);
    EXPECT_LT((sample.rates - truth.omega_nb_b).cwiseAbs().maxCoeff(), 0.00251 * deg);
    EXPECT_LT((sample.angles - angles(truth)).cwiseAbs().maxCoeff(), 0.00151 * deg);
    EXPECT_NEAR(sample.height, truth.height, 0.051);
  }
}

TEST(GliderNav, ErrorsHaveTheirSigmas) {
  const auto samples =
      navigation({.velocity_noise = 0.25, .rate_noise = 0.125 * deg, .attitude_noise = 0.25 * deg});
  Vector3 velocity = Vector3::Zero(), rates = velocity, attitude = velocity;
  const double count = static_cast<double>(samples.size());
  for (const Sample& sample : samples) {
    const plant::glide::Truth& truth = glide().at(sample.valid_us);
    velocity += (sample.velocity - truth.v_eb_n).cwiseAbs2() / count;
    rates += (sample.rates - truth.omega_nb_b).cwiseAbs2() / count;
    attitude += (sample.angles - angles(truth)).cwiseAbs2() / count;
  }
  for (int axis = 0; axis < 3; ++axis) {  // 1000 samples: the estimated sigma has a sigma of 2.2 %
    EXPECT_NEAR(std::sqrt(velocity[axis]), 0.25, 0.025);
    EXPECT_NEAR(std::sqrt(rates[axis]), 0.125 * deg, 0.0125 * deg);
    EXPECT_NEAR(std::sqrt(attitude[axis]), 0.25 * deg, 0.025 * deg);
  }
}

TEST(GliderNav, CorrelatedErrorsStay) {
  const auto change = [](double fraction) {
    const auto samples =
        navigation({.velocity_noise = 1, .correlated_fraction = fraction, .correlation_time = 60});
    double sum = 0;
    for (std::size_t i = 1; i < samples.size(); ++i) {
      const auto error = [&](std::size_t k) {
        return samples[k].velocity.x() - glide().at(samples[k].valid_us).v_eb_n.x();
      };
      sum += std::pow(error(i) - error(i - 1), 2) / static_cast<double>(samples.size() - 1);
    }
    return sum;  // 2 (1 - fraction), plus the change of the correlated error in 20 ms
  };
  EXPECT_NEAR(change(0), 2, 0.3);
  EXPECT_NEAR(change(0.5), 1, 0.15);
  EXPECT_LT(change(1), 0.002);
}

TEST(GliderNav, LossesAndOutagesLeaveAGapInTheCounter) {
  GliderNavSettings config;
  config.loss = {.probability = 0.1, .outage_us = 1'000'000, .outage_every_us = 10'000'000};
  const auto samples = navigation(config);
  EXPECT_NEAR(static_cast<double>(samples.size()), 0.9 * 900, 45);
  for (const Sample& sample : samples) {
    EXPECT_LT(sample.valid_us % 10'000'000, 9'000'000);
    EXPECT_EQ(sample.counter, (sample.valid_us / 20'000 - 1) % 15);
  }
}

TEST(Fins, SendTheDeflectionOfTheirTimeOfValidity) {
  FinsSettings config;
  config.schedule.latency_us = 50'000;
  const auto node = made(fins, config, flight(), {&glide().record()});
  Transmission out;
  int count = 0;
  for (; node->due_us() != never_us; out.clear()) {
    const std::int64_t due_us = node->due_us();
    node->transmit(out);
    const auto deflections = message<messages::FinDeflections>(out, 0);
    const std::int64_t valid_us = unwrap_short_us(std::llround(deflections.time_of_validity_us), due_us);
    EXPECT_EQ(valid_us, due_us - 50'000);
    const Vector3 sent(deflections.elevator_deg, deflections.aileron_deg, deflections.rudder_deg);
    EXPECT_LT((sent - glide().at(valid_us).fins / deg).cwiseAbs().maxCoeff(), 0.0101);
    ++count;
  }
  EXPECT_EQ(count, 1995);
}

TEST(Fins, AWrongStampIsWrongByWhatIsAskedFor) {
  FinsSettings config;
  config.stamp_error_us = 40'000;
  const auto node = made(fins, config, flight(), {&glide().record()});
  Transmission out;
  const std::int64_t due_us = node->due_us();
  node->transmit(out);
  const auto deflections = message<messages::FinDeflections>(out, 0);
  EXPECT_EQ(deflections.time_of_validity_us, static_cast<double>(due_us + 40'000));
  EXPECT_NEAR(deflections.elevator_deg, glide().at(due_us).fins.x() / deg, 0.0101);
}

}  // namespace
}  // namespace canhil::nodes
