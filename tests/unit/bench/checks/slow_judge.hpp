// Judges random runs twice: by the checks of the bench, and by a judge that is written in the plainest way
// from the definitions in docs/scenarios.md and docs/report.md. For each sample of the flight, the plain
// judge looks through all answers for those that name the sample.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "bench/bindings/canhil.hpp"
#include "tests/unit/bench/checks/drawn.hpp"
#include "tests/unit/bench/checks/fly_past.hpp"
#include "tests/unit/bench/checks/judged.hpp"

namespace canhil::checks {

struct Judged {
  Outcome outcome = Outcome::not_measured;
  std::string measured;
};
inline std::ostream& operator<<(std::ostream& to, const Judged& one) {
  return to << name(one.outcome) << ": " << one.measured;
}
inline bool operator==(const Judged& a, const Judged& b) {
  return a.outcome == b.outcome && a.measured == b.measured;
}
inline Judged fail(std::string why) { return {Outcome::fail, std::move(why)}; }
inline Judged not_measured(std::string why) { return {Outcome::not_measured, std::move(why)}; }
inline Judged passes_if(bool holds, std::string measured) {
  return {holds ? Outcome::pass : Outcome::fail, std::move(measured)};
}
inline double s(std::int64_t t_us) { return 1e-6 * static_cast<double>(t_us); }
inline bool lies_in(const scenario::Window& window, std::int64_t t_us) {
  return t_us >= window.from_us && t_us <= window.to_us;
}

/// One answer with an estimate, and the truth of its sample.
struct Row {
  std::int64_t t_us = 0;
  double to_go_s = 0;
  double pitch = 0, yaw = 0;  ///< errors
  estimators::LosAnswer answer;
};

/// A run as the plain judge sees it.
struct PlainRun {
  static constexpr double longest_wait_us = 1.01e6;  ///< one period and a second
  const Drawn& run;
  const Flown& flight;
  std::int64_t duration_us = 0;
  std::vector<Row> rows{};  ///< in order of the samples, and of the arrival of the answers to one sample
  std::vector<std::int64_t> all{};  ///< the samples of all answers

  PlainRun(const Drawn& of, const Flown& flown, std::int64_t lasts_us)
      : run(of), flight(flown), duration_us(lasts_us) {
    for (const Flown::Sample& epoch : flight.epochs) {
      for (const auto& [t_ns, answer] : run.answers) {
        if (answer.cause_us != epoch.t_us) continue;
        all.push_back(epoch.t_us);
        if (answer.outcome == messages::LosRateOutcome::waiting) continue;
        rows.push_back({.t_us = epoch.t_us,
                        .to_go_s = epoch.time_to_go(),
                        .pitch = answer.rate.pitch - epoch.los_rate.pitch,
                        .yaw = answer.rate.yaw - epoch.los_rate.yaw,
                        .answer = answer});
      }
    }
  }

  static bool lies_in_stretch(const Stretch& stretch, std::int64_t t_us, double to_go_s) {
    if (!stretch.to_go_s) return lies_in(stretch.window, t_us);
    return to_go_s >= stretch.to_go_s->first && to_go_s < stretch.to_go_s->second;
  }
  [[nodiscard]] std::vector<Row> rows_in(const Stretch& stretch) const {
    std::vector<Row> found;
    for (const Row& row : rows) {
      if (lies_in_stretch(stretch, row.t_us, row.to_go_s)) found.push_back(row);
    }
    return found;
  }

  /// Where answers are missing for too long; empty: nowhere.
  [[nodiscard]] std::string silence(const std::vector<Row>& in, const Stretch& stretch) const {
    if (in.empty()) return "no answers";
    if (stretch.to_go_s) {
      int samples = 0, answered = 0;
      for (const Flown::Sample& epoch : flight.epochs) {
        if (!lies_in_stretch(stretch, epoch.t_us, epoch.time_to_go())) continue;
        ++samples;
        bool found = false;
        for (const Row& row : in) found = found || row.t_us == epoch.t_us;
        answered += found ? 1 : 0;
      }
      return 2 * answered < samples ? fmt::format("answers to {} of {} samples", answered, samples) : "";
    }
    std::vector<std::int64_t> times{stretch.window.from_us};
    for (const Row& row : in) times.push_back(row.t_us);
    times.push_back(std::min(stretch.window.to_us, flight.passage_us));
    for (std::size_t i = 1; i < times.size(); ++i) {
      if (static_cast<double>(times[i] - times[i - 1]) > longest_wait_us)
        return fmt::format("no answers from {:g} to {:g} s", s(times[i - 1]), s(times[i]));
    }
    return "";
  }

  /// How many values are not numbers; empty: none. `values`: one for each of `in`.
  static std::string not_numbers(const std::vector<Row>& in, const std::vector<double>& values,
                                 const char* what = "answers") {
    std::size_t count = 0, first = 0;
    for (std::size_t i = values.size(); i-- > 0;) {
      if (std::abs(values[i]) <= std::numeric_limits<double>::max()) continue;
      ++count;
      first = i;
    }
    if (count == 0) return "";
    return fmt::format("{} of {} {} are not a number (NaN or infinite), first at {:g} s", count,
                       values.size(), what, s(in[first].t_us));
  }

  struct Due {
    int due = 0, came = 0;
  };
  /// The samples of a stretch to which an answer was due: none is due while a fault acts and until 0.1 s
  /// after it.
  [[nodiscard]] Due due_in(const Stretch& stretch) const {
    Due found;
    for (const Flown::Sample& epoch : flight.epochs) {
      if (!lies_in_stretch(stretch, epoch.t_us, epoch.time_to_go())) continue;
      if (run.fault && run.fault->count > 0 && epoch.t_us >= run.fault->valid_from_us &&
          epoch.t_us <= run.fault->window.to_us + 100'000)
        continue;
      ++found.due;
      bool came = false;
      for (const std::int64_t t_us : all) came = came || t_us == epoch.t_us;
      found.came += came ? 1 : 0;
    }
    return found;
  }
  /// The verdict if answers are missing: the target's fault, unless it counted frames as lost that the bench
  /// did not withhold, or the bus was away.
  [[nodiscard]] Judged too_few(const Due& found) const {
    Judged why = fail(fmt::format("LosRateTarget: answers to {} of {} samples", found.came, found.due));
    std::uint64_t lost = 0;
    if (!run.counters.empty()) {
      const auto& [t_ns, last] = run.counters.back();
      const LossCounts& most = run.expected_counts.most;
      if (last.frames_lost > most.frames_lost) lost += last.frames_lost - most.frames_lost;
      if (last.bad_crc > most.bad_crc) lost += last.bad_crc - most.bad_crc;
      if (last.bad_group > most.bad_group) lost += last.bad_group - most.bad_group;
    }
    const auto missing = static_cast<std::uint64_t>(found.due - found.came);
    if (found.came > 0 && lost > 0 && missing <= run.frames_lost + lost)
      return not_measured(why.measured + fmt::format("; {} frames were lost on the way to the target", lost));
    if (run.outages > 0) return not_measured(why.measured + "; the bus was away 1 time");
    return why;
  }
  /// A verdict of values, unless it is a pass and answers are missing that should be judged.
  [[nodiscard]] Judged unless_missing(Judged verdict, const Stretch& stretch) const {
    if (verdict.outcome != Outcome::pass) return verdict;
    const Due found = due_in(stretch);
    const bool half = 2 * found.came >= found.due;
    if (half && static_cast<std::uint32_t>(found.due - found.came) <= run.frames_lost) return verdict;
    return too_few(found);
  }
  [[nodiscard]] Stretch whole() const { return {.window = {.from_us = 0, .to_us = duration_us}}; }
};

inline constexpr auto expect_equal = [](const Judged& found, const Judged& expected) {
  EXPECT_EQ(found, expected);
};

/// The numbers of a check tell the same as its outcome: a value is within its limits if the check passes, and
/// beyond one of them if it fails.
inline void expect_numbers_agree(const CheckResult& found) {
  const auto& [criterion, measurement] = found.judgement;
  if (!measurement.value || found.outcome == Outcome::not_measured) return;
  ASSERT_TRUE(criterion.lower || criterion.upper) << found.kind;
  const double value = *measurement.value;
  bool good = true;
  if (const auto& lower = criterion.lower)
    good = good && (lower->inclusive ? value >= lower->value : value > lower->value);
  if (const auto& upper = criterion.upper)
    good = good && (upper->inclusive ? value <= upper->value : value < upper->value);
  EXPECT_EQ(good, found.outcome == Outcome::pass) << found.kind << ": " << value << " " << criterion.unit
                                                  << ", " << to_text(criterion) << "; " << found.measured;
}

class SlowJudge : public FlyPast {
 protected:
  /// Draws many runs and a rule for each, and expects that plain(run, rule) agrees with the bench and that
  /// each of the outcomes occurs. draw(run) returns the rule; it may change the run. same(found, expected)
  /// compares the verdicts.
  template <class Draw, class Plain, class Same = decltype(expect_equal)>
  void expect_agreement(const std::vector<Outcome>& outcomes, Draw draw, Plain plain, unsigned runs = 200,
                        Same same = expect_equal) {
    std::map<Outcome, int> times;
    for (unsigned seed = 0; seed < runs; ++seed) {
      Drawn run(seed, flight_, duration_us);
      scenario::Scenario scenario;
      scenario.binding = bindings::canhil();
      const auto rule = draw(run);
      scenario.checks.push_back(check_of(rule));
      const Observations seen = observed(run, flight_, duration_us, scenario.checks);
      Evidence evidence{
          .seen = seen, .truth = truth(), .estimators = estimators::all(), .timing_unfit = run.timing_unfit};
      evidence.delays.waits.add(run.waited_ns, run.waits);
      if (run.waits < 600) evidence.delays.waits.add(0, 600 - run.waits);
      const CheckResult found = checks::judge(scenario, std::move(evidence)).checks.at(0);
      const Judged expected = plain(PlainRun(run, flight_, duration_us), rule);
      same(Judged{found.outcome, found.measured}, expected);
      expect_numbers_agree(found);
      ASSERT_FALSE(HasFailure()) << "seed " << seed << ", " << found.expected;
      ++times[expected.outcome];
    }
    for (const Outcome outcome : outcomes) EXPECT_GE(times[outcome], 5) << name(outcome);
  }

  static scenario::Window window(Drawn& of) {
    const double from_s = of.one_of({0, 1, 2.5}), to_s = of.one_of({3, 4, 6});
    return {.from_us = std::llround(from_s * 1e6), .to_us = std::llround(to_s * 1e6)};
  }
};

}  // namespace canhil::checks
