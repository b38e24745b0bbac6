// Every kind of check: what passes, what fails, what cannot be measured. Silence never passes.
#include "bench/checks/judge.hpp"
#include "bench/bindings/canhil.hpp"
#include "bench/estimators/transfer_alignment/answers.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "bench/checks/kinds/bus_errors.hpp"
#include "bench/checks/kinds/consistency.hpp"
#include "bench/checks/kinds/convergence.hpp"
#include "bench/checks/kinds/counters.hpp"
#include "bench/checks/kinds/counts_match.hpp"
#include "bench/checks/kinds/heartbeat.hpp"
#include "bench/checks/kinds/honest.hpp"
#include "bench/checks/kinds/latency.hpp"
#include "bench/checks/kinds/output_period.hpp"
#include "bench/checks/kinds/sigma.hpp"
#include "bench/checks/kinds/sigma_grows.hpp"
#include "bench/checks/timing.hpp"
#include "bench/estimators/transfer_alignment/quantities.hpp"
#include "bench/estimators/transfer_alignment/transfer_alignment.hpp"
#include "bench/observe/stopwatch.hpp"
#include "dbc/wire/transmit.hpp"
#include "tests/unit/bench/checks/judged.hpp"
#include "tests/unit/bench/edited.hpp"

namespace canhil::checks {
namespace {

using namespace estimators;

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr std::int64_t second_us = 1'000'000;
constexpr std::int64_t duration_us = 4 * second_us;
constexpr scenario::Window whole{.from_us = 0, .to_us = duration_us};

// A received frame of the target, with the time of the sample that caused it.
struct Came {
  std::int64_t t_ns = 0;
  std::int64_t cause_us = -1;
  std::int64_t hardware_ns = 0;
  std::optional<std::uint8_t> counter{};
};

// A run of 4 s at rest with perfect answers; the tests change the run.
class Judged : public testing::Test {
 protected:
  Judged() {
    for (std::int64_t t_us = 10'000; t_us <= duration_us; t_us += 10'000) {
      stimuli_["SlaveImu"].push_back({.valid_us = t_us, .t_ns = t_us * 1000, .due_ns = t_us * 1000});
      seen_.of<TransferAnswers>().navigation.push_back({.cause_us = t_us, .angles = {}});
      came<messages::AlignAttitude>().push_back({.t_ns = t_us * 1000 + 200'000, .cause_us = t_us});
      came<messages::AlignVelocityD>().push_back({.t_ns = t_us * 1000 + 200'000, .cause_us = t_us});
      seen_.timing.lateness.add(50'000);
      if (t_us % 100'000 != 0) continue;
      stimuli_["MasterIns"].push_back({.valid_us = t_us, .t_ns = t_us * 1000, .due_ns = t_us * 1000});
      seen_.of<TransferAnswers>().filter.push_back(
          {.cause_us = t_us, .nis = 3, .attitude_sigma = world::Vector3::Ones()});
      came<messages::AlignUpdate>().push_back({.t_ns = t_us * 1000 + 200'000, .cause_us = t_us});
      came<messages::TargetHeartbeat>().push_back({.t_ns = t_us * 1000});
    }
    seen_.last_ns = duration_us * 1000;
    seen_.counters = messages::TargetCounters{};
  }
  template <class Message>
  std::vector<Came>& came() {
    return came_[message_index<Message>()];
  }
  void silence_from(std::int64_t t_us) {
    std::erase_if(*test::Edited(seen_.of<TransferAnswers>().navigation),
                  [&](const auto& answer) { return answer.cause_us >= t_us; });
    std::erase_if(*test::Edited(seen_.of<TransferAnswers>().filter),
                  [&](const auto& answer) { return answer.cause_us >= t_us; });
    for (std::vector<Came>& came : came_)
      std::erase_if(came, [&](const Came& one) { return one.cause_us >= t_us; });
  }

  // Observations of the bench, with the timing that these checks need.
  [[nodiscard]] Observations timed(const std::vector<scenario::Check>& checks) const {
    Observations seen = seen_;
    seen.timing.windows = timed_windows(checks);
    observe::Stopwatch stopwatch(seen.timing);
    stopwatch.sent({}, seen.first_ns, 0);
    for (const auto& [group, stimuli] : stimuli_) {
      seen.stimuli[group] = {
          .count = stimuli.size(), .first_us = stimuli.front().valid_us, .last_us = stimuli.back().valid_us};
      for (const Stimulus& stimulus : stimuli) stopwatch.stimulus(group, stimulus);
    }
    for (std::size_t index = 0; index < came_.size(); ++index) {
      for (const Came& one : came_[index]) {
        stopwatch.arrived(index, {.frame = {}, .t_ns = one.t_ns, .hardware_ns = one.hardware_ns});
        if (one.cause_us >= 0)
          stopwatch.answered({&index, 1}, messages::all_messages[index].answers.front(), one.cause_us,
                             one.counter);
      }
    }
    stopwatch.finish();
    return seen;
  }

  template <class Rule>
  CheckResult judge(const Rule& rule, const std::string& unfit = "") {
    scenario::Scenario scenario;
    scenario.binding = bindings::canhil();
    scenario.checks.push_back(check_of(rule));
    const Observations seen = timed(scenario.checks);
    verdict_ = checks::judge(scenario, {.seen = seen,
                                        .truth = {.flight = truth_, .duration_us = duration_us},
                                        .estimators = estimators::all(),
                                        .ended_early = ended_early_,
                                        .timing_unfit = unfit});
    return verdict_.checks.at(0);
  }

  world::FlightRecord truth_{{.start = {}, .motion = world::Rest{}}, duration_us, 10'000};
  Observations seen_;
  std::map<std::string_view, std::vector<Stimulus>> stimuli_;
  std::array<std::vector<Came>, messages::all_messages.size()> came_{};
  std::string ended_early_;
  Verdict verdict_;
};

Error error(const quantities::Quantity& quantity, double below, const scenario::Window& window = whole,
            Error::Statistic statistic = Error::Statistic::max) {
  return error_of("transfer_alignment", quantity, window, below, statistic);
}
const Error attitude =
    error(quantities::attitude_pitch, 0.01, {.from_us = 2 * second_us, .to_us = duration_us});

Consistency consistency(const quantities::Quantity& quantity, std::variant<MeanBetween, Probability> bound) {
  return {
      .judged = {.estimator = "transfer_alignment", .quantity = &quantity}, .window = whole, .bound = bound};
}

Convergence convergence(double within, std::int64_t before_us) {
  return {.judged = {.estimator = "transfer_alignment", .quantity = &quantities::attitude_heading},
          .within = within,
          .unit = quantities::mrad,
          .before_us = before_us,
          .end_us = duration_us};
}

TEST_F(Judged, AQuantityThatTheTargetNeverToldFails) {
  const CheckResult found = judge(error_of("los_rate", quantities::attitude_pitch, whole, 0.01));
  EXPECT_EQ(found.outcome, Outcome::fail);
  EXPECT_EQ(found.measured, "no value of attitude.pitch came");
}

TEST_F(Judged, AttitudeErrorByTheWorstInItsWindow) {
  seen_.of<TransferAnswers>().navigation[100].angles.pitch = 0.5;  // at 1.01 s: outside the window
  seen_.of<TransferAnswers>().navigation[300].angles.roll = 0.5;   // another axis
  EXPECT_EQ(judge(attitude).outcome, Outcome::pass);
  seen_.of<TransferAnswers>().navigation[300].angles.pitch = -0.02;
  EXPECT_EQ(judge(attitude).outcome, Outcome::fail);
  EXPECT_THAT(judge(attitude).measured, HasSubstr("max 20.000 mrad of 201"));
}

TEST_F(Judged, VelocityErrorByAxisOrNorm) {
  seen_.of<TransferAnswers>().navigation[300].v_eb_n = {0.3, 0, -0.4};
  Error rule = error(quantities::velocity_norm, 0.45);
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
  rule.judged.quantity = &quantities::velocity_down;
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  rule.below = 0.4;
  EXPECT_EQ(judge(rule).outcome, Outcome::fail) << "the bar itself is not below it";
}

TEST_F(Judged, AnErrorByItsStatistic) {
  using enum Error::Statistic;
  for (auto& answer : test::Edited(seen_.of<TransferAnswers>().navigation)) answer.angles.roll = 0.003;
  seen_.of<TransferAnswers>().navigation[100].angles.roll = -0.103;
  const auto measured = [&](Error::Statistic statistic) {
    return judge(error(quantities::attitude_roll, 0.05, whole, statistic)).measured;
  };
  EXPECT_EQ(measured(max), "max 103.000 mrad of 400");
  EXPECT_EQ(measured(rms), "RMS 5.958 mrad of 400") << "sqrt((399 * 9 + 10609) / 400)";
  EXPECT_EQ(measured(mean), "mean 3.250, max 103.000 mrad of 400");
  EXPECT_EQ(measured(final), "final 3.000 mrad of 400");
  EXPECT_EQ(judge(error(quantities::attitude_roll, 0.05, whole, final)).outcome, Outcome::pass);
  EXPECT_EQ(judge(error(quantities::attitude_roll, 0.05)).outcome, Outcome::fail);
}

TEST_F(Judged, AValueThatIsNoNumberFailsEachKindAndIsNamed) {
  using enum Error::Statistic;
  const auto expect_named = [&](const auto& rule, const std::string& text) {
    const CheckResult found = judge(rule);
    EXPECT_EQ(found.outcome, Outcome::fail) << found.kind;
    EXPECT_EQ(found.measured, text + " not a number (NaN or infinite), first at 2.1 s") << found.kind;
  };
  auto& [navigation, filter] = seen_.of<TransferAnswers>();
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    navigation[209].v_eb_n.x() = navigation[300].v_eb_n.x() = value;
    for (const auto statistic : {max, rms, mean, final})
      expect_named(error(quantities::velocity_north, 9, whole, statistic), "2 of 400 answers are");
    Convergence converges = convergence(9, 3 * second_us);
    converges.judged.quantity = &quantities::velocity_north;
    expect_named(converges, "2 of 400 answers are");
    filter[20].nis = value;
    expect_named(consistency(quantities::innovation_nis, MeanBetween{0, 9}), "1 of 40 answers are");
    filter[20].attitude_sigma.z() = value;
    const Subject heading{.estimator = "transfer_alignment", .quantity = &quantities::attitude_heading};
    const scenario::Window later{.from_us = second_us, .to_us = duration_us};
    expect_named(Sigma{.judged = heading, .stretch = {.window = later}, .low = 0, .high = 9},
                 "10 of 301 sigmas are");
    expect_named(SigmaGrows{.judged = heading, .fault = "", .window = later}, "10 of 391 sigmas are");
  }
  filter[20].attitude_sigma = world::Vector3::Ones();
  navigation[210].angles.heading = std::numeric_limits<double>::quiet_NaN();  // the first answer after it
  expect_named(Honest{.estimators = {&transfer_alignment}, .named = {}}, "1 of 39 errors in sigmas are");
}

TEST_F(Judged, ConvergenceBeforeATime) {
  for (int k = 0; k < 100; ++k)
    seen_.of<TransferAnswers>().navigation[static_cast<std::size_t>(k)].angles.heading = 0.1;
  Convergence rule = convergence(0.01, 1'020'000);
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  EXPECT_EQ(judge(rule).measured, "1.01 s");
  rule.before_us = 1'010'000;
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
  seen_.of<TransferAnswers>().navigation.back().angles.heading = 0.1;
  EXPECT_EQ(judge(rule).measured, "not within at the end");
}

TEST_F(Judged, AnswersThatCeaseNeverPass) {
  silence_from(2 * second_us + 500'000);
  const Error angle = error(quantities::attitude_roll, 1);
  EXPECT_EQ(judge(angle).outcome, Outcome::fail);
  EXPECT_EQ(judge(angle).measured, "no answers from 2.49 to 4 s");
  EXPECT_EQ(judge(error(quantities::velocity_norm, 1)).outcome, Outcome::fail);
  EXPECT_EQ(judge(convergence(1, second_us)).outcome, Outcome::fail);
  EXPECT_EQ(judge(consistency(quantities::innovation_nis, MeanBetween{0, 9})).outcome, Outcome::fail);
}

TEST_F(Judged, NoAnswersAtAllFail) {
  silence_from(0);
  EXPECT_EQ(judge(attitude).measured, "no answers");
  EXPECT_EQ(judge(attitude).outcome, Outcome::fail);
  EXPECT_EQ(judge(convergence(1, second_us)).outcome, Outcome::fail);
  EXPECT_EQ(judge(Latency{.message = "AlignAttitude", .window = whole, .below_us = 5000}).outcome,
            Outcome::fail);
  EXPECT_EQ(judge(OutputPeriod{.message = "AlignAttitude", .window = whole, .within = 0.5}).outcome,
            Outcome::fail);
}

TEST_F(Judged, ConsistencyByTheMeanInTheChiSquareInterval) {
  Consistency rule = consistency(quantities::innovation_nis, Probability{0.95});
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  // The sum of 40 values with 3 degrees of freedom each has a chi-square distribution with 120 degrees of
  // freedom. 95 % of this distribution lie between 91.573 and 152.211.
  EXPECT_THAT(judge(rule).expected, HasSubstr("between 2.29 and 3.81"));
  for (auto& answer : test::Edited(seen_.of<TransferAnswers>().filter)) answer.nis = 3.9;
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
  for (auto& answer : test::Edited(seen_.of<TransferAnswers>().filter)) answer.nis = 2.2;
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
  rule.bound = MeanBetween{2, 2.5};
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
}

TEST_F(Judged, NeesFailsAnOverconfidentFilter) {
  for (auto& answer : test::Edited(seen_.of<TransferAnswers>().navigation)) answer.angles.heading = 0.1;
  const Consistency rule = consistency(quantities::attitude_nees, MeanBetween{0, 9});
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  for (auto& answer : test::Edited(seen_.of<TransferAnswers>().filter))
    answer.attitude_sigma *= 0.01;  // errors of 10 sigma
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
}

TEST_F(Judged, LatencyAtItsQuantile) {
  Latency rule{.message = "AlignAttitude", .window = whole, .below_us = 1000, .quantile = 0.99};
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  EXPECT_THAT(judge(rule).expected, testing::StartsWith("AlignAttitude 99 % quantile < 1 ms from 0 to "));
  for (std::size_t k = 0; k < 4; ++k) came<messages::AlignAttitude>()[k * 50].t_ns += 5'000'000;
  EXPECT_EQ(judge(rule).outcome, Outcome::pass) << "4 of 400 are 1 %";
  came<messages::AlignAttitude>()[222].t_ns += 6'000'000;
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
  const Measurement slow = judge(rule).judgement.measurement;
  EXPECT_NEAR(*slow.value, 5.2, 0.1);
  EXPECT_EQ(slow.worst_at_us, 2'230'000);
}

TEST_F(Judged, OutputPeriodCountsEveryMissingMessage) {
  OutputPeriod rule{.message = "AlignAttitude", .window = whole, .within = 0.2, .quantile = 0.99};
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  EXPECT_EQ(judge(rule).expected, "AlignAttitude every 10 ms +- 20 % (99 % quantile) from 0 to 4 s");
  auto& all = came<messages::AlignAttitude>();
  const auto kept = all;
  all.erase(all.begin() + 100, all.begin() + 150);  // one gap of half a second
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
  all = kept;
  all.resize(350);  // a gap of half a second at the end
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
}

TEST_F(Judged, OutputPeriodOfAMessageThatAnswersNothing) {
  const OutputPeriod rule{.message = "TargetHeartbeat", .window = whole, .within = 0.2};
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  came<messages::TargetHeartbeat>().pop_back();
  came<messages::TargetHeartbeat>().pop_back();
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
}

TEST_F(Judged, HeartbeatUpToTheEndOfTheRun) {
  const Heartbeat rule{.silent_at_most_us = 500'000};
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  const auto silent_from_us = [&] { return judge(rule).judgement.measurement.worst_at_us; };
  const auto first_us = [&] { return seen_.first_ns / 1000; };
  auto& beats = came<messages::TargetHeartbeat>();
  const auto kept = beats;
  beats.resize(30);  // the last heartbeat is at 3 s; the run ends at 4 s
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
  EXPECT_EQ(silent_from_us(), 3'000'000 - first_us());
  beats = kept;
  beats.erase(beats.begin(), beats.begin() + 7);
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
  EXPECT_EQ(silent_from_us(), 0);
  beats = kept;
  beats.erase(beats.begin() + 10, beats.begin() + 17);
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
  EXPECT_EQ(silent_from_us(), 1'000'000 - first_us());
  beats.clear();
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
}

TEST_F(Judged, CountersByEachBar) {
  Counters rule;
  rule.frames_lost_at_most = 0;
  rule.late_at_most = 2;
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  seen_.counters->bad_crc = 5;  // the rule sets no limit on it
  seen_.counters->late = 2;
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  seen_.counters->late = 3;
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
  EXPECT_EQ(judge(rule).measured, "frames lost 0, late 3");
  seen_.counters.reset();
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
}

// The bench sends 5 of 400 stimuli too late. The lateness of only 5 frames hardly changes the p99 over all
// frames, but the periods of the answers would exceed their limit.
TEST_F(Judged, ThePeriodIsNotMeasuredWithStimuliThatAreOffThemselves) {
  const OutputPeriod period{.message = "AlignAttitude", .window = whole, .within = 0.25, .quantile = 0.99};
  ASSERT_EQ(judge(period).outcome, Outcome::pass);
  auto& stimuli = stimuli_["SlaveImu"];
  auto& answers = came<messages::AlignAttitude>();
  for (std::size_t i = 200; i < 205; ++i) {
    stimuli[i].t_ns = stimuli[205].t_ns;
    answers[i].t_ns = answers[205].t_ns;
  }
  EXPECT_EQ(judge(period).outcome, Outcome::not_measured);
  for (std::size_t i = 200; i < 205; ++i) stimuli[i].t_ns = stimuli[i].due_ns;
  EXPECT_EQ(judge(period).outcome, Outcome::fail) << "the target's own stall";
}

TEST_F(Judged, TheBusByEachBar) {
  BusErrorLimits rule;
  seen_.bus.reports_errors = true;
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  seen_.bus.errors = {.frames = 9, .warning = 9, .passive = 9};
  seen_.bus.late_in_queue = 9;
  EXPECT_EQ(judge(rule).outcome, Outcome::pass) << "not asked for";
  EXPECT_EQ(judge(rule).measured, "bus off 0, interface down 0");
  for (auto bar : {&BusErrorLimits::passive_at_most, &BusErrorLimits::warning_at_most,
                   &BusErrorLimits::error_frames_at_most, &BusErrorLimits::late_in_queue_at_most}) {
    BusErrorLimits one;
    one.*bar = 9;
    EXPECT_EQ(judge(one).outcome, Outcome::pass);
    one.*bar = 8;
    EXPECT_EQ(judge(one).outcome, Outcome::fail);
  }
  seen_.bus.errors.bus_off = 1;
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
  rule.bus_off_at_most = 1;
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  seen_.bus.downs = 1;
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
}

TEST_F(Judged, ABusThatReportsNoErrorsProvesNothing) {
  const BusErrorLimits rule;
  EXPECT_EQ(judge(rule).outcome, Outcome::not_measured);
  EXPECT_THAT(judge(rule).measured, HasSubstr("this bus reports no errors"));
  EXPECT_EQ(judge(rule).expected, "bus off <= 0, interface down <= 0");
  EXPECT_EQ(judge(attitude).outcome, Outcome::pass);
  EXPECT_EQ(verdict_.checks.size(), 1U) << "nor is it held against a run that does not ask";
  seen_.bus.downs = 1;
  EXPECT_EQ(judge(rule).outcome, Outcome::fail) << "what was seen counts";
  seen_.bus.downs = 0;
  seen_.bus.errors.frames = 1;
  EXPECT_EQ(judge(rule).outcome, Outcome::pass) << "it does report them";
}

TEST_F(Judged, ABusThatFailedFailsARunThatSaysNothingOfIt) {
  judge(attitude);
  EXPECT_EQ(verdict_.checks.size(), 1U);
  seen_.bus.errors.bus_off = 1;
  judge(attitude);
  ASSERT_EQ(verdict_.checks.size(), 2U);
  EXPECT_EQ(verdict_.checks[1].kind, "bus_errors");
  EXPECT_EQ(verdict_.checks[1].outcome, Outcome::fail);
  EXPECT_EQ(verdict_.outcome, Outcome::fail);
  seen_.bus.reports_errors = true;
  BusErrorLimits allowed;
  allowed.bus_off_at_most = 1;
  judge(allowed);
  EXPECT_EQ(verdict_.checks.size(), 1U) << "the scenario says something";
  EXPECT_EQ(verdict_.outcome, Outcome::pass);
}

TEST_F(Judged, WithOthersWhoSendInTheBenchsOrTheTargetsNameNothingIsShown) {
  EXPECT_EQ(judge(attitude).outcome, Outcome::pass);
  EXPECT_EQ(verdict_.outcome, Outcome::pass);
  seen_.bus.intruded = {{"Sync", 2}, {"TargetCommand", 1}};
  judge(attitude);
  ASSERT_EQ(verdict_.checks.size(), 2U);
  EXPECT_EQ(verdict_.checks[1].kind, "senders");
  EXPECT_EQ(verdict_.checks[1].measured, "somebody else sent frames of the bench: Sync 2, TargetCommand 1");
  EXPECT_EQ(verdict_.outcome, Outcome::not_measured);
  seen_.bus.intruded.clear();
  came<messages::AlignAttitude>().push_back({.t_ns = duration_us * 1000, .cause_us = duration_us});
  judge(attitude);
  ASSERT_EQ(verdict_.checks.size(), 2U);
  EXPECT_EQ(verdict_.checks[1].measured, "answers given twice: AlignNav 1");
  EXPECT_EQ(verdict_.outcome, Outcome::not_measured);
}

TEST_F(Judged, AnswersThatNameNoCauseOrTheCounterOfAnotherFailTheRun) {
  came<messages::AlignVelocityD>().push_back({.t_ns = 1, .cause_us = second_us + 5});
  judge(attitude);
  ASSERT_EQ(verdict_.checks.size(), 2U);
  EXPECT_EQ(verdict_.checks[1].kind, "causes");
  EXPECT_EQ(verdict_.checks[1].measured, "AlignNav: 1 answers with no cause, nearest 5 us off");
  EXPECT_EQ(verdict_.outcome, Outcome::fail);
  seen_.bus.intruded = {{"Sync", 2}};
  judge(attitude);
  EXPECT_EQ(verdict_.outcome, Outcome::not_measured) << "the target may have answered somebody else";
  seen_.bus.intruded.clear();
  came<messages::AlignVelocityD>() = {{.t_ns = 1, .cause_us = second_us, .counter = 3},
                                      {.t_ns = 2, .cause_us = 2 * second_us, .counter = 0}};
  judge(attitude);
  ASSERT_EQ(verdict_.checks.size(), 2U);
  EXPECT_EQ(
      verdict_.checks[1].measured,
      "AlignNav: 1 answers with the counter of another cause than that of their time, first 3, expected 0");
  EXPECT_EQ(verdict_.outcome, Outcome::fail);
}

TEST_F(Judged, OfAGroupThatIsNeverWholeTheMissingMessageIsNamed) {
  for (const std::size_t index :
       {message_index<messages::LosRateEstimate>(), message_index<messages::LosRateTarget>()})
    seen_.from_target[index].right = 100;
  judge(attitude);
  ASSERT_EQ(verdict_.checks.size(), 2U);
  EXPECT_EQ(verdict_.checks[1].kind, "answer_groups");
  EXPECT_EQ(verdict_.checks[1].measured, "LosRate: 200 frames and no whole group: LosRateSigma missing");
  EXPECT_EQ(verdict_.outcome, Outcome::fail);
  seen_.answers[message_index<messages::LosRateTarget>()] = 1;
  judge(attitude);
  EXPECT_EQ(verdict_.checks.size(), 1U) << "some may be lost on the way";
}

// Whatever a scenario checks: such frames are rejected, so nothing else would show them.
TEST_F(Judged, FramesThatTheirProtectionRejectsFailTheRun) {
  const std::size_t index = message_index<messages::TargetCounters>();
  for (auto Sighting::*count : {&Sighting::wrong_crc, &Sighting::wrong_size, &Sighting::wrong_counter}) {
    seen_.from_target[index] = {.right = 97};
    judge(attitude);
    EXPECT_EQ(verdict_.checks.size(), 1U);
    seen_.from_target[index].*count = 3;
    judge(attitude);
    ASSERT_EQ(verdict_.checks.size(), 2U);
    EXPECT_EQ(verdict_.checks[1].kind, "protection");
    EXPECT_THAT(verdict_.checks[1].measured, HasSubstr("TargetCounters: 3 of 100 frames "));
    EXPECT_EQ(verdict_.outcome, Outcome::fail);
  }
  seen_.from_target[index] = {.right = 90, .wrong_crc = 9, .repeated = 1};
  judge(attitude);
  EXPECT_EQ(verdict_.checks[1].measured, "TargetCounters: 9 of 100 frames with a wrong checksum")
      << "after nine frames that were rejected, a counter may have come round";
}

TEST_F(Judged, TheTargetsCountsAreHeldAgainstWhatTheBenchWithheld) {
  CountsMatch rule;
  seen_.expected_counts = {.least = {.frames_lost = 5, .bad_group = 2},
                           .most = {.frames_lost = 5, .bad_group = 4}};
  seen_.counters = messages::TargetCounters{.frames_lost = 5, .bad_group = 3};
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  EXPECT_EQ(judge(rule).expected,
            "frames lost 5, bad CRC 0, bad groups 2 to 4, late 0, as the bench withheld and damaged");
  for (const messages::TargetCounters wrong : {messages::TargetCounters{.frames_lost = 4, .bad_group = 3},
                                               messages::TargetCounters{.frames_lost = 6, .bad_group = 3},
                                               messages::TargetCounters{.frames_lost = 5, .bad_group = 1},
                                               messages::TargetCounters{.frames_lost = 5, .bad_group = 5}}) {
    seen_.counters = wrong;
    EXPECT_EQ(judge(rule).outcome, Outcome::fail) << judge(rule).measured;
  }
  rule.bad_group_slack = 1;
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  seen_.counters->late = 1;
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
  seen_.bus.downs = 1;
  EXPECT_EQ(judge(rule).outcome, Outcome::not_measured) << "an outage loses what the bench sent";
  seen_.counters.reset();
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
}

TEST_F(Judged, CountsStayAtTheirEnd) {
  seen_.expected_counts = {.least = {.frames_lost = 20'000}, .most = {.frames_lost = 20'000}};
  seen_.counters = messages::TargetCounters{.frames_lost = 8191};
  EXPECT_EQ(judge(CountsMatch()).outcome, Outcome::pass);
  seen_.counters->frames_lost = 8190;
  EXPECT_EQ(judge(CountsMatch()).outcome, Outcome::fail);
}

TEST_F(Judged, TheControllersStampsAreUsedWhereItGaveThem) {
  const std::vector<scenario::Check> checks{check_of(Latency{.message = "AlignAttitude", .window = whole})};
  const auto window = [&] { return timed(checks).timing.windows.at(0); };
  EXPECT_FALSE(stamped_by_hardware(timed(checks).timing));
  for (auto& [group, stimuli] : stimuli_)
    for (Stimulus& stimulus : stimuli) stimulus.hardware_ns = stimulus.t_ns + 1'000'000'000'000;
  for (auto& came : came_)  // hardware stamps: 30 us, host stamps: 200 us
    for (Came& one : came) one.hardware_ns = one.t_ns + 999'999'830'000;
  EXPECT_TRUE(stamped_by_hardware(timed(checks).timing));
  EXPECT_EQ(window().latency.max_ns(), 30'000);
  EXPECT_EQ(window().period.max_ns(), 10'000'000);
  came<messages::AlignAttitude>()[7].hardware_ns = 0;
  EXPECT_FALSE(stamped_by_hardware(timed(checks).timing));
  using Bucket = Histogram::Bucket;
  EXPECT_THAT(window().latency.buckets(), ElementsAre(Bucket{30, 399}, Bucket{200, 1}))
      << "never one of each";
  stimuli_["SlaveImu"][9].hardware_ns = 0;
  EXPECT_THAT(window().latency.buckets(), ElementsAre(Bucket{30, 398}, Bucket{200, 2}));
}

TEST_F(Judged, AWindowTakesTheTimesOfItsPartOfTheRun) {
  Latency rule{
      .message = "AlignAttitude", .window = {.from_us = second_us, .to_us = 2 * second_us}, .below_us = 1000};
  came<messages::AlignAttitude>()[98].t_ns += 5'000'000;   // at 0.99 s
  came<messages::AlignAttitude>()[200].t_ns += 5'000'000;  // at 2.01 s
  EXPECT_EQ(judge(rule).outcome, Outcome::pass);
  EXPECT_THAT(judge(rule).measured, HasSubstr("of 101"));
  came<messages::AlignAttitude>()[199].t_ns += 5'000'000;
  EXPECT_EQ(judge(rule).outcome, Outcome::fail);
  rule.message = "AlignUpdate";
  came<messages::AlignUpdate>().clear();
  EXPECT_EQ(judge(rule).measured, "AlignUpdate: answers to 0 of 11 samples");
}

TEST(TimedWindows, AreTakenOnceForAllThatAskForThem) {
  const scenario::Window half{.from_us = 0, .to_us = second_us};
  const std::vector<scenario::Check> checks{
      check_of(Latency{.message = "AlignAttitude", .window = whole}, "a"),
      check_of(Latency{.message = "AlignAttitude", .window = half}, "b"),
      check_of(OutputPeriod{.message = "AlignAttitude", .window = half}, "c"), check_of(attitude, "d")};
  EXPECT_EQ(timed_windows(checks).size(), 2U);
}

TEST_F(Judged, TimingIsNotMeasuredByALateBenchWhateverTheTargetDid) {
  const Latency latency{.message = "AlignAttitude", .window = whole, .below_us = 1000};
  const Heartbeat heartbeat{.silent_at_most_us = 500'000};
  seen_.timing.lateness.add(501'000);  // more than half of the limit of 1 ms
  EXPECT_EQ(judge(latency).outcome, Outcome::not_measured);
  EXPECT_EQ(verdict_.outcome, Outcome::not_measured);
  EXPECT_EQ(judge(heartbeat).outcome, Outcome::pass) << "its bar is far above";
  EXPECT_EQ(judge(heartbeat, "virtual time").outcome, Outcome::not_measured);
  EXPECT_EQ(judge(heartbeat, "virtual time").measured, "virtual time");
  EXPECT_EQ(judge(attitude, "virtual time").outcome, Outcome::pass) << "outputs are judged on any host";
  EXPECT_THAT(judge(latency).measured, Not(HasSubstr("--realtime")));
  seen_.host.may_be_realtime = true;
  EXPECT_THAT(judge(latency).measured, HasSubstr("more than 50 % of the limit; --realtime would help"));
}

TEST_F(Judged, TimingIsNotMeasuredWithLostFrames) {
  EXPECT_EQ(unfit_for_timing(seen_), "");
  seen_.from_target.front().lost = 2;
  EXPECT_THAT(unfit_for_timing(seen_), HasSubstr("2 frames of the target were lost"));
  seen_.receive_overflows = 3;
  EXPECT_THAT(unfit_for_timing(seen_), HasSubstr("port lost 3 frames"));
}

TEST_F(Judged, ARunThatEndedEarlyFailsWhateverItsChecksSay) {
  ended_early_ = "target silent since t=1 s";
  EXPECT_EQ(judge(attitude).outcome, Outcome::not_measured);
  EXPECT_FALSE(judge(attitude).judgement.measurement.value);
  EXPECT_EQ(verdict_.outcome, Outcome::fail);
  EXPECT_EQ(verdict_.reason, ended_early_);
}

TEST(Quantile, IsOfTheNearestRank) {
  EXPECT_EQ(quantile({3, 1, 2, 4}, 0.5), 2);
  EXPECT_EQ(quantile({3, 1, 2, 4}, 0.51), 3);
  EXPECT_EQ(quantile({3, 1, 2, 4}, 1), 4);
  EXPECT_EQ(quantile({7}, 0.001), 7);
  EXPECT_EQ(distribution({}).count, 0U);
  EXPECT_EQ(distribution({3, 1, 2}).p50, 2);
}

}  // namespace
}  // namespace canhil::checks
