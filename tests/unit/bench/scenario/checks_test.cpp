// Every kind of check: its fields and defaults.
#include <gtest/gtest.h>

#include "tests/unit/bench/scenario/texts.hpp"

namespace canhil::scenario {
namespace {

std::string one_check(std::string_view lines) {
  return with("kind = \"heartbeat\"\nsilent_at_most_s = 0.5\n", lines);
}

template <class Rule>
Rule rule_of(std::string_view lines) {
  const Scenario s = parsed(one_check(lines));
  if (s.checks.size() == 1 && std::holds_alternative<Rule>(s.checks[0].rule))
    return std::get<Rule>(s.checks[0].rule);
  ADD_FAILURE() << "not the kind expected";
  return {};
}

TEST(ScenarioChecks, WhatAllHave) {
  const Check plain = parsed(valid).checks.at(0);
  EXPECT_EQ(plain.name, "heartbeat");
  EXPECT_EQ(plain.requirement, "");
  EXPECT_EQ(plain.line, 16);
  EXPECT_EQ(kind(plain), "heartbeat");
  const Check full = parsed(inside("[[check]]", "name = \"alive\"\nrequirement = \"TA-6\"")).checks.at(0);
  EXPECT_EQ(full.name, "alive");
  EXPECT_EQ(full.requirement, "TA-6");
}

TEST(ScenarioChecks, NamesByDefaultSayWhatIsLookedAt) {
  const auto name = [](std::string_view lines) { return parsed(one_check(lines)).checks.at(0).name; };
  EXPECT_EQ(name("kind = 'attitude_error'\naxis = 'pitch'\nbelow_mrad = 1"), "attitude_error pitch");
  EXPECT_EQ(name("kind = 'convergence'\naxis = 'roll'\nwithin_mrad = 1\nbefore_s = 2"), "convergence roll");
  EXPECT_EQ(name("kind = 'velocity_error'\nbelow_mps = 1"), "velocity_error norm");
  EXPECT_EQ(name("kind = 'consistency'\nstatistic = 'nis'\nprobability = 0.9"), "consistency nis");
  EXPECT_EQ(name("kind = 'latency'\nmessage = 'AlignUpdate'\nbelow_ms = 1"), "latency AlignUpdate");
  EXPECT_EQ(name("kind = 'output_period'\nmessage = 'AlignUpdate'\nwithin_percent = 1"),
            "output_period AlignUpdate");
  EXPECT_EQ(name("kind = 'counters'\nlate_at_most = 1"), "counters");
  EXPECT_EQ(name("kind = 'position_error'\nbelow_m = 1"), "position_error norm");
  EXPECT_EQ(name("kind = 'fixes'\ngated_at_most = 1"), "fixes");
  EXPECT_EQ(name("kind = 'coasting'\nat_most = 1"), "coasting");
  EXPECT_EQ(name("kind = 'consistency'\nstatistic = 'heading_nees'\nmean_between = [0, 2]"),
            "consistency heading_nees");
}

TEST(ScenarioChecks, AttitudeError) {
  const auto rule = rule_of<AttitudeError>(
      "kind = 'attitude_error'\naxis = 'pitch'\nfrom_s = 19.0\nto_s = 19.5\nbelow_mrad = 5");
  EXPECT_EQ(rule.axis, AttitudeAxis::pitch);
  EXPECT_EQ(rule.window.from_us, 19'000'000);
  EXPECT_EQ(rule.window.to_us, 19'500'000);
  EXPECT_DOUBLE_EQ(rule.below, 5e-3);
}

TEST(ScenarioChecks, AWindowIsByDefaultTheRun) {
  const auto rule = rule_of<AttitudeError>("kind = 'attitude_error'\naxis = 'roll'\nbelow_mrad = 5");
  EXPECT_EQ(rule.axis, AttitudeAxis::roll);
  EXPECT_EQ(rule.window.from_us, 0);
  EXPECT_EQ(rule.window.to_us, 20'000'000);
}

TEST(ScenarioChecks, Convergence) {
  const auto rule =
      rule_of<Convergence>("kind = 'convergence'\naxis = 'heading'\nwithin_mrad = 3\nbefore_s = 14");
  EXPECT_EQ(rule.axis, AttitudeAxis::heading);
  EXPECT_DOUBLE_EQ(rule.within, 3e-3);
  EXPECT_EQ(rule.before_us, 14'000'000);
}

TEST(ScenarioChecks, VelocityError) {
  const auto rule =
      rule_of<VelocityError>("kind = 'velocity_error'\naxis = 'down'\nfrom_s = 1\nbelow_mps = 0.2");
  EXPECT_EQ(rule.axis, VelocityAxis::down);
  EXPECT_EQ(rule.window.from_us, 1'000'000);
  EXPECT_DOUBLE_EQ(rule.below, 0.2);
}

TEST(ScenarioChecks, Consistency) {
  const auto white =
      rule_of<Consistency>("kind = 'consistency'\nstatistic = 'nis'\nfrom_s = 2\nprobability = 0.99");
  EXPECT_EQ(white.statistic, Statistic::nis);
  EXPECT_EQ(white.window.from_us, 2'000'000);
  EXPECT_DOUBLE_EQ(std::get<Probability>(white.bound).value, 0.99);
  const auto mean =
      rule_of<Consistency>("kind = 'consistency'\nstatistic = 'attitude_nees'\nmean_between = [0.5, 8]");
  EXPECT_EQ(mean.statistic, Statistic::attitude_nees);
  EXPECT_DOUBLE_EQ(std::get<MeanBetween>(mean.bound).low, 0.5);
  EXPECT_DOUBLE_EQ(std::get<MeanBetween>(mean.bound).high, 8.0);
}

TEST(ScenarioChecks, OutputPeriod) {
  const auto rule = rule_of<OutputPeriod>(
      "kind = 'output_period'\nmessage = 'AlignAttitude'\nfrom_s = 1\nto_s = 2\nwithin_percent = 20");
  EXPECT_EQ(rule.message, "AlignAttitude");
  EXPECT_EQ(rule.window.from_us, 1'000'000);
  EXPECT_EQ(rule.window.to_us, 2'000'000);
  EXPECT_DOUBLE_EQ(rule.within, 0.2);
  EXPECT_EQ(rule.quantile, 1.0);
  const auto most = rule_of<OutputPeriod>(
      "kind = 'output_period'\nmessage = 'AlignAttitude'\nwithin_percent = 20\nquantile = 0.99");
  EXPECT_EQ(most.quantile, 0.99);
}

TEST(ScenarioChecks, Latency) {
  const auto rule = rule_of<Latency>("kind = 'latency'\nmessage = 'AlignUpdate'\nfrom_s = 1\nbelow_ms = 2.5");
  EXPECT_EQ(rule.message, "AlignUpdate");
  EXPECT_EQ(rule.window.from_us, 1'000'000);
  EXPECT_EQ(rule.below_us, 2'500);
  EXPECT_EQ(rule.quantile, 1.0);
  const auto most =
      rule_of<Latency>("kind = 'latency'\nmessage = 'AlignUpdate'\nbelow_ms = 2.5\nquantile = 0.999");
  EXPECT_EQ(most.quantile, 0.999);
}

TEST(ScenarioChecks, Counters) {
  const auto one = rule_of<Counters>("kind = 'counters'\nbad_crc_at_most = 3");
  EXPECT_EQ(one.bad_crc_at_most, 3);
  EXPECT_FALSE(one.frames_lost_at_most || one.bad_group_at_most || one.late_at_most);
  const auto rest = rule_of<Counters>(
      "kind = 'counters'\nframes_lost_at_most = 0\nbad_group_at_most = 1\nlate_at_most = 2");
  EXPECT_EQ(rest.frames_lost_at_most, 0);
  EXPECT_EQ(rest.bad_group_at_most, 1);
  EXPECT_EQ(rest.late_at_most, 2);
  EXPECT_FALSE(rest.bad_crc_at_most);
}

TEST(ScenarioChecks, BusErrorLimits) {
  const auto one = rule_of<BusErrorLimits>("kind = 'bus_errors'");
  EXPECT_EQ(one.bus_off_at_most, 0);
  EXPECT_EQ(one.down_at_most, 0);
  EXPECT_FALSE(one.passive_at_most || one.warning_at_most || one.error_frames_at_most ||
               one.late_in_queue_at_most);
  const auto rest = rule_of<BusErrorLimits>(
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
  const auto error = rule_of<AttitudeError>("kind = 'attitude_error'\naxis = 'heading'\nbelow_deg = 5");
  EXPECT_DOUBLE_EQ(error.below, 5 * world::units::deg);
  EXPECT_EQ(error.unit.name, "deg");
  const auto convergence =
      rule_of<Convergence>("kind = 'convergence'\naxis = 'heading'\nwithin_deg = 3\nbefore_s = 14");
  EXPECT_DOUBLE_EQ(convergence.within, 3 * world::units::deg);
  EXPECT_EQ(convergence.unit.name, "deg");
  EXPECT_EQ(rule_of<AttitudeError>("kind = 'attitude_error'\naxis = 'roll'\nbelow_mrad = 5").unit.name,
            "mrad");
}

TEST(ScenarioChecks, PositionError) {
  const auto rule =
      rule_of<PositionError>("kind = 'position_error'\naxis = 'horizontal'\nfrom_s = 3\nbelow_m = 12");
  EXPECT_EQ(rule.axis, PositionAxis::horizontal);
  EXPECT_EQ(rule.window.from_us, 3'000'000);
  EXPECT_DOUBLE_EQ(rule.below, 12.0);
  EXPECT_EQ(rule_of<PositionError>("kind = 'position_error'\nbelow_m = 1").axis, PositionAxis::norm);
}

TEST(ScenarioChecks, Fixes) {
  const auto rule = rule_of<Fixes>(
      "kind = 'fixes'\nfrom_s = 3\ngated_at_least = 2\ngated_at_most = 4\naccepted_at_least = 10\n"
      "repairs_at_most = 1\nhanded_over_before_s = 15");
  EXPECT_EQ(rule.window.from_us, 3'000'000);
  ASSERT_EQ(rule.counts.size(), 2U);
  EXPECT_EQ(rule.counts[0].outcome, "accepted");
  EXPECT_EQ(rule.counts[0].at_least, 10);
  EXPECT_FALSE(rule.counts[0].at_most);
  EXPECT_EQ(rule.counts[1].outcome, "gated");
  EXPECT_EQ(rule.counts[1].at_least, 2);
  EXPECT_EQ(rule.counts[1].at_most, 4);
  EXPECT_EQ(rule.repairs_at_most, 1);
  EXPECT_EQ(rule.handed_over_before_us, 15'000'000);
}

TEST(ScenarioChecks, Coasting) {
  const auto rule = rule_of<Coasting>("kind = 'coasting'\nto_s = 3\nat_least = 1\nat_most = 5");
  EXPECT_EQ(rule.window.to_us, 3'000'000);
  EXPECT_EQ(rule.at_least, 1);
  EXPECT_EQ(rule.at_most, 5);
}

TEST(ScenarioChecks, HeartbeatAndOrder) {
  EXPECT_EQ(rule_of<Heartbeat>("kind = 'heartbeat'\nsilent_at_most_s = 0.25").silent_at_most_us, 250'000);
  const Scenario s = parsed(with("[[check]]", "[[check]]\nkind = 'counters'\nlate_at_most = 0\n[[check]]"));
  ASSERT_EQ(s.checks.size(), 2U);
  EXPECT_EQ(kind(s.checks[0]), "counters");
  EXPECT_EQ(kind(s.checks[1]), "heartbeat");
}

TEST(ScenarioChecks, EnumsHaveTheirNames) {
  EXPECT_EQ(name(AttitudeAxis::heading), "heading");
  EXPECT_EQ(name(VelocityAxis::east), "east");
  EXPECT_EQ(name(Statistic::attitude_nees), "attitude_nees");
}

}  // namespace
}  // namespace canhil::scenario
