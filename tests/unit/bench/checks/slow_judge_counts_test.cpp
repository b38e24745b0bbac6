// Checks of the target's own counters against the plain judge: counters, counts_match.
#include "bench/checks/kinds/counters.hpp"
#include "bench/checks/kinds/counts_match.hpp"
#include "tests/unit/bench/checks/slow_judge.hpp"

namespace canhil::checks {
namespace {

using messages::TargetCounters;

struct PlainCount {
  const char* name = nullptr;
  std::uint16_t TargetCounters::*value = nullptr;
};
constexpr std::array<PlainCount, 4> each_count{{{"frames lost", &TargetCounters::frames_lost},
                                                {"bad CRC", &TargetCounters::bad_crc},
                                                {"bad groups", &TargetCounters::bad_group},
                                                {"late", &TargetCounters::late}}};

// No count may go down, and the last TargetCounters may be at most two of its periods old at the end.
Judged of_whole_run(const PlainRun& of, Judged verdict) {
  const auto& all = of.run.counters;
  for (std::size_t i = 1; i < all.size(); ++i) {
    for (const PlainCount& count : each_count) {
      const int was = all[i - 1].what.*count.value, is = all[i].what.*count.value;
      if (is < was)
        return fail(fmt::format("{}; the counts went down: {} {} -> {} at {:g} s", verdict.measured,
                                count.name, was, is, s(all[i].t_ns / 1000)));
    }
  }
  const std::int64_t last_us = all.back().t_ns / 1000;
  if (of.duration_us - last_us <= 200'000) return verdict;
  if (of.run.fault && of.run.fault->count > 0 && of.run.fault->window.to_us >= last_us && of.run.outages == 0)
    return verdict;  // the target was stopped
  const std::string stopped =
      fmt::format("{}; TargetCounters stopped at {:g} s", verdict.measured, s(last_us));
  return of.run.outages > 0 ? not_measured(stopped + "; the bus was away 1 time") : fail(stopped);
}

Judged counters(const PlainRun& of, const Counters& rule) {
  if (of.run.counters.empty()) return fail("no TargetCounters");
  const TargetCounters& last = of.run.counters.back().what;
  const std::array limits{rule.frames_lost_at_most, rule.bad_crc_at_most, rule.bad_group_at_most,
                          rule.late_at_most};
  Judged verdict{.outcome = Outcome::pass, .measured = {}};
  for (std::size_t i = 0; i < limits.size(); ++i) {
    if (!limits[i]) continue;
    const int value = last.*each_count[i].value;
    verdict.measured +=
        fmt::format("{}{} {}", verdict.measured.empty() ? "" : ", ", each_count[i].name, value);
    if (value > *limits[i]) verdict.outcome = Outcome::fail;
  }
  return of_whole_run(of, verdict);
}

// All counts saturate at 8191.
Judged counts_match(const PlainRun& of, const CountsMatch& rule) {
  if (of.run.counters.empty()) return fail("no TargetCounters");
  const TargetCounters& last = of.run.counters.back().what;
  const auto& [least, most] = of.run.expected_counts;
  const std::array slacks{rule.frames_lost_slack, rule.bad_crc_slack, rule.bad_group_slack, rule.late_slack};
  const std::array lows{least.frames_lost, least.bad_crc, least.bad_group, least.late};
  const std::array highs{most.frames_lost, most.bad_crc, most.bad_group, most.late};
  Judged verdict{.outcome = Outcome::pass, .measured = {}};
  for (std::size_t i = 0; i < slacks.size(); ++i) {
    const std::int64_t value = last.*each_count[i].value,
                       low = static_cast<std::int64_t>(lows[i]) - slacks[i],
                       high = static_cast<std::int64_t>(highs[i]) + slacks[i];
    if (value < std::min<std::int64_t>(low, 8191) || value > std::min<std::int64_t>(high, 8191))
      verdict.outcome = Outcome::fail;
    verdict.measured += fmt::format("{}{} {}", i == 0 ? "" : ", ", each_count[i].name, value);
  }
  if (verdict.outcome == Outcome::fail && of.run.outages > 0)
    verdict = not_measured(verdict.measured + "; the bus was away 1 time");
  return of_whole_run(of, verdict);
}

class SlowJudgeOfCounts : public SlowJudge {
 protected:
  // A fault that stops the target for a while, or until after the end.
  static void stop_target(Drawn& run) {
    if (run.uniform() < 0.7) return;
    const std::int64_t from_us = std::llround(run.uniform() * 5e6);
    run.fault = FaultRecord{.name = "it",
                            .window = {.from_us = from_us, .to_us = from_us + second_us},
                            .valid_from_us = from_us,
                            .of_target = true,
                            .count = 1};
    std::erase_if(run.counters, [&](const auto& one) { return one.t_ns >= from_us * 1000; });
  }
  static constexpr std::int64_t second_us = 1'000'000;
  const std::vector<Outcome> each_{Outcome::pass, Outcome::fail, Outcome::not_measured};
};

TEST_F(SlowJudgeOfCounts, AgreesAboutCounters) {
  const auto draw = [](Drawn& run) {
    stop_target(run);
    Counters rule{.frames_lost_at_most = std::llround(run.one_of({0, 3, 8191})),
                  .bad_crc_at_most = std::llround(run.one_of({0, 1, 2}))};
    if (run.uniform() < 0.5) rule.late_at_most = 1;
    if (run.uniform() < 0.5) rule.bad_group_at_most = 2;
    return rule;
  };
  expect_agreement(each_, draw, counters);
}

TEST_F(SlowJudgeOfCounts, AgreesAboutCountsThatTheBenchExpects) {
  const auto draw = [](Drawn& run) {
    stop_target(run);
    // In half of the runs the bench expects what the target counts.
    if (run.uniform() < 0.5 && !run.counters.empty()) {
      run.expected_counts.least.frames_lost = run.expected_counts.most.frames_lost =
          run.counters.back().what.frames_lost;
    }
    const auto slack = [&] { return std::llround(run.one_of({0, 1, 3, 10})); };
    return CountsMatch{.frames_lost_slack = slack(),
                       .bad_crc_slack = slack(),
                       .bad_group_slack = slack(),
                       .late_slack = slack()};
  };
  expect_agreement(each_, draw, counts_match);
}

}  // namespace
}  // namespace canhil::checks
