// Every kind of check: its keys and defaults.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "bench/checks/kinds/answers.hpp"
#include "bench/checks/kinds/bus_errors.hpp"
#include "bench/checks/kinds/consistency.hpp"
#include "bench/checks/kinds/convergence.hpp"
#include "bench/checks/kinds/counters.hpp"
#include "bench/checks/kinds/error.hpp"
#include "bench/checks/kinds/heartbeat.hpp"
#include "bench/checks/kinds/latency.hpp"
#include "bench/checks/kinds/output_period.hpp"
#include "bench/checks/kinds/sigma.hpp"
#include "bench/quantities/list.hpp"
#include "tests/unit/bench/scenario/texts.hpp"

namespace canhil::scenario {
namespace {

using testing::HasSubstr;

std::string one_check(std::string_view lines) {
  return with("kind = \"heartbeat\"\nsilent_at_most_s = 0.5\n", lines);
}

template <class Kind>
Kind rule_of(std::string_view lines) {
  return scenario::rule_of<Kind>(parsed(one_check(lines)).checks.at(0));
}

constexpr std::string_view pitch = "kind = 'error'\nquantity = 'attitude.pitch'\n";
std::string of_pitch(std::string_view lines) { return std::string(pitch) + std::string(lines); }

TEST(ScenarioChecks, WhatAllHave) {
  const Check plain = parsed(valid).checks.at(0);
  EXPECT_EQ(plain.name, "heartbeat");
  EXPECT_EQ(plain.requirement, "");
  EXPECT_EQ(plain.line, 16);
  EXPECT_EQ(plain.kind, "heartbeat");
  const Check full = parsed(inside("[[check]]", "name = \"alive\"\nrequirement = \"TA-6\"")).checks.at(0);
  EXPECT_EQ(full.name, "alive");
  EXPECT_EQ(full.requirement, "TA-6");
}

TEST(ScenarioChecks, NamesByDefaultSayWhatIsLookedAt) {
  const auto name = [](std::string_view lines) { return parsed(one_check(lines)).checks.at(0).name; };
  EXPECT_EQ(name(of_pitch("below_mrad = 1")), "error attitude.pitch");
  EXPECT_EQ(name(of_pitch("statistic = 'rms'\nbelow_mrad = 1")), "error attitude.pitch rms");
  EXPECT_EQ(name("kind = 'convergence'\nquantity = 'attitude.roll'\nwithin_mrad = 1\nbefore_s = 2"),
            "convergence attitude.roll");
  EXPECT_EQ(name("kind = 'consistency'\nquantity = 'innovation.nis'\nprobability = 0.9"),
            "consistency innovation.nis");
  EXPECT_EQ(name("kind = 'sigma'\nquantity = 'attitude.roll'\nbetween_mrad = [1, 2]"), "sigma attitude.roll");
  EXPECT_EQ(name("kind = 'latency'\nmessage = 'AlignUpdate'\nbelow_ms = 1"), "latency AlignUpdate");
  EXPECT_EQ(name("kind = 'output_period'\nmessage = 'AlignUpdate'\nwithin_percent = 1"),
            "output_period AlignUpdate");
  EXPECT_EQ(name("kind = 'counters'\nlate_at_most = 1"), "counters");
  EXPECT_EQ(name("kind = 'answers'\ncoasting_at_most = 1\nupdates_at_least = 1"), "answers coasting updates");
}

TEST(ScenarioChecks, Error) {
  const auto rule = rule_of<checks::Error>(of_pitch("from_s = 19.0\nto_s = 19.5\nbelow_mrad = 5"));
  EXPECT_EQ(rule.judged.quantity, &quantities::attitude_pitch);
  EXPECT_EQ(rule.judged.estimator, "transfer_alignment");
  EXPECT_EQ(rule.statistic, checks::Error::Statistic::max);
  EXPECT_EQ(rule.stretch.window.from_us, 19'000'000);
  EXPECT_EQ(rule.stretch.window.to_us, 19'500'000);
  EXPECT_FALSE(rule.stretch.to_go_s);
  EXPECT_DOUBLE_EQ(rule.below, 5e-3);
  const auto velocity = rule_of<checks::Error>(
      "kind = 'error'\nquantity = 'velocity.down'\nstatistic = 'mean'\nfrom_s = 1\nbelow_mps = 0.2");
  EXPECT_EQ(velocity.judged.quantity, &quantities::velocity_down);
  EXPECT_EQ(velocity.statistic, checks::Error::Statistic::mean);
  EXPECT_DOUBLE_EQ(velocity.below, 0.2);
}

TEST(ScenarioChecks, AWindowIsByDefaultTheRun) {
  const auto rule = rule_of<checks::Error>(of_pitch("below_mrad = 5"));
  EXPECT_EQ(rule.stretch.window.from_us, 0);
  EXPECT_EQ(rule.stretch.window.to_us, 20'000'000);
}

TEST(ScenarioChecks, Convergence) {
  const auto rule = rule_of<checks::Convergence>(
      "kind = 'convergence'\nquantity = 'attitude.heading'\nwithin_mrad = 3\nbefore_s = 14");
  EXPECT_EQ(rule.judged.quantity, &quantities::attitude_heading);
  EXPECT_DOUBLE_EQ(rule.within, 3e-3);
  EXPECT_EQ(rule.before_us, 14'000'000);
  EXPECT_EQ(rule.end_us, 20'000'000);
}

TEST(ScenarioChecks, Consistency) {
  const auto white = rule_of<checks::Consistency>(
      "kind = 'consistency'\nquantity = 'innovation.nis'\nfrom_s = 2\nprobability = 0.99");
  EXPECT_EQ(white.judged.quantity, &quantities::innovation_nis);
  EXPECT_EQ(white.window.from_us, 2'000'000);
  EXPECT_DOUBLE_EQ(std::get<checks::Probability>(white.bound).value, 0.99);
  const auto mean = rule_of<checks::Consistency>(
      "kind = 'consistency'\nquantity = 'attitude.nees'\nmean_between = [0.5, 8]");
  EXPECT_EQ(mean.judged.quantity->name, "attitude.nees");
  EXPECT_DOUBLE_EQ(std::get<checks::MeanBetween>(mean.bound).low, 0.5);
  EXPECT_DOUBLE_EQ(std::get<checks::MeanBetween>(mean.bound).high, 8.0);
}

TEST(ScenarioChecks, Sigma) {
  const auto heading = rule_of<checks::Sigma>(
      "kind = 'sigma'\nquantity = 'attitude.heading'\nfrom_s = 19\nbetween_mrad = [0.2, 0.4]");
  EXPECT_EQ(heading.judged.quantity, &quantities::attitude_heading);
  EXPECT_EQ(heading.stretch.window.from_us, 19'000'000);
  EXPECT_DOUBLE_EQ(heading.low, 0.2e-3);
  EXPECT_DOUBLE_EQ(heading.high, 0.4e-3);
  EXPECT_EQ(heading.unit.name, "mrad");
  const auto in_degrees =
      rule_of<checks::Sigma>("kind = 'sigma'\nquantity = 'attitude.roll'\nbetween_deg = [1, 2]");
  EXPECT_DOUBLE_EQ(in_degrees.high, 2 * world::units::deg);
  const auto velocity =
      rule_of<checks::Sigma>("kind = 'sigma'\nquantity = 'velocity.down'\nbetween_mps = [0, 0.2]");
  EXPECT_DOUBLE_EQ(velocity.high, 0.2);
  const auto refused = [](std::string_view lines) { return error_of(one_check(lines)); };
  EXPECT_THAT(refused("kind = 'sigma'\nquantity = 'attitude.roll'"),
              HasSubstr("key 'check[1].between_mrad': is missing, expected an array [low, high]"));
  EXPECT_THAT(refused("kind = 'sigma'\nquantity = 'attitude.roll'\nbetween_mrad = [2, 1]"),
              HasSubstr("key 'check[1].between_mrad': is descending"));
  EXPECT_THAT(refused("kind = 'sigma'\nquantity = 'attitude.nees'\nbetween = [1, 2]"),
              HasSubstr("'attitude.nees' cannot be used with this kind"));
}

TEST(ScenarioChecks, OutputPeriod) {
  const auto rule = rule_of<checks::OutputPeriod>(
      "kind = 'output_period'\nmessage = 'AlignAttitude'\nfrom_s = 1\nto_s = 2\nwithin_percent = 20");
  EXPECT_EQ(rule.message, "AlignAttitude");
  EXPECT_EQ(rule.window.from_us, 1'000'000);
  EXPECT_EQ(rule.window.to_us, 2'000'000);
  EXPECT_DOUBLE_EQ(rule.within, 0.2);
  EXPECT_EQ(rule.quantile, 1.0);
  const auto most = rule_of<checks::OutputPeriod>(
      "kind = 'output_period'\nmessage = 'AlignAttitude'\nwithin_percent = 20\nquantile = 0.99");
  EXPECT_EQ(most.quantile, 0.99);
}

TEST(ScenarioChecks, Latency) {
  const auto rule =
      rule_of<checks::Latency>("kind = 'latency'\nmessage = 'AlignUpdate'\nfrom_s = 1\nbelow_ms = 2.5");
  EXPECT_EQ(rule.message, "AlignUpdate");
  EXPECT_EQ(rule.window.from_us, 1'000'000);
  EXPECT_EQ(rule.below_us, 2'500);
  EXPECT_EQ(rule.quantile, 1.0);
  const auto most =
      rule_of<checks::Latency>("kind = 'latency'\nmessage = 'AlignUpdate'\nbelow_ms = 2.5\nquantile = 0.999");
  EXPECT_EQ(most.quantile, 0.999);
}

TEST(ScenarioChecks, Counters) {
  const auto one = rule_of<checks::Counters>("kind = 'counters'\nbad_crc_at_most = 3");
  EXPECT_EQ(one.bad_crc_at_most, 3);
  EXPECT_FALSE(one.frames_lost_at_most || one.bad_group_at_most || one.late_at_most);
  const auto rest = rule_of<checks::Counters>(
      "kind = 'counters'\nframes_lost_at_most = 0\nbad_group_at_most = 1\nlate_at_most = 2");
  EXPECT_EQ(rest.frames_lost_at_most, 0);
  EXPECT_EQ(rest.bad_group_at_most, 1);
  EXPECT_EQ(rest.late_at_most, 2);
  EXPECT_FALSE(rest.bad_crc_at_most);
}

TEST(ScenarioChecks, BusErrors) {
  const auto one = rule_of<checks::BusErrorLimits>("kind = 'bus_errors'");
  EXPECT_EQ(one.bus_off_at_most, 0);
  EXPECT_EQ(one.down_at_most, 0);
  EXPECT_FALSE(one.passive_at_most || one.warning_at_most || one.error_frames_at_most ||
               one.late_in_queue_at_most);
  const auto rest = rule_of<checks::BusErrorLimits>(
      "kind = 'bus_errors'\nbus_off_at_most = 1\ndown_at_most = 2\npassive_at_most = 3\n"
      "warning_at_most = 4\nerror_frames_at_most = 5\nlate_in_queue_at_most = 6");
  EXPECT_EQ(rest.bus_off_at_most, 1);
  EXPECT_EQ(rest.down_at_most, 2);
  EXPECT_EQ(rest.passive_at_most, 3);
  EXPECT_EQ(rest.warning_at_most, 4);
  EXPECT_EQ(rest.error_frames_at_most, 5);
  EXPECT_EQ(rest.late_in_queue_at_most, 6);
}

TEST(ScenarioChecks, AnglesMayBeInDegrees) {
  const auto error = rule_of<checks::Error>(of_pitch("below_deg = 5"));
  EXPECT_DOUBLE_EQ(error.below, 5 * world::units::deg);
  EXPECT_EQ(error.unit.name, "deg");
  EXPECT_EQ(rule_of<checks::Error>(of_pitch("below_mrad = 5")).unit.name, "mrad");
  EXPECT_EQ(error_of(one_check(of_pitch("limit_mps = 5"))),
            "s.toml:19: key 'check[1].limit_mps': is unknown, expected one of: kind, requirement, quantity, "
            "estimator, "
            "statistic, while, time_to_go_s, from_s, to_s, below_deg, below_mrad, name");
}

TEST(ScenarioChecks, Answers) {
  const auto rule = rule_of<checks::Answers>(
      "kind = 'answers'\nfrom_s = 3\ncoasting_at_least = 2\ncoasting_at_most = 4\nupdates_before_s = 15");
  EXPECT_EQ(rule.estimator, "transfer_alignment");
  EXPECT_EQ(rule.window.from_us, 3'000'000);
  ASSERT_EQ(rule.counts.size(), 2U);
  EXPECT_EQ(rule.counts[0].mark, "coasting");
  EXPECT_EQ(rule.counts[0].at_least, 2);
  EXPECT_EQ(rule.counts[0].at_most, 4);
  EXPECT_EQ(rule.counts[1].mark, "updates");
  EXPECT_EQ(rule.counts[1].before_us, 15'000'000);
}

TEST(ScenarioChecks, AQuantityIsOneThatIsReportedAndThatTheKindAsksFor) {
  const auto refused = [](std::string_view lines) { return error_of(one_check(lines)); };
  EXPECT_THAT(
      refused("kind = 'error'\nquantity = 'wind.norm'\nbelow_mps = 1"),
      HasSubstr(
          "18: key 'check[1].quantity': 'wind.norm' is reported by no estimator of this scenario, expected "
          "one of: misalignment.north, "));
  EXPECT_THAT(refused("kind = 'error'\nquantity = 'innovation.nis'\nbelow = 1"),
              HasSubstr("'innovation.nis' cannot be used with this kind, expected one of: "));
  EXPECT_THAT(refused("kind = 'error'\nquantity = 'attitude.haeding'\nbelow_mrad = 1"),
              HasSubstr("'attitude.haeding' is unknown, expected 'attitude.heading'"));
  EXPECT_THAT(
      refused("kind = 'error'\nquantity = 'attitude.roll'\ntime_to_go_s = [1, 2]\nbelow_mrad = 1"),
      HasSubstr("key 'check[1].time_to_go_s': is for flights that go to a target, expected from_s and to_s"));
}

TEST(ScenarioChecks, HeartbeatAndOrder) {
  EXPECT_EQ(rule_of<checks::Heartbeat>("kind = 'heartbeat'\nsilent_at_most_s = 0.25").silent_at_most_us,
            250'000);
  const Scenario s = parsed(with("[[check]]", "[[check]]\nkind = 'counters'\nlate_at_most = 0\n[[check]]"));
  ASSERT_EQ(s.checks.size(), 2U);
  EXPECT_EQ(s.checks[0].kind, "counters");
  EXPECT_EQ(s.checks[1].kind, "heartbeat");
}

}  // namespace
}  // namespace canhil::scenario
