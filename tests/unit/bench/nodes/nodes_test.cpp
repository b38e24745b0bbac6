// What the emulated nodes send, and when.
#include <gmock/gmock.h>

#include "bench/nodes/is_whole.hpp"
#include "bench/nodes/master_ins.hpp"
#include "bench/nodes/sample_loss.hpp"
#include "bench/nodes/slave_imu.hpp"
#include "bench/nodes/time_keeper.hpp"
#include "bench/world/motion/rest.hpp"

namespace canhil::nodes {
namespace {

using messages::SlaveImuDeltaTheta;
using testing::ElementsAre;

world::FlightRecord at_rest(std::int64_t duration_us, std::int64_t interval_us = 10'000) {
  return {{.start = {}, .motion = world::Rest{}}, duration_us, interval_us};
}

std::vector<std::int64_t> times(Node& node) {
  std::vector<std::int64_t> due;
  Transmission out;
  for (; node.due_us() != never_us; out.clear()) {
    due.push_back(node.due_us());
    node.transmit(out);
  }
  return due;
}

TEST(IncrementRounding, TheRemainderNeverAccumulates) {
  const SignalInfo& signal = SlaveImuDeltaTheta::signals()[0];
  IncrementRounding rounding(signal);
  const world::Vector3 increment{0.3 * signal.scale, -0.49 * signal.scale, 123.4567 * signal.scale};
  world::Vector3 sent = world::Vector3::Zero();
  for (int k = 1; k <= 100'000; ++k) {
    sent += rounding.round(increment, Rounding::as_on_the_bus);
    ASSERT_LE((sent - k * increment).cwiseAbs().maxCoeff(), 0.501 * signal.scale) << k;
  }
}

TEST(IncrementRounding, SendsWhatTheCodecCarriesExactly) {
  const SignalInfo& signal = SlaveImuDeltaTheta::signals()[0];
  IncrementRounding rounding(signal);
  for (int k = 0; k < 1000; ++k) {
    const double sent = rounding.round({1.23456e-3, 0, 0}, Rounding::as_on_the_bus).x();
    const auto frame = to_frame(SlaveImuDeltaTheta{.delta_theta_x_rad = sent}, 0);
    ASSERT_EQ(from_frame<SlaveImuDeltaTheta>(frame).delta_theta_x_rad, sent);
  }
}

TEST(IsWhole, AFrameOfTheMessageWithItsCrcAndNoErrorFrame) {
  const Frame whole = to_frame(SlaveImuDeltaTheta{}, 3);
  EXPECT_TRUE(is_whole<SlaveImuDeltaTheta>(whole));
  EXPECT_FALSE(is_whole<messages::SlaveImuDeltaV>(whole)) << "another id";
  const auto changed = [&](auto&& change) {
    Frame frame = whole;
    change(frame);
    return is_whole<SlaveImuDeltaTheta>(frame);
  };
  EXPECT_FALSE(changed([](Frame& frame) { frame.error = true; }));
  EXPECT_FALSE(changed([](Frame& frame) { frame.extended = true; }));
  EXPECT_FALSE(changed([](Frame& frame) { --frame.size; }));
  EXPECT_FALSE(changed([](Frame& frame) { frame.data[5] ^= 1U; }));
}

TEST(SampleLoss, DrawsForEverySampleAlsoInAnOutage) {
  const scenario::SampleLoss chance{.probability = 0.5, .outage_us = 0, .outage_every_us = 0};
  const scenario::SampleLoss both{.probability = 0.5, .outage_us = 200'000, .outage_every_us = 1'000'000};
  world::Stream alone(1, 0, "loss"), beside(1, 0, "loss");
  for (std::int64_t t_us = 0; t_us < 3'000'000; t_us += 10'000) {
    const bool by_chance = is_lost(chance, t_us, alone);
    EXPECT_EQ(is_lost(both, t_us, beside), by_chance || t_us % 1'000'000 >= 800'000) << t_us;
  }
}

TEST(Sampling, IsSentALatencyAfterItsTimeOfValidity) {
  Sampling sampling(20'000, 7'000, 100'000);
  EXPECT_EQ(sampling.valid_us(), 20'000);
  EXPECT_EQ(sampling.due_us(), 27'000);
  sampling.advance();
  EXPECT_EQ(sampling.due_us(), 47'000);
}

TEST(Sampling, NothingIsSentAfterTheEndOfTheRun) {
  const auto flight = at_rest(40'000);
  SlaveImu in_time(flight, {}, world::Stream(1, 0, "imu"), world::Stream(1, 0, "loss"));
  EXPECT_THAT(times(in_time), ElementsAre(10'000, 20'000, 30'000, 40'000));
  SlaveImu delayed(
      flight,
      {.schedule = {.period_us = std::nullopt, .latency_us = 5'000}, .errors = {}, .loss_probability = 0},
      world::Stream(1, 0, "imu"), world::Stream(1, 0, "loss"));
  EXPECT_THAT(times(delayed), ElementsAre(15'000, 25'000, 35'000));
}

TEST(TimeKeeper, KeepsTimeFromZeroToTheEnd) {
  TimeKeeper keeper(30'000, false);
  EXPECT_THAT(times(keeper), ElementsAre(0, 10'000, 20'000, 30'000));
}

TEST(TimeKeeper, ClosesARunThatEndsBetweenTwoSyncs) {
  TimeKeeper keeper(25'000, true);  // or lockstep would not wait for the last sample's answer
  EXPECT_THAT(times(keeper), ElementsAre(0, 10'000, 20'000, 30'000));
}

TEST(TimeKeeper, CountsStepsInElevenBits) {
  TimeKeeper keeper(25'000'000, true);
  Transmission out;
  for (int step = 0; step < 2100; ++step, out.clear()) {
    keeper.transmit(out);
    const auto sync = from_frame<messages::Sync>(out.frames().front());
    ASSERT_EQ(sync.step, step % 2048);
    ASSERT_EQ(sync.time_us, static_cast<std::uint64_t>(step) * 10'000);
    ASSERT_EQ(sync.lockstep, 1);
  }
}

TEST(MasterIns, ClosesItsGroupWithTheTimeOfValidityNotOfTransmission) {
  const auto flight = at_rest(1'000'000);
  MasterIns node(flight, {.schedule = {.period_us = 50'000, .latency_us = 30'000}, .errors = {}},
                 world::Stream(1, 0, "master"), world::Stream(1, 0, "loss"));
  EXPECT_EQ(node.due_us(), 80'000);
  Transmission out;
  node.transmit(out);
  ASSERT_EQ(out.frames().size(), 5U);
  const auto closing = from_frame<messages::MasterInsVelocityD>(out.frames().back());
  EXPECT_EQ(out.frames().back().id, messages::MasterInsVelocityD::info.id);
  EXPECT_EQ(closing.time_of_validity_us, 50'000U);
  for (const Frame& frame : out.frames()) EXPECT_EQ(e2e::counter(frame.payload()), 0);
}

TEST(MasterIns, AGroupLostOrInAnOutageLeavesAGapInTheCountersAndChangesNoMeasurement) {
  const auto flight = at_rest(10'000'000);
  scenario::MasterIns config{.schedule = {.period_us = 50'000, .latency_us = 0}, .errors = {}};
  config.errors.velocity.sigma = {0.1, 0.1, 0.1};
  MasterIns whole(flight, config, world::Stream(1, 0, "master"), world::Stream(1, 0, "loss"));
  config.loss = {.probability = 0.3, .outage_us = 2'000'000, .outage_every_us = 10'000'000};
  MasterIns lossy(flight, config, world::Stream(1, 0, "master"), world::Stream(1, 0, "loss"));
  Transmission out, lossy_out;
  int lost = 0;
  for (; whole.due_us() != never_us; out.clear(), lossy_out.clear()) {
    const std::int64_t valid_us = whole.due_us();
    whole.transmit(out);
    lossy.transmit(lossy_out);
    const bool is_lost = lossy_out.frames().empty();
    if (!is_lost) {
      ASSERT_TRUE(std::ranges::equal(out.frames(), lossy_out.frames()));
    }
    if (valid_us < 8'000'000) lost += is_lost ? 1 : 0;
    if (valid_us >= 8'000'000 && valid_us < 10'000'000) {
      EXPECT_TRUE(is_lost) << valid_us;
    }
  }
  EXPECT_NEAR(lost, 48, 5 * 5.8);  // binomial: sigma = sqrt(160 0.3 0.7)
  EXPECT_GT(lost, 0);
}

TEST(SlaveImu, AGroupLostTakesItsIncrementsWithItAndLeavesAGapInTheCounters) {
  const auto flight = at_rest(10'000'000);
  scenario::SlaveImu config;
  SlaveImu whole(flight, config, world::Stream(1, 0, "imu"), world::Stream(1, 0, "loss"));
  config.loss_probability = 0.3;
  SlaveImu lossy(flight, config, world::Stream(1, 0, "imu"), world::Stream(1, 0, "loss"));
  Transmission out, lossy_out;
  int lost = 0;
  for (; whole.due_us() != never_us; out.clear(), lossy_out.clear()) {
    ASSERT_EQ(whole.due_us(), lossy.due_us());
    whole.transmit(out);
    lossy.transmit(lossy_out);
    if (lossy_out.frames().empty()) {
      ++lost;
    } else {
      ASSERT_TRUE(std::ranges::equal(out.frames(), lossy_out.frames())) << "counters and measurements go on";
    }
  }
  EXPECT_NEAR(lost, 300, 5 * 14.5);  // binomial: sigma = sqrt(1000 0.3 0.7)
}

}  // namespace
}  // namespace canhil::nodes
