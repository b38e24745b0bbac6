// Checks of the response to a fault against the plain judge: detected_within, recovers_within, answering.
#include "bench/checks/kinds/answering.hpp"
#include "bench/checks/kinds/detected_within.hpp"
#include "bench/checks/kinds/recovers_within.hpp"
#include "bench/estimators/los_rate/los_rate.hpp"
#include "bench/estimators/los_rate/quantities.hpp"
#include "tests/unit/bench/checks/slow_judge.hpp"

namespace canhil::checks {
namespace {

constexpr double mrad = 1e-3;
constexpr std::int64_t second_us = 1'000'000;

// All times at which one source gave one sign.
struct PlainSign {
  std::string name, by;
  std::vector<std::int64_t> t_us{};
};

// The signs of docs/scenarios.md. The time of a mark is that of the answer's cause.
std::vector<PlainSign> signs_of(const PlainRun& of) {
  std::vector<PlainSign> signs;
  const auto add = [&](const std::string& name, const std::string& by, std::int64_t t_us) {
    for (PlainSign& one : signs) {
      if (one.name == name && one.by == by) return one.t_us.push_back(t_us);
    }
    signs.push_back({.name = name, .by = by, .t_us = {t_us}});
  };
  for (const Flown::Sample& epoch : of.flight.epochs) {
    for (const auto& [t_ns, answer] : of.run.answers) {
      if (answer.cause_us == epoch.t_us && answer.outcome == messages::LosRateOutcome::coasting)
        add("coasting", "an answer", epoch.t_us);
    }
  }
  for (const char* mark : {"degraded", "blind"}) {
    for (const Flown::Sample& epoch : of.flight.epochs) {
      for (const auto& [t_ns, answer] : of.run.answers) {
        const bool has = *mark == 'd' ? answer.degraded : answer.blind;
        if (answer.cause_us == epoch.t_us && has) add(mark, "an answer", epoch.t_us);
      }
    }
  }
  bool was_lost = false;
  for (const auto& [t_ns, beat] : of.run.heartbeats) {
    if (beat.error_input_lost != 0 && !was_lost) add("input_lost", "a heartbeat", t_ns / 1000);
    if (beat.degraded != 0) add("degraded", "a heartbeat", t_ns / 1000);
    was_lost = beat.error_input_lost != 0;
  }
  messages::TargetCounters before;
  for (const auto& [t_ns, counts] : of.run.counters) {
    if (counts.frames_lost > before.frames_lost) add("frames_lost", "a counter", t_ns / 1000);
    if (counts.bad_crc > before.bad_crc) add("bad_crc", "a counter", t_ns / 1000);
    if (counts.bad_group > before.bad_group) add("bad_group", "a counter", t_ns / 1000);
    if (counts.late > before.late) add("late", "a counter", t_ns / 1000);
    before = counts;
  }
  return signs;
}

// The signs that a check considers: those that were there in the 5 s before the fault can act do not count.
struct Considered {
  std::vector<PlainSign> fresh{}, there_before{};
  [[nodiscard]] Judged hidden() const {
    std::string text;
    for (const PlainSign& one : there_before)
      text += fmt::format("{}{} in {}", text.empty() ? "" : ", ", one.name, one.by);
    return not_measured("already present before it: " + text);
  }
};
Considered considered(const PlainRun& of, const Disturbance& fault, const std::vector<std::string>& by) {
  Considered found;
  for (const PlainSign& one : signs_of(of)) {
    if (!by.empty() && std::ranges::find(by, one.name) == by.end()) continue;
    bool before = false;
    for (const std::int64_t t_us : one.t_us)
      before = before || (t_us >= fault.valid_from_us - 5 * second_us && t_us < fault.valid_from_us);
    (before ? found.there_before : found.fresh).push_back(one);
  }
  return found;
}

struct At {
  std::int64_t t_us = 0;
  std::string text;
};
std::optional<At> first_from(const std::vector<PlainSign>& signs, std::int64_t from_us) {
  std::optional<At> first;
  for (const PlainSign& one : signs) {
    for (const std::int64_t t_us : one.t_us) {
      if (t_us >= from_us && (!first || t_us < first->t_us)) first = At{t_us, one.name + " in " + one.by};
    }
  }
  return first;
}
std::optional<At> last_after(const std::vector<PlainSign>& signs, std::int64_t after_us) {
  std::optional<At> last;
  for (const PlainSign& one : signs) {
    for (const std::int64_t t_us : one.t_us) {
      if (t_us > after_us && (!last || t_us > last->t_us)) last = At{t_us, one.name + " in " + one.by};
    }
  }
  return last;
}

bool struck(const PlainRun& of) { return of.run.fault->count > 0; }

Judged detected_within(const PlainRun& of, const DetectedWithin& rule) {
  if (!struck(of)) return not_measured("the fault 'it' did not strike");
  const Considered signs = considered(of, rule.disturbance, rule.by);
  const auto first = first_from(signs.fresh, rule.disturbance.valid_from_us);
  const std::int64_t after_us =
      first ? std::max<std::int64_t>(0, first->t_us - rule.disturbance.window.from_us) : 0;
  if (first && after_us <= rule.within_us)
    return passes_if(true, fmt::format("after {:.3f} s: {}", s(after_us), first->text));
  if (!signs.there_before.empty()) return signs.hidden();
  return fail(first ? fmt::format("after {:.3f} s: {}", s(after_us), first->text) : "no sign");
}

// Where an answer is missing for too long; empty: nowhere, or the window is no longer than a regular wait.
std::string silent_in(const PlainRun& of, scenario::Window window) {
  window.to_us = std::min(window.to_us, of.flight.passage_us);
  if (static_cast<double>(window.to_us - window.from_us) <= PlainRun::longest_wait_us) return "";
  const std::string why = of.silence(of.rows_in({.window = window}), {.window = window});
  return why.empty() ? "" : "los.rate.pitch: " + why;
}

Judged recovers_within(const PlainRun& of, const RecoversWithin& rule) {
  const std::int64_t end_us = rule.disturbance.window.to_us, due_us = end_us + rule.within_us;
  const scenario::Window after{.from_us = due_us, .to_us = of.duration_us};
  if (const std::string why = silent_in(of, after); !why.empty()) return fail(why);
  if (!struck(of)) return not_measured("the fault 'it' did not strike");
  const Considered signs = considered(of, rule.disturbance, rule.by);
  std::vector<PlainSign> ending = signs.fresh;
  if (!rule.by.empty()) ending.insert(ending.end(), signs.there_before.begin(), signs.there_before.end());
  const auto last = last_after(ending, end_us);
  std::string measured = last
                             ? fmt::format("last sign {:.3f} s after: {}", s(last->t_us - end_us), last->text)
                             : "no sign after its end";
  const bool ended = !last || last->t_us <= due_us;
  if (!rule.error) {
    if (ended && !first_from(signs.fresh, rule.disturbance.valid_from_us))
      return signs.there_before.empty()
                 ? not_measured("no sign at any time: there was nothing to recover from")
                 : signs.hidden();
    return of.unless_missing(passes_if(ended, measured), {.window = after});
  }
  std::optional<std::int64_t> beyond_us;
  bool any = false;
  for (const Row& row : of.rows) {
    any = any || row.t_us > due_us;
    if (row.t_us > end_us && !(std::abs(row.yaw) < rule.below)) beyond_us = row.t_us;
  }
  if (!any) return fail("no answers after that");
  measured +=
      beyond_us ? fmt::format(", below from {:.3f} s after", s(*beyond_us - end_us)) : ", always below";
  return of.unless_missing(passes_if(ended && (!beyond_us || *beyond_us <= due_us), measured),
                           {.window = after});
}

Judged answering(const PlainRun& of, const Answering& /*rule*/) {
  for (const bool pitch : {true, false}) {
    std::vector<double> values;
    for (const Row& row : of.rows) {
      const auto& sigma = row.answer.rate_sigma;
      const double value = pitch ? row.pitch : row.yaw, of_value = pitch ? sigma.pitch : sigma.yaw;
      values.push_back(std::isfinite(of_value) ? value : of_value);
    }
    if (const std::string why = PlainRun::not_numbers(of.rows, values); !why.empty())
      return fail(fmt::format("los.rate.{}: {}", pitch ? "pitch" : "yaw", why));
  }
  if (of.rows.empty()) return fail("no answers");
  const scenario::Window fault{.from_us = of.run.fault->valid_from_us, .to_us = of.run.fault->window.to_us};
  std::vector<scenario::Window> owed{{.from_us = 0, .to_us = of.duration_us}};
  if (struck(of))
    owed = {{.from_us = 0, .to_us = fault.from_us}, {.from_us = fault.to_us, .to_us = of.duration_us}};
  for (const scenario::Window& window : owed) {
    if (const std::string why = silent_in(of, window); !why.empty()) return fail(why);
  }
  std::vector<std::int64_t> beats{0};
  for (const auto& [t_ns, beat] : of.run.heartbeats) beats.push_back(t_ns / 1000);
  beats.push_back(of.duration_us);
  for (std::size_t i = 1; i < beats.size(); ++i) {
    if (beats[i] - beats[i - 1] <= second_us + 100'000) continue;
    for (const scenario::Window& window : owed) {
      const std::int64_t from_us = std::max(beats[i - 1], window.from_us);
      const std::int64_t to_us = std::min(beats[i], window.to_us);
      if (to_us - from_us > second_us + 100'000)
        return fail(fmt::format("no heartbeat from {:g} to {:g} s", s(from_us), s(to_us)));
    }
  }
  return of.unless_missing(passes_if(true, fmt::format("{} values", 2 * of.rows.size())), of.whole());
}

class SlowJudgeOfResponses : public SlowJudge {
 protected:
  // A fault that may not strike. Samples that were measured before it may be sent while it acts.
  static Disturbance fault(Drawn& run) {
    const std::int64_t from_us = std::llround(run.one_of({1e6, 2.5e6, 5.4e6}));
    const Disturbance drawn{.fault = "it",
                            .window = {.from_us = from_us, .to_us = from_us + 500'000},
                            .valid_from_us = from_us - 20'000};
    run.fault = FaultRecord{.name = "it",
                            .window = drawn.window,
                            .valid_from_us = drawn.valid_from_us,
                            .count = run.uniform() < 0.9 ? 1U : 0U};
    // In half of the runs the marks begin with the first samples that the fault may affect.
    if (run.uniform() < 0.5) {
      for (auto& [t_ns, answer] : run.answers) {
        if (answer.cause_us >= drawn.valid_from_us || run.uniform() < 1e-3) continue;
        answer.blind = answer.degraded = false;
        if (answer.outcome == messages::LosRateOutcome::coasting)
          answer.outcome = messages::LosRateOutcome::updated;
      }
    }
    return drawn;
  }
  static std::vector<std::string> by(Drawn& run) {
    if (run.uniform() < 0.4) return {};
    if (run.uniform() < 0.5) return {"degraded"};
    return {"input_lost", "bad_crc", "blind"};
  }

  const std::vector<Outcome> each_{Outcome::pass, Outcome::fail, Outcome::not_measured};
  const std::vector<Subject> reported_ = always_reported(estimators::los_rate);
};

TEST_F(SlowJudgeOfResponses, AgreesAboutDetection) {
  const auto draw = [](Drawn& run) {
    return DetectedWithin{
        .disturbance = fault(run), .within_us = std::llround(run.one_of({1e4, 1e5, 5e5})), .by = by(run)};
  };
  expect_agreement(each_, draw, detected_within);
}

TEST_F(SlowJudgeOfResponses, AgreesAboutRecovery) {
  const auto draw = [&](Drawn& run) {
    RecoversWithin rule{.disturbance = fault(run),
                        .within_us = std::llround(run.one_of({1e5, 1e6})),
                        .by = by(run),
                        .below = run.one_of({5, 20}) * mrad,
                        .unit = quantities::mradps,
                        .answering = reported_};
    if (run.uniform() < 0.5)
      rule.error =
          Subject{.estimator = "los_rate", .quantity = &quantities::los_rate_yaw, .text = "los.rate.yaw"};
    return rule;
  };
  expect_agreement(each_, draw, recovers_within);
}

TEST_F(SlowJudgeOfResponses, AgreesAboutAnswering) {
  const auto draw = [&](Drawn& run) {
    fault(run);
    return Answering{.judged = reported_};
  };
  expect_agreement(each_, draw, answering);
}

}  // namespace
}  // namespace canhil::checks
