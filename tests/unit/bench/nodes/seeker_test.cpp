// The messages of the seeker in an engagement, and the guidance that uses the target's answers.
#include "bench/sensors/seeker.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "bench/nodes/registry.hpp"
#include "bench/plant/engagement/engagement.hpp"
#include "dbc/wire/time_base.hpp"
#include "tests/unit/bench/nodes/exact_seeker.hpp"
#include "tests/unit/bench/plant/engagement/flown.hpp"

namespace canhil::nodes {
namespace {

using namespace sensors;

using namespace messages;
using plant::engagement::Epoch;
using plant::engagement::Flown;

// A flight record as long as the run.
const world::FlightRecord& flight() {
  static const world::FlightRecord record({.start = {}, .motion = world::Rest{}}, 8'000'000, 10'000);
  return record;
}

struct Sample {
  std::int64_t due_us = 0;
  std::uint8_t counter = 0;
  SeekerAntenna antenna;
  SeekerAngles angles;
  SeekerMotion motion;
  SeekerRange range;
};

template <class Message>
Message message(const Transmission& out, std::size_t place) {
  EXPECT_EQ(out.frames()[place].id, Message::info.id);
  return from_frame<Message>(out.frames()[place]);
}

/// A seeker with its record and its outbox.
class Bench {
 public:
  explicit Bench(const SeekerSettings& config = {}, const plant::engagement::Settings& settings = {})
      : flown_(settings, config.schedule.period_us.value_or(5000)),
        node_(make({bound(seeker).table, config},
                   {.scenario = with(flown_),
                    .index = 0,
                    .flight = flight(),
                    .plants = {&flown_.record()},
                    .guide = [this](std::int64_t from_us, std::span<const double> inputs) {
                      flown_.simulation().guide(from_us, inputs);
                    }})) {}

  /// The next sample; none if it was lost or the engagement has ended.
  std::optional<Sample> next() {
    out_.clear();
    const std::int64_t due_us = node_->due_us();
    flown_.simulation().advance(due_us);
    node_->transmit(out_);
    if (out_.frames().empty()) return std::nullopt;
    EXPECT_EQ(out_.frames().size(), 4U);
    return Sample{.due_us = due_us,
                  .counter = e2e::counter(out_.frames()[0].payload()),
                  .antenna = message<SeekerAntenna>(out_, 0),
                  .angles = message<SeekerAngles>(out_, 1),
                  .motion = message<SeekerMotion>(out_, 2),
                  .range = message<SeekerRange>(out_, 3)};
  }
  std::vector<Sample> all() {
    std::vector<Sample> samples;
    while (node_->due_us() != never_us) {
      if (const auto sample = next()) samples.push_back(*sample);
    }
    return samples;
  }

  /// The target's answer to a sample, as received from the bus.
  void answer(std::int64_t cause_us, world::Planes<double> rate,
              LosRateOutcome outcome = LosRateOutcome::updated, bool blind = false, bool spoilt = false,
              world::Planes<double> target = {}) {
    answers_.clear();
    answers_.send(LosRateEstimate{.los_rate_pitch_radps = rate.pitch,
                                  .los_rate_yaw_radps = rate.yaw,
                                  .outcome = outcome,
                                  .blind = static_cast<std::uint8_t>(blind)});
    answers_.send(LosRateSigma{});
    answers_.send(LosRateTarget{.target_acceleration_y_mps2 = target.yaw,
                                .target_acceleration_z_mps2 = target.pitch,
                                .cause_time_us = wrap_us(cause_us)});
    for (Frame frame : answers_.frames()) {
      if (spoilt) frame.data[3] ^= 1U;
      node_->hear(frame, 0);
    }
  }

  Node& node() { return *node_; }
  [[nodiscard]] const Flown& flown() const { return flown_; }

 private:
  const scenario::Scenario& with(const Flown& flown) {
    scenario_.seed = 1;
    scenario_.of_tables = {flown.facts()};
    return scenario_;
  }
  scenario::Scenario scenario_;
  Flown flown_;
  std::unique_ptr<Node> node_;
  Transmission out_;
  Outbox<3> answers_;
};

SeekerSettings exact() {
  SeekerSettings config;
  config.errors = exact_seeker;
  return config;
}

TEST(Seeker, SendsTheTruthOfEachSampleRoundedToTheBus) {
  Bench bench(exact());
  const std::vector<Sample> samples = bench.all();
  std::vector<Epoch> epochs;
  for (std::size_t i = 0; i < bench.flown().epochs(); ++i) epochs.push_back(bench.flown().epoch(i));
  ASSERT_EQ(samples.size(), epochs.size());
  ASSERT_GT(samples.size(), 1000U);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto& [due_us, counter, antenna, angles, motion, range] = samples[i];
    ASSERT_EQ(due_us, 5000 * (static_cast<std::int64_t>(i) + 1));
    ASSERT_EQ(range.time_of_validity_us, wrap_us(epochs[i].t_us));
    ASSERT_EQ(epochs[i].t_us, due_us);
    ASSERT_EQ(counter, i % 15);
    ASSERT_EQ(angles.interval_us, 5000);
    if (epochs[i].range < 100) continue;  // below 100 m, all quantities change too fast within a sample
    ASSERT_NEAR(angles.error_pitch_rad, epochs[i].error.pitch, 1e-5 + 1e-12);
    ASSERT_NEAR(angles.error_yaw_rad, epochs[i].error.yaw, 1e-5 + 1e-12);
    ASSERT_NEAR(range.range_m, epochs[i].range, 0.05 + 1e-9);
    ASSERT_NEAR(motion.closing_speed_mps, epochs[i].closing_speed, 0.25 + 1e-9);
    if (i > 0) {  // mean over the step: the trapezium rule errs by T^2/12 times the second derivative
      const double y = (epochs[i - 1].missile.yaw + epochs[i].missile.yaw) / 2;
      const double z = (epochs[i - 1].missile.pitch + epochs[i].missile.pitch) / 2;
      ASSERT_NEAR(motion.missile_acceleration_y_mps2, y, 0.01 + 0.02) << range.range_m;
      ASSERT_NEAR(motion.missile_acceleration_z_mps2, z, 0.01 + 0.02) << range.range_m;
    }
    ASSERT_EQ(angles.error_validity, Validity::valid);
    ASSERT_EQ(range.range_validity, Validity::valid);
  }
  EXPECT_TRUE(bench.flown().miss_n().has_value());
  EXPECT_NEAR(static_cast<double>(bench.flown().record().ended_us.value()),
              static_cast<double>(epochs.back().t_us), 5000);
}

TEST(Seeker, IncrementsCarryTheirRemainders) {
  Bench bench(exact());
  double sent = 0;
  std::vector<double> sums;
  for (const Sample& sample : bench.all()) sums.push_back(sent += sample.antenna.antenna_increment_pitch_rad);
  // The sum of the sent increments equals the true rotation of the antenna within half a step, at any time.
  plant::engagement::Engagement same({}, world::Stream(1, 0, "engagement"));
  double turned = 0;
  for (std::size_t i = 0; i < 1000; ++i) {
    same.fly_to(5000 * (static_cast<std::int64_t>(i) + 1));
    turned += same.take_increment().delta_theta.y();
    ASSERT_NEAR(sums[i], turned, 0.5e-6 + 1e-12);
  }
}

TEST(Seeker, LatencyAndJitterDelayWhatIsSentNotWhenItIsValid) {
  SeekerSettings config = exact();
  config.schedule = {.period_us = 2000, .latency_us = 3000};
  config.jitter_us = 4000;
  Bench bench(config);
  std::int64_t before_us = 0, least = 1'000'000, most = 0;
  for (const Sample& sample : bench.all()) {
    const std::int64_t delay = sample.due_us - static_cast<std::int64_t>(sample.range.time_of_validity_us);
    least = std::min(least, delay);
    most = std::max(most, delay);
    ASSERT_GE(sample.due_us, before_us) << "in the order of sampling";
    before_us = sample.due_us;
    ASSERT_EQ(sample.angles.interval_us, 2000);
  }
  EXPECT_GE(least, 3000);
  EXPECT_LT(least, 3300);
  EXPECT_LE(most, 7000);
  EXPECT_GT(most, 6700);
}

TEST(Seeker, ALostGroupIsCountedAsSent) {
  SeekerSettings config = exact();
  config.loss_probability = 0.2;
  Bench bench(config);
  const std::vector<Sample> samples = bench.all();
  const auto flown = static_cast<double>(bench.flown().epochs());
  const double lost = flown - static_cast<double>(samples.size());
  EXPECT_NEAR(lost / flown, 0.2, 5 * std::sqrt(0.2 * 0.8 / flown));
  for (const Sample& sample : samples)
    ASSERT_EQ(sample.counter, (sample.range.time_of_validity_us / 5000 - 1) % 15);
}

TEST(Seeker, LossesChangeNoMeasurement) {
  SeekerSettings faulty;
  faulty.loss_probability = 0.3;
  faulty.invalid_probability = 0.3;
  faulty.jitter_us = 1000;
  Bench clean, spoilt(faulty);
  const std::vector<Sample> all = clean.all();
  for (const Sample& sample : spoilt.all()) {
    const Sample& same = all[sample.range.time_of_validity_us / 5000 - 1];
    ASSERT_EQ(sample.range.range_m, same.range.range_m);
    if (sample.angles.error_validity == Validity::invalid) continue;
    ASSERT_EQ(sample.angles.error_yaw_rad, same.angles.error_yaw_rad);
  }
}

TEST(Seeker, FlagsWhatItDoesNotSee) {
  SeekerSettings config;
  config.blackout_us = {1'000'000, 1'200'000};
  config.invalid_range_probability = 0.1;
  Bench bench(config);
  int no_range = 0;
  for (const Sample& sample : bench.all()) {
    const auto t_us = static_cast<std::int64_t>(sample.range.time_of_validity_us);
    const bool black = t_us >= 1'000'000 && t_us <= 1'200'000;
    ASSERT_EQ(sample.range.range_validity, sample.motion.closing_speed_validity);
    no_range += sample.range.range_validity == Validity::invalid ? 1 : 0;
    if (t_us > 4'000'000) continue;  // at the end the target leaves the field of view
    ASSERT_EQ(sample.angles.error_validity, black ? Validity::invalid : Validity::valid) << t_us;
  }
  EXPECT_GT(no_range, 70);
  EXPECT_LT(no_range, 150);
  SeekerSettings narrow;
  narrow.errors.field_of_view = 1e-4;
  Bench blind(narrow);
  EXPECT_EQ(blind.next()->angles.error_validity, Validity::invalid) << "the antenna starts 5 mrad off";
}

// Closed loop: guidance uses the answers that the node receives.
class GuidedSeeker : public testing::Test {
 protected:
  static plant::engagement::Settings guided() {
    plant::engagement::Settings plan;
    plan.guidance = plant::engagement::Guidance::target;
    plan.guidance_delay_us = 10'000;
    return plan;
  }
  /// The miss distance when `answer` answers each sample.
  template <class Answer>
  double miss(Bench& bench, Answer answer) {
    while (bench.node().due_us() != never_us) {
      const auto sample = bench.next();
      if (!sample) break;
      answer(bench, bench.flown().epoch(sample->range.time_of_validity_us / 5000 - 1));
    }
    return bench.flown().miss_n().value().norm();
  }
  static void truthful(Bench& bench, const Epoch& epoch) { bench.answer(epoch.t_us, epoch.los_rate); }
};

TEST_F(GuidedSeeker, FliesOnTheAnswers) {
  Bench bench(exact(), guided());
  EXPECT_TRUE(bench.node().listens());
  EXPECT_LT(miss(bench, truthful), 0.5);
  EXPECT_EQ(bench.flown().record().late, 0U);
  Bench deaf(exact(), guided());
  EXPECT_GT(miss(deaf, [](Bench&, const auto&) {}), 20) << "without answers it flies straight on";
  EXPECT_FALSE(Bench(exact()).node().listens()) << "guided by the truth";
}

TEST_F(GuidedSeeker, AnswersInTheAxesOfARollingAntenna) {
  plant::engagement::Settings rolling = guided();
  rolling.roll_rate = 3;
  Bench bench(exact(), rolling);
  EXPECT_LT(miss(bench, truthful), 0.5);
}

// A command is due 100 ms after its sample, and the target manoeuvres. Therefore the seeker extrapolates each
// answer from the time of its sample to the time of the command. A missing term or a wrong sign increases the
// miss distance by half a metre or more.
TEST_F(GuidedSeeker, ReckonsTheAnswerOnToItsUse) {
  SeekerSettings late = exact();
  late.schedule.latency_us = 90'000;
  const auto with_acceleration = [](Bench& bench, const Epoch& epoch) {
    bench.answer(epoch.t_us, epoch.los_rate, LosRateOutcome::updated, false, false, epoch.target);
  };
  for (const double roll : {0.0, 3.0}) {
    plant::engagement::Settings plan = guided();
    plan.roll_rate = roll;
    Bench as_it_was(late, plan);
    const double before = miss(as_it_was, with_acceleration);
    plan.guidance_predicts = true;
    Bench predicting(late, plan), unaware(late, plan);
    EXPECT_GT(before, 1);
    EXPECT_LT(miss(predicting, with_acceleration), 0.25 * before);
    EXPECT_GT(miss(unaware, truthful), 0.5 * before) << "without the target's acceleration";
    EXPECT_EQ(predicting.flown().record().late, 0U);
  }
}

TEST_F(GuidedSeeker, HoldsItsCommandOnAnswersThatAreNoEstimate) {
  const auto nonsense = [](LosRateOutcome outcome, bool blind, bool spoilt) {
    return [=](Bench& bench, const Epoch& epoch) {
      if (epoch.t_us % 10'000 == 0) return truthful(bench, epoch);
      bench.answer(epoch.t_us, {.pitch = 1, .yaw = -1}, outcome, blind, spoilt);
    };
  };
  for (const auto outcome : {LosRateOutcome::waiting, LosRateOutcome::bad_step, LosRateOutcome::non_finite}) {
    Bench bench(exact(), guided());
    EXPECT_LT(miss(bench, nonsense(outcome, false, false)), 0.5);
  }
  Bench blind(exact(), guided()), broken(exact(), guided()), believed(exact(), guided());
  EXPECT_LT(miss(blind, nonsense(LosRateOutcome::updated, true, false)), 0.5);
  EXPECT_LT(miss(broken, nonsense(LosRateOutcome::updated, false, true)), 0.5) << "a broken frame";
  EXPECT_GT(miss(believed, nonsense(LosRateOutcome::updated, false, false)), 5);
}

TEST_F(GuidedSeeker, TheSameFlightHoweverEarlyAnswersAreHeard) {
  Bench at_once(exact(), guided()), in_pairs(exact(), guided());
  const double first = miss(at_once, truthful);
  const double second = miss(in_pairs, [](Bench& bench, const Epoch& epoch) {
    // Samples are taken every 5 ms; every 10 ms, the answers to the last two samples arrive together.
    if (epoch.t_us % 10'000 != 0) return;
    if (bench.flown().epochs() > 1) truthful(bench, bench.flown().epoch(bench.flown().epochs() - 2));
    truthful(bench, epoch);
  });
  EXPECT_EQ(first, second);
}

TEST_F(GuidedSeeker, LateAnswersAreCounted) {
  Bench bench(exact(), guided());
  for (int i = 0; i < 5; ++i) bench.next();
  bench.answer(5000, {});
  EXPECT_EQ(bench.flown().record().late, 1U) << "flown to 25 ms, due at 15 ms";
  bench.answer(20'000, {});
  EXPECT_EQ(bench.flown().record().late, 1U);
}

}  // namespace
}  // namespace canhil::nodes
