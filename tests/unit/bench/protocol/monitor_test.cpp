#include "bench/protocol/monitor.hpp"

#include <gmock/gmock.h>

#include "bench/checks/timing.hpp"
#include "bench/drive/link.hpp"
#include "bench/estimators/inflight_alignment/answers.hpp"
#include "bench/estimators/los_rate/answers.hpp"
#include "bench/estimators/transfer_alignment/answers.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::protocol {
namespace {

using namespace messages;
using testing::ElementsAre;

// The two times [ns] in a histogram.
std::array<std::int64_t, 2> both(const checks::Histogram& histogram) {
  EXPECT_EQ(histogram.count(), 2U);
  return {histogram.min_ns(), histogram.max_ns()};
}

// Both sides of the bus, as the monitor sees them.
class Watched : public testing::Test {
 protected:
  void sync(std::int64_t t_us) { transmit(Sync{.time_us = static_cast<std::uint64_t>(t_us)}, 0); }
  template <class Message>
  Frame transmit(const Message& message, std::int64_t t_ns, std::int64_t late_ns = 0) {
    const Frame frame = next(bench_, message);
    monitor_.transmitted(frame, t_ns, late_ns);
    return frame;
  }
  void echo(const Frame& frame, std::int64_t t_ns, std::int64_t hardware_ns = 0) {
    monitor_.received({.frame = frame, .t_ns = t_ns, .hardware_ns = hardware_ns, .own = true});
  }
  void imu(std::int64_t t_us, std::int64_t t_ns) {
    transmit(SlaveImuStatus{.time_of_validity_us = wrap_us(t_us)}, t_ns);
  }
  template <class Message>
  void receive(const Message& message, std::int64_t t_ns = 0) {
    monitor_.received({.frame = next(target_, message), .t_ns = t_ns});
  }
  void answer(std::int64_t cause_us, std::int64_t t_ns = 0) {
    receive(AlignAttitude{.heading_deg = 30}, t_ns);
    receive(AlignVelocityNE{.velocity_north_mps = 1, .velocity_east_mps = 2}, t_ns);
    receive(AlignVelocityD{.velocity_down_mps = 3, .cause_time_us = wrap_us(cause_us)}, t_ns);
  }
  void answer_in_flight(std::int64_t cause_us, std::int64_t t_ns = 0) {
    receive(FixAttitude{.heading_deg = 42}, t_ns);
    receive(FixVelocityNE{.velocity_north_mps = 4, .velocity_east_mps = 5}, t_ns);
    receive(FixVelocityD{.velocity_down_mps = 6, .cause_time_us = wrap_us(cause_us)}, t_ns);
  }
  void answer_filter(std::int64_t cause_us, std::int64_t t_ns = 0) {
    receive(AlignInnovation{.innovation_down_mps = 0.5}, t_ns);
    receive(AlignAttitudeSigma{.attitude_sigma_east_rad = 0.01}, t_ns);
    receive(AlignAttitudeCorrelation{.attitude_correlation_nd = 0.25}, t_ns);
    receive(AlignVelocitySigma{}, t_ns);
    receive(AlignGyroBias{.gyro_bias_x_degph = 3.6}, t_ns);
    receive(AlignGyroBiasSigma{}, t_ns);
    receive(AlignAccelBias{}, t_ns);
    receive(AlignAccelBiasSigma{}, t_ns);
    receive(AlignUpdate{.cause_time_us = wrap_us(cause_us), .nis = 2.5}, t_ns);
  }
  void answer_fix(std::int64_t cause_us, FixSource source, std::int64_t t_ns = 0) {
    receive(FixInnovation{.innovation_north_m = 1.5, .innovation_east_m = -2, .innovation_down_m = 3}, t_ns);
    receive(FixPositionLatitude{.latitude_deg = 36, .height_m = -20}, t_ns);
    receive(FixPositionLongitude{.longitude_deg = 129}, t_ns);
    receive(
        FixAttitudeSigma{.tilt_sigma_north_deg = 0.1, .tilt_sigma_east_deg = 0.2, .heading_sigma_deg = 90},
        t_ns);
    receive(FixVelocitySigma{.velocity_sigma_east_mps = 0.25}, t_ns);
    receive(FixPositionSigma{.position_sigma_down_m = 5}, t_ns);
    receive(FixGyroBias{.gyro_bias_x_degph = 3.6}, t_ns);
    receive(FixGyroBiasSigma{}, t_ns);
    receive(FixAccelBias{.accel_bias_z_ug = 100}, t_ns);
    receive(FixAccelBiasSigma{}, t_ns);
    receive(FixBias{.fix_bias_north_m = 2}, t_ns);
    receive(FixBiasSigma{.fix_bias_sigma_north_m = 1}, t_ns);
    receive(FixStatus{.outcome = FixOutcome::gated,
                      .source = source,
                      .handed_over = 1,
                      .repairs = 7,
                      .gated = 8,
                      .refused = 9},
            t_ns);
    receive(FixUpdate{.cause_time_us = wrap_us(cause_us), .nis = 2.5}, t_ns);
  }
  template <class Message>
  static Frame next(Outbox<1>& side, const Message& message) {
    side.clear();
    side.send(message);
    return side.frames().front();
  }
  [[nodiscard]] const checks::Observations& seen() const { return monitor_.observations(); }

  template <class Message>
  [[nodiscard]] const checks::Histogram& latency() const {
    return seen().timing.answers[message_index<Message>()].latency;
  }
  Monitor monitor_{Asked{.own_interval_s = {{AlignVelocityD::info.sample_group, 0.01}}}};
  Outbox<1> bench_;
  Outbox<1> target_;
};

TEST_F(Watched, ALosRateGroupIsOneAnswerOfItsSeekerSample) {
  sync(0);
  transmit(SeekerRange{.time_of_validity_us = 5000}, 5'100'000);
  receive(LosRateEstimate{.los_rate_pitch_radps = 0.01,
                          .los_rate_yaw_radps = -0.02,
                          .outcome = LosRateOutcome::start_up,
                          .fault = LosRateFault::range_invalid,
                          .blind = 1},
          5'300'000);
  receive(LosRateSigma{.los_rate_sigma_pitch_radps = 0.001,
                       .los_rate_sigma_yaw_radps = 0.002,
                       .target_acceleration_sigma_y_mps2 = 5,
                       .target_acceleration_sigma_z_mps2 = 7.5,
                       .nis = 2.5},
          5'400'000);
  receive(
      LosRateTarget{
          .target_acceleration_y_mps2 = 10, .target_acceleration_z_mps2 = -20, .cause_time_us = 5000},
      5'500'000);
  ASSERT_EQ(seen().of<estimators::LosAnswers>().size(), 1U);
  const estimators::LosAnswer& answer = seen().of<estimators::LosAnswers>()[0];
  EXPECT_EQ(answer.cause_us, 5000);
  EXPECT_EQ(answer.outcome, LosRateOutcome::start_up);
  EXPECT_EQ(answer.fault, LosRateFault::range_invalid);
  EXPECT_TRUE(answer.blind);
  EXPECT_NEAR(answer.rate.pitch, 0.01, 1e-9);
  EXPECT_NEAR(answer.rate.yaw, -0.02, 1e-9);
  EXPECT_NEAR(answer.rate_sigma.pitch, 0.001, 1e-9);
  EXPECT_NEAR(answer.rate_sigma.yaw, 0.002, 1e-9);
  EXPECT_EQ(answer.target, (world::Planes<double>{.pitch = -20, .yaw = 10})) << "z in pitch, y in yaw";
  EXPECT_EQ(answer.target_sigma, (world::Planes<double>{.pitch = 7.5, .yaw = 5}));
  EXPECT_NEAR(answer.nis, 2.5, 1e-9);
  EXPECT_EQ(latency<LosRateTarget>().count(), 1U);
  EXPECT_EQ(latency<LosRateTarget>().max_ns(), 400'000);
}

TEST_F(Watched, ANavigationGroupIsOneAnswerInSiUnits) {
  answer(10'000);
  ASSERT_EQ(seen().of<estimators::TransferAnswers>().navigation.size(), 1U);
  EXPECT_EQ(seen().of<estimators::TransferAnswers>().navigation[0].cause_us, 10'000);
  EXPECT_NEAR(seen().of<estimators::TransferAnswers>().navigation[0].angles.heading, 0.5235988, 1e-6);
  EXPECT_TRUE(
      seen().of<estimators::TransferAnswers>().navigation[0].v_eb_n.isApprox(world::Vector3(1, 2, 3), 1e-12));
}

TEST_F(Watched, AFilterGroupIsOneAnswerThatKnowsTheNavigationBeforeIt) {
  answer(90'000);
  answer(100'000);
  answer_filter(60'000);
  answer(110'000);
  ASSERT_EQ(seen().of<estimators::TransferAnswers>().filter.size(), 1U);
  EXPECT_EQ(seen().of<estimators::TransferAnswers>().filter[0].cause_us, 60'000);
  EXPECT_EQ(seen().of<estimators::TransferAnswers>().filter[0].navigation_us, 100'000);
  EXPECT_NEAR(seen().of<estimators::TransferAnswers>().filter[0].nis, 2.5, 1e-12);
  EXPECT_NEAR(seen().of<estimators::TransferAnswers>().filter[0].attitude_sigma.y(), 0.01, 1e-12);
  EXPECT_NEAR(seen().of<estimators::TransferAnswers>().filter[0].attitude_correlation.y(), 0.25, 1e-12);
  EXPECT_NEAR(seen().of<estimators::TransferAnswers>().filter[0].gyro_bias.x(), 1.7453293e-5, 1e-12);
}

TEST_F(Watched, TheTwoAlignmentsAreKeptApart) {
  answer(100'000);
  answer_in_flight(100'000);
  answer_in_flight(200'000);
  EXPECT_EQ(seen().of<estimators::TransferAnswers>().navigation.size(), 1U);
  ASSERT_EQ(seen().of<estimators::InflightAnswers>().navigation.size(), 2U);
  EXPECT_NEAR(seen().of<estimators::InflightAnswers>().navigation[1].angles.heading, 0.7330383, 1e-6);
  EXPECT_TRUE(
      seen().of<estimators::InflightAnswers>().navigation[1].v_eb_n.isApprox(world::Vector3(4, 5, 6), 1e-12));
  EXPECT_EQ(seen().of<estimators::InflightAnswers>().navigation[1].cause_us, 200'000);
}

TEST_F(Watched, AFixGroupIsOneAnswerInSiUnits) {
  answer_in_flight(100'000);
  answer_fix(60'000, FixSource::gps);
  ASSERT_EQ(seen().of<estimators::InflightAnswers>().fixes.size(), 1U);
  const estimators::FixAnswer& fix = seen().of<estimators::InflightAnswers>().fixes[0];
  EXPECT_EQ(fix.cause_us, 60'000);
  EXPECT_EQ(fix.navigation_us, 100'000);
  EXPECT_EQ(fix.source, FixSource::gps);
  EXPECT_EQ(fix.outcome, FixOutcome::gated);
  EXPECT_NEAR(fix.nis, 2.5, 1e-12);
  EXPECT_TRUE(fix.innovation.isApprox(world::Vector3(1.5, -2, 3), 1e-12));
  EXPECT_NEAR(fix.position.latitude, 0.62831853, 1e-8);
  EXPECT_NEAR(fix.position.longitude, 2.25147474, 1e-8);
  EXPECT_NEAR(fix.position.height, -20, 1e-9);
  EXPECT_NEAR(fix.attitude_sigma.x(), 1.7453293e-3, 1e-9);
  EXPECT_NEAR(fix.attitude_sigma.y(), 3.4906585e-3, 1e-9);
  EXPECT_NEAR(fix.attitude_sigma.z(), 1.5707963, 1e-7);
  EXPECT_NEAR(fix.velocity_sigma.y(), 0.25, 1e-12);
  EXPECT_NEAR(fix.position_sigma.z(), 5, 1e-12);
  EXPECT_NEAR(fix.gyro_bias.x(), 1.7453293e-5, 1e-12);
  EXPECT_NEAR(fix.accel_bias.z(), 9.80665e-4, 1e-9);
  EXPECT_NEAR(fix.fix_bias.x(), 2, 1e-12);
  EXPECT_NEAR(fix.fix_bias_sigma.x(), 1, 1e-12);
  EXPECT_TRUE(fix.handed_over);
  EXPECT_EQ(std::tuple(fix.repairs, fix.gated, fix.refused), std::tuple(7U, 8U, 9U));
  EXPECT_TRUE(fix.repaired) << "no repair was reported before";
}

TEST_F(Watched, AFixIsPairedWithTheGroupOfItsSource) {
  transmit(SsblRelativeD{.time_of_validity_us = 1'000'000}, 1'000);
  transmit(GpsTime{.time_of_validity_us = 1'000'000}, 2'000);
  answer_fix(1'000'000, FixSource::gps, 2'500);
  answer_fix(1'000'000, FixSource::ssbl, 4'000);
  EXPECT_THAT(both(latency<FixUpdate>()), ElementsAre(500, 3'000));
  EXPECT_EQ(latency<FixStatus>().count(), 2U);
}

TEST_F(Watched, KeepsStimuliByTheGroupsThatAreAnswered) {
  imu(10'000, 1'000);
  transmit(MasterInsVelocityD{.time_of_validity_us = 20'000}, 2'000);
  transmit(SsblRelativeD{.time_of_validity_us = 30'000}, 3'000);
  transmit(GpsTime{.time_of_validity_us = 40'000}, 4'000);
  transmit(TargetInitVelocityD{.time_of_validity_us = 50'000}, 5'000);
  ASSERT_EQ(seen().stimuli.size(), 4U) << "nobody answers TargetInit";
  EXPECT_EQ(seen().stimuli.at("SlaveImu").last_us, 10'000);
  EXPECT_EQ(seen().stimuli.at("MasterIns").last_us, 20'000);
  EXPECT_EQ(seen().stimuli.at("Ssbl").last_us, 30'000);
  EXPECT_EQ(seen().stimuli.at("Gps").last_us, 40'000);
  ASSERT_EQ(seen().of<estimators::InflightAnswers>().sent.size(), 2U);
  EXPECT_EQ(seen().of<estimators::InflightAnswers>().sent[0].source, FixSource::ssbl);
  EXPECT_EQ(seen().of<estimators::InflightAnswers>().sent[1].source, FixSource::gps);
  EXPECT_EQ(seen().of<estimators::InflightAnswers>().sent[1].valid_us, 40'000);
}

TEST_F(Watched, AnAnswerToTwoRhythmsHasNoNominalPeriod) {
  for (std::int64_t second = 1; second <= 4; ++second)
    transmit(SsblRelativeD{.time_of_validity_us = wrap_us(second * 2'000'000)}, second);
  EXPECT_DOUBLE_EQ(checks::nominal_period_s(seen(), "FixUpdate"), 2.0);
  transmit(GpsTime{.time_of_validity_us = 500'000}, 9);
  EXPECT_DOUBLE_EQ(checks::nominal_period_s(seen(), "FixUpdate"), 0.0);
}

TEST_F(Watched, LatencyIsPairedByCauseNotByOrder) {
  imu(10'000, 1'000);
  imu(20'000, 2'000);
  imu(30'000, 3'000);
  answer(10'000, 4'000);
  answer(30'000, 3'500);
  EXPECT_THAT(both(latency<AlignVelocityD>()), ElementsAre(500, 3'000));
}

TEST_F(Watched, TheStampOfTheEchoReplacesTheBenchsOwn) {
  imu(10'000, 1'000);
  const Frame frame = transmit(SlaveImuStatus{.time_of_validity_us = 20'000}, 2'000);
  imu(30'000, 3'000);
  EXPECT_FALSE(seen().transmit_stamps_echoed);
  echo(frame, 2'700);
  EXPECT_TRUE(seen().transmit_stamps_echoed);
  answer(20'000, 3'700);
  EXPECT_EQ(latency<AlignVelocityD>().max_ns(), 1'000);
  answer(10'000, 3'700);
  EXPECT_EQ(latency<AlignVelocityD>().max_ns(), 2'700) << "the others keep theirs";
}

TEST_F(Watched, TheControllersStampsAreKept) {
  const Frame frame = transmit(SlaveImuStatus{.time_of_validity_us = 20'000}, 2'000);
  echo(frame, 2'700, 42);
  monitor_.received({.frame = next(target_, TargetHeartbeat{}), .t_ns = 1, .hardware_ns = 43});
  const checks::Observations all = monitor_.finish();
  EXPECT_EQ(all.timing.stimuli_with_hardware_stamp, 1U);
  EXPECT_EQ(all.timing.without_hardware_stamp, 0U);
}

TEST_F(Watched, AnEchoIsNoAnswer) {
  echo(next(target_, AlignVelocityD{}), 0);
  echo(next(target_, TargetHeartbeat{}), 0);
  EXPECT_FALSE(seen().timing.answers[message_index<TargetHeartbeat>()].last_ns);
  EXPECT_FALSE(seen().timing.answers[message_index<AlignVelocityD>()].last_ns);
}

TEST_F(Watched, CausesUnwrapAroundTheTimeBase) {
  const std::int64_t late_us = (std::int64_t{1} << 32) + 5'000;
  sync(late_us - 10'000);
  imu(late_us, 1'000);
  answer(late_us, 2'000);
  EXPECT_EQ(seen().of<estimators::TransferAnswers>().navigation.back().cause_us, late_us);
  EXPECT_EQ(latency<AlignVelocityD>().count(), 1U);
}

TEST_F(Watched, AGapInTheCountersIsCountedAsLostFrames) {
  receive(TargetHeartbeat{});
  for (int k = 0; k < 3; ++k) static_cast<void>(next(target_, TargetHeartbeat{}));
  receive(TargetHeartbeat{});
  EXPECT_EQ(seen().lost_from_target(), 3U);
}

TEST_F(Watched, AGroupThatMissesAFrameIsNoAnswer) {
  answer(10'000);
  receive(AlignAttitude{});
  static_cast<void>(next(target_, AlignVelocityNE{}));
  receive(AlignVelocityD{.cause_time_us = 20'000});
  EXPECT_EQ(seen().of<estimators::TransferAnswers>().navigation.size(), 1U);
  EXPECT_EQ(seen().answers[message_index<AlignVelocityD>()], 1U);
  answer(30'000);
  EXPECT_EQ(seen().of<estimators::TransferAnswers>().navigation.size(), 2U);
  EXPECT_EQ(seen().lost_from_target(), 1U);
}

TEST_F(Watched, ABrokenFrameIsCountedAndNotUsed) {
  Frame frame = next(target_, TargetHeartbeat{});
  frame.data[5] ^= 1U;
  monitor_.received({.frame = frame});
  frame.size = 3;
  monitor_.received({.frame = frame});
  EXPECT_EQ(seen().spoilt_from_target(), 2U);
  EXPECT_FALSE(seen().timing.answers[message_index<TargetHeartbeat>()].last_ns);
}

TEST_F(Watched, ARepeatedFrameIsNotUsed) {
  const Frame frame = next(target_, TargetHeartbeat{});
  monitor_.received({.frame = frame});
  monitor_.received({.frame = frame});
  EXPECT_EQ(seen().timing.stamps[static_cast<std::size_t>(StampSource::process)], 1U);
}

TEST_F(Watched, RemembersHowLateTheBenchWasAndWhenItBeganAndEnded) {
  transmit(Sync{}, 100, 7);
  transmit(Sync{}, 300, 9);
  EXPECT_EQ(seen().timing.lateness.min_ns(), 7);
  EXPECT_EQ(seen().timing.lateness.max_ns(), 9);
  EXPECT_EQ(seen().timing.lateness.count(), 2U);
  EXPECT_EQ(seen().first_ns, 100);
  EXPECT_EQ(seen().last_ns, 300);
}

// The stimulus is due at 100 us, written 20 us late, and on the bus 5 us later. The target answers the
// stimulus.
TEST_F(Watched, TakesTheTimesOfEveryMessageOfAnAnswer) {
  const auto stimulate = [&](std::int64_t valid_us, std::int64_t due_ns, std::int64_t late_ns) {
    echo(transmit(SlaveImuStatus{.time_of_validity_us = wrap_us(valid_us)}, due_ns + late_ns, late_ns),
         due_ns + late_ns + 5'000);
  };
  sync(0);
  stimulate(10'000, 100'000, 20'000);
  answer(10'000, 325'000);
  stimulate(20'000, 10'100'000, 40'000);
  answer(20'000, 10'445'000);
  const auto& answers = seen().timing.answers[message_index<AlignVelocityD>()];
  EXPECT_EQ(answers.latency.count(), 2U);
  EXPECT_EQ(answers.latency.min_ns(), 200'000) << "from the echo, not from the hand-over";
  EXPECT_EQ(answers.latency.max_ns(), 300'000);
  EXPECT_EQ(answers.jitter.count(), 1U);
  EXPECT_EQ(answers.jitter.max_ns(), 120'000) << "10.120 ms between answers to what was due 10 ms apart";
  EXPECT_EQ(seen().timing.answers[message_index<AlignAttitude>()].latency.count(), 2U);
  const auto& transmitted = seen().timing.transmit[message_index<SlaveImuStatus>()];
  EXPECT_EQ(transmitted.handed_over.max_ns(), 40'000);
  EXPECT_EQ(transmitted.echoed.min_ns(), 25'000);
  EXPECT_EQ(transmitted.echoed.max_ns(), 45'000);
  EXPECT_EQ(checks::unanswered(seen(), AlignVelocityD::info.name), 0U);
}

TEST_F(Watched, CountsAnswersThatNeverCameAndThoseToNothing) {
  sync(0);
  imu(10'000, 0);
  imu(20'000, 10'000'000);
  imu(30'000, 20'000'000);
  answer(10'000, 100'000);
  answer(30'000, 20'100'000);
  EXPECT_EQ(checks::unanswered(seen(), AlignVelocityD::info.name), 1U);
  answer(35'000, 25'000'000);
  const auto& answers = seen().timing.answers[message_index<AlignVelocityD>()];
  EXPECT_EQ(answers.unpaired, 1U);
  EXPECT_EQ(answers.nearest_us, 5'000);
  EXPECT_EQ(answers.wrong_counter, 1U) << "the answers say 0, which is that of the first";
  EXPECT_EQ(answers.counter_sent, 2);
  EXPECT_EQ(answers.latency.count(), 2U);
  EXPECT_EQ(answers.repeated, 0U);
}

TEST_F(Watched, CountsAnswersToWhatWasAnsweredBefore) {
  sync(0);
  imu(10'000, 0);
  answer(10'000, 100'000);
  answer_in_flight(10'000, 100'000);  // an answer of another estimator
  EXPECT_EQ(seen().timing.answers[message_index<FixVelocityD>()].repeated, 0U);
  answer(10'000, 200'000);
  EXPECT_EQ(seen().timing.answers[message_index<AlignVelocityD>()].repeated, 1U);
}

TEST_F(Watched, JitterOfACyclicMessageIsAgainstItsCycle) {
  const std::int64_t cycle_ns = std::int64_t{TargetHeartbeat::info.cycle_time_us} * 1000;
  receive(TargetHeartbeat{}, 0);
  receive(TargetHeartbeat{}, cycle_ns + 30'000);
  receive(TargetHeartbeat{}, 2 * cycle_ns);
  const checks::Histogram& jitter = seen().timing.answers[message_index<TargetHeartbeat>()].jitter;
  EXPECT_EQ(jitter.count(), 2U);
  EXPECT_EQ(jitter.max_ns(), 30'000);
  EXPECT_EQ(jitter.min_ns(), 30'000);
}

TEST_F(Watched, AFrameThatIsNotEchoedHasNoTimeOnTheBus) {
  transmit(Sync{.time_us = 1}, 0, 10);
  const Frame second = transmit(Sync{.time_us = 2}, 1'000, 10);
  echo(second, 3'000);
  echo(second, 9'000);
  const auto& transmitted = seen().timing.transmit[message_index<Sync>()];
  EXPECT_EQ(transmitted.handed_over.count(), 2U);
  EXPECT_EQ(transmitted.echoed.count(), 1U) << "an echo is used once";
  EXPECT_EQ(transmitted.echoed.max_ns(), 2'010);
}

TEST_F(Watched, AnswersToWhatIsLongPastAnswerNothing) {
  for (std::size_t k = 0; k <= observe::Stopwatch::remembered; ++k)
    imu(static_cast<std::int64_t>(k) * 5'000, 0);
  answer(0);
  EXPECT_EQ(latency<AlignVelocityD>().count(), 0U);
  EXPECT_EQ(seen().timing.answers[message_index<AlignVelocityD>()].unpaired, 1U);
  answer(5'000);
  EXPECT_EQ(latency<AlignVelocityD>().count(), 1U);
}

// At 1 Mbit/s a bit takes 1 us, so the duration of a frame in us is its length in bits.
class OnAWire : public Watched {
 protected:
  OnAWire() : monitor_at_rate_(Asked{.wire = {.rates = {.nominal = 1'000'000}}}) {}
  static std::int64_t ns(const Frame& frame) { return wire::bit_length(frame).nominal * 1000; }

  Monitor monitor_at_rate_;
};

TEST_F(OnAWire, TheLatencyIsSplitAndItsPartsAddUp) {
  const Frame imu = next(bench_, SlaveImuStatus{.time_of_validity_us = 10'000});
  const std::array<Frame, 3> reply{next(target_, AlignAttitude{}), next(target_, AlignVelocityNE{}),
                                   next(target_, AlignVelocityD{.cause_time_us = 10'000})};
  const Frame filler = next(
      target_,
      TargetTiming{.queue_max_us = 60, .queue_mean_us = 50, .compute_max_us = 40, .compute_mean_us = 30});
  monitor_at_rate_.transmitted(imu, 1'000'000, 0);
  monitor_at_rate_.received({.frame = imu, .t_ns = 1'200'000, .own = true});
  std::int64_t t_ns = 1'300'000, wire_ns = 0;
  for (const Frame& frame : reply) {
    wire_ns += ns(frame);
    monitor_at_rate_.received({.frame = frame, .t_ns = t_ns += ns(frame)});
  }
  monitor_at_rate_.received({.frame = filler, .t_ns = t_ns + 1'000});
  const checks::TimingRecord timing = monitor_at_rate_.finish().timing;
  EXPECT_EQ(timing.breakdown.stimuli, 1U);
  EXPECT_EQ(timing.breakdown.echoed, 1U);
  EXPECT_EQ(timing.breakdown.to_echo_ns, 200'000);
  EXPECT_EQ(timing.breakdown.stimulus_wire_ns, ns(imu));
  EXPECT_EQ(timing.breakdown.latency_ns, 100'000 + wire_ns);
  EXPECT_EQ(timing.breakdown.reply_wire_ns, wire_ns);
  EXPECT_EQ(timing.breakdown.accounted, 1U);
  EXPECT_EQ(timing.breakdown.target_queue_ns, 50'000);
  EXPECT_EQ(timing.breakdown.target_compute_ns, 30'000);
  EXPECT_EQ(timing.slowest.message, "AlignVelocityD");
  EXPECT_EQ(timing.slowest.latency_ns, 100'000 + wire_ns);
  EXPECT_EQ(timing.slowest.queue_max_us, 60);
  EXPECT_EQ(timing.slowest.compute_max_us, 40);
  EXPECT_EQ(timing.answers[message_index<AlignAttitude>()].reply_wire_ns, ns(reply[0]));
  EXPECT_EQ(timing.answers[message_index<AlignVelocityD>()].reply_wire_ns, wire_ns);
  EXPECT_EQ(timing.responses[message_index<SlaveImuStatus>()].max_ns, 200'000);
  EXPECT_EQ(timing.responses[message_index<AlignAttitude>()].max_ns, ns(reply[0]));
  EXPECT_EQ(timing.responses[message_index<AlignVelocityD>()].max_ns, wire_ns);
}

// IMU samples are answered after 0.5 ms, samples of the master INS after 3 ms.
TEST_F(OnAWire, EachGroupOfStimuliHasASplitOfItsOwn) {
  for (const std::int64_t t_us : {10'000, 20'000}) {
    imu(t_us, 1000 * t_us);
    answer(t_us, 1000 * t_us + 500'000);
  }
  transmit(MasterInsVelocityD{.time_of_validity_us = 20'000}, 20'000'000);
  answer_filter(20'000, 23'000'000);
  const auto& all = seen().timing.breakdown_by_group;
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].group, SlaveImuStatus::info.sample_group);
  EXPECT_EQ(all[0].breakdown.stimuli, 2U);
  EXPECT_EQ(all[0].breakdown.latency_ns, 1'000'000);
  EXPECT_EQ(all[1].group, MasterInsVelocityD::info.sample_group);
  EXPECT_EQ(all[1].breakdown.stimuli, 1U);
  EXPECT_EQ(all[1].breakdown.latency_ns, 3'000'000);
  EXPECT_EQ(seen().timing.breakdown.stimuli, 3U);
}

TEST_F(OnAWire, AMeanAtTheEndOfItsRangeIsKnownToBeOne) {
  imu(10'000, 0);
  answer(10'000, 9'000'000);
  receive(
      TargetTiming{.queue_max_us = 8191, .queue_mean_us = 8191, .compute_max_us = 40, .compute_mean_us = 30});
  EXPECT_TRUE(seen().timing.breakdown.queue_clipped);
  EXPECT_FALSE(seen().timing.breakdown.compute_clipped);
}

// One stimulus, answered by two estimators: the response ends with the second answer.
TEST_F(OnAWire, AStimulusIsAnsweredWithItsLastAnswer) {
  imu(10'000, 0);
  answer(10'000, 300'000);
  answer_in_flight(10'000, 500'000);
  EXPECT_EQ(seen().timing.breakdown.stimuli, 1U);
  EXPECT_EQ(seen().timing.breakdown.latency_ns, 500'000);
  EXPECT_EQ(seen().timing.breakdown.echoed, 0U);
  EXPECT_EQ(seen().timing.breakdown.accounted, 0U);
}

}  // namespace
}  // namespace canhil::protocol
