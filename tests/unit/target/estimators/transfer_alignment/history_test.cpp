#include "target/estimators/transfer_alignment/history.hpp"

#include <gtest/gtest.h>

#include <deque>

#include "tests/unit/target/estimators/flight.hpp"
#include "tests/unit/target/estimators/transfer_alignment/full_run.hpp"

namespace canhil::transfer_alignment {
namespace {

using Eigen::Vector3d;

constexpr std::size_t capacity = 32;

std::int64_t epoch_us(std::size_t sample) { return static_cast<std::int64_t>(sample + 1) * 10'000; }

void expect_same_bits(const State& a, const State& b) {
  EXPECT_EQ(a.P, b.P);
  EXPECT_EQ(a.ins.nav.C_bn, b.ins.nav.C_bn);
  EXPECT_EQ(a.ins.nav.v_eb_n, b.ins.nav.v_eb_n);
  EXPECT_EQ(a.ins.nav.latitude, b.ins.nav.latitude);
  EXPECT_EQ(a.ins.nav.longitude, b.ins.nav.longitude);
  EXPECT_EQ(a.ins.nav.height, b.ins.nav.height);
  EXPECT_EQ(a.ins.accel_bias, b.ins.accel_bias);
  EXPECT_EQ(a.ins.gyro_bias, b.ins.gyro_bias);
  EXPECT_EQ(a.ins.interval.delta_v_n, b.ins.interval.delta_v_n);
  EXPECT_EQ(a.ins.interval.duration, b.ins.interval.duration);
}

// The full run, in which every master velocity arrives `late` samples late. Velocities that are still under
// way at the last sample arrive after this sample.
State run_late(std::size_t late) {
  const Settings settings;
  State state = initial(published_start(), settings);
  History<capacity> history(0);
  std::deque<std::pair<std::size_t, Vector3d>> under_way;
  const std::vector<Sample> samples = full_run_inputs();
  for (std::size_t i = 0; i + 1 < samples.size();
       ++i) {  // the velocity of the last row would arrive after the end
    history.propagate(state, samples[i].imu, epoch_us(i), settings);
    if (samples[i].master_velocity) under_way.emplace_back(i, *samples[i].master_velocity);
    if (!under_way.empty() && under_way.front().first + late <= i) {
      const auto [sample, velocity] = under_way.front();
      under_way.pop_front();
      EXPECT_EQ(history.update(state, velocity, epoch_us(sample), settings).outcome, Outcome::ok);
    }
  }
  for (const auto& [sample, velocity] : under_way)
    EXPECT_EQ(history.update(state, velocity, epoch_us(sample), settings).outcome, Outcome::ok);
  return state;
}

TEST(History, LateUpdatesGiveTheStateOfUpdatesInTimeBitForBit) {
  const Settings settings;
  State in_time = initial(published_start(), settings);
  const std::vector<Sample> samples = full_run_inputs();
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    propagate(in_time, samples[i].imu, settings);
    if (samples[i].master_velocity) update(in_time, *samples[i].master_velocity, settings);
  }
  // The velocities are 0 to 200 ms late. If they are more than 100 ms late, two velocities are under way at a
  // time.
  for (const std::size_t late : {0, 1, 3, 7, 10, 15, 20}) {
    SCOPED_TRACE(late);
    expect_same_bits(run_late(late), in_time);
  }
}

class HistoryOfOneSecond : public testing::Test {
 protected:
  HistoryOfOneSecond() : state(initial(published_start(), settings)), history(0) {
    for (std::size_t i = 0; i < 100; ++i)
      history.propagate(state, flight_increment(flight_start(), 0, 0.01), epoch_us(i), settings);
  }
  Settings settings;
  State state;
  History<capacity> history;
  const Vector3d velocity = flight_start().v_eb_n;
};

TEST_F(HistoryOfOneSecond, RefusesWhatIsOlderThanItself) {
  const State before = state;
  const std::int64_t oldest_us = 1'000'000 - 10'000 * static_cast<std::int64_t>(capacity);
  EXPECT_EQ(history.update(state, velocity, oldest_us - 1, settings).outcome, Outcome::older_than_history);
  expect_same_bits(state, before);
  EXPECT_EQ(history.update(state, velocity, oldest_us, settings).outcome, Outcome::ok);
}

TEST_F(HistoryOfOneSecond, RefusesWhatIsNotReachedYet) {
  const State before = state;
  EXPECT_EQ(history.update(state, velocity, 1'000'001, settings).outcome, Outcome::not_reached);
  expect_same_bits(state, before);
}

TEST_F(HistoryOfOneSecond, RefusesWhatIsOlderThanTheLastUpdate) {
  ASSERT_EQ(history.update(state, velocity, 900'000, settings).outcome, Outcome::ok);
  const State before = state;
  EXPECT_EQ(history.update(state, velocity, 899'999, settings).outcome, Outcome::out_of_order);
  EXPECT_EQ(history.update(state, velocity, 900'000, settings).outcome, Outcome::no_interval);
  expect_same_bits(state, before);
}

// Between epochs the innovation must use the velocity interpolated to the time of validity.
TEST_F(HistoryOfOneSecond, InterpolatesBetweenEpochs) {
  State at_epoch = state, earlier = state, between = state;
  History<capacity> copy_1 = history, copy_2 = history;
  const UpdateResult a = copy_1.update(earlier, velocity, 900'000, settings);
  const UpdateResult b = copy_2.update(at_epoch, velocity, 910'000, settings);
  const UpdateResult m = history.update(between, velocity, 907'500, settings);
  ASSERT_EQ(m.outcome, Outcome::ok);
  const Vector3d expected = a.innovation + 0.75 * (b.innovation - a.innovation);
  EXPECT_GT((b.innovation - a.innovation).norm(), 1e-3);
  EXPECT_LT((m.innovation - expected).norm(), 1e-12);
  EXPECT_EQ(m.innovation_covariance, b.innovation_covariance) << "applied at the later epoch";
}

TEST_F(HistoryOfOneSecond, LeavesTheStateAloneWhenTheUpdateIsRefused) {
  const State before = state;
  const Vector3d nan = Vector3d::Constant(std::nan(""));
  EXPECT_EQ(history.update(state, nan, 950'000, settings).outcome, Outcome::non_finite);
  expect_same_bits(state, before);
}

}  // namespace
}  // namespace canhil::transfer_alignment
