// The messages that the emulated nodes send, and the times at which they send them.
#include <gmock/gmock.h>

#include "bench/nodes/is_whole.hpp"
#include "bench/nodes/time_keeper.hpp"
#include "bench/sensors/master_ins.hpp"
#include "bench/sensors/sample_loss.hpp"
#include "bench/sensors/slave_imu.hpp"
#include "bench/world/motion/rest.hpp"
#include "tests/unit/bench/nodes/made.hpp"
#include "tests/unit/bench/nodes/rounded.hpp"

namespace canhil::nodes {
namespace {

using namespace sensors;

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
  const SampleLoss chance{.probability = 0.5, .outage_us = 0, .outage_every_us = 0};
  const SampleLoss both{.probability = 0.5, .outage_us = 200'000, .outage_every_us = 1'000'000};
  world::Stream alone(1, 0, "loss"), beside(1, 0, "loss");
  for (std::int64_t t_us = 0; t_us < 3'000'000; t_us += 10'000) {
    const bool by_chance = is_lost(chance, t_us, alone);
    EXPECT_EQ(is_lost(both, t_us, beside), by_chance || t_us % 1'000'000 >= 800'000) << t_us;
  }
}

TEST(SampleLoss, OutagesAreTheEndOfTheirPeriod) {
  constexpr SampleLoss loss{.probability = 0, .outage_us = 1'000'000, .outage_every_us = 10'000'000};
  EXPECT_FALSE(in_outage(loss, 500'000));
  EXPECT_FALSE(in_outage(loss, 8'990'000));
  EXPECT_TRUE(in_outage(loss, 9'000'000));
  EXPECT_TRUE(in_outage(loss, 19'990'000));
  EXPECT_FALSE(in_outage(loss, 20'000'000));
  EXPECT_FALSE(in_outage({}, 9'500'000));
}

TEST(Sampler, SendsNothingAfterTheEndOfTheRun) {
  const auto flight = at_rest(40'000);
  EXPECT_THAT(times(*made(slave_imu, SlaveImuSettings{}, flight)),
              ElementsAre(10'000, 20'000, 30'000, 40'000));
  const SlaveImuSettings late{
      .schedule = {.period_us = std::nullopt, .latency_us = 5'000}, .errors = {}, .loss_probability = 0};
  EXPECT_THAT(times(*made(slave_imu, late, flight)), ElementsAre(15'000, 25'000, 35'000));
}

TEST(TimeKeeper, KeepsTimeFromZeroToTheEnd) {
  TimeKeeper keeper(30'000, false);
  EXPECT_THAT(times(keeper), ElementsAre(0, 10'000, 20'000, 30'000));
}

TEST(TimeKeeper, ClosesARunThatEndsBetweenTwoSyncs) {
  TimeKeeper keeper(25'000, true);  // without a final Sync, lockstep would not wait for the last answer
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
  const auto node =
      made(master_ins,
           MasterInsSettings{.schedule = {.period_us = 50'000, .latency_us = 30'000}, .errors = {}}, flight);
  EXPECT_EQ(node->due_us(), 80'000);
  Transmission out;
  node->transmit(out);
  ASSERT_EQ(out.frames().size(), 5U);
  const auto closing = from_frame<messages::MasterInsVelocityD>(out.frames().back());
  EXPECT_EQ(out.frames().back().id, messages::MasterInsVelocityD::info.id);
  EXPECT_EQ(closing.time_of_validity_us, 50'000U);
  for (const Frame& frame : out.frames()) EXPECT_EQ(e2e::counter(frame.payload()), 0);
}

TEST(MasterIns, AGroupLostOrInAnOutageLeavesAGapInTheCountersAndChangesNoMeasurement) {
  const auto flight = at_rest(10'000'000);
  MasterInsSettings config{.schedule = {.period_us = 50'000, .latency_us = 0}, .errors = {}};
  config.errors.velocity.sigma = {0.1, 0.1, 0.1};
  const auto whole = made(master_ins, config, flight);
  config.loss = {.probability = 0.3, .outage_us = 2'000'000, .outage_every_us = 10'000'000};
  const auto lossy = made(master_ins, config, flight);
  Transmission out, lossy_out;
  int lost = 0;
  for (; whole->due_us() != never_us; out.clear(), lossy_out.clear()) {
    const std::int64_t valid_us = whole->due_us();
    whole->transmit(out);
    lossy->transmit(lossy_out);
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
  SlaveImuSettings config;
  const auto whole = made(slave_imu, config, flight);
  config.loss_probability = 0.3;
  const auto lossy = made(slave_imu, config, flight);
  Transmission out, lossy_out;
  int lost = 0;
  for (; whole->due_us() != never_us; out.clear(), lossy_out.clear()) {
    ASSERT_EQ(whole->due_us(), lossy->due_us());
    whole->transmit(out);
    lossy->transmit(lossy_out);
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
