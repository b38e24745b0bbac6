// Checks of times against the plain judge: latency, latency_growth, output_period, own_times, heartbeat.
//
// A series of answers does not alter the other kinds of a bus:
// - bus_load counts the lengths of all frames on the bus, whatever they say and whenever they come;
// - bus_errors counts what the controller and the interface report;
// - wire_response compares single frames with the bound of their message;
// - protection counts frames by checksum, counter and size, before they become answers.
#include "bench/checks/kinds/heartbeat.hpp"
#include "bench/checks/kinds/latency.hpp"
#include "bench/checks/kinds/latency_growth.hpp"
#include "bench/checks/kinds/output_period.hpp"
#include "bench/checks/kinds/own_times.hpp"
#include "tests/unit/bench/checks/slow_judge.hpp"

namespace canhil::checks {
namespace {

constexpr double nominal_s = 0.01;
const std::string message = "LosRateTarget";

// Times are counted in buckets (docs/report.md): 1 us wide below 10 ms, 10 us below 100 ms, 100 us below 1 s,
// 1 ms below 10 s. Returns the middle of the bucket [us].
double bucket_us(std::int64_t ns) {
  const std::int64_t us = ns / 1000;
  const std::int64_t width = us < 10'000 ? 1 : us < 100'000 ? 10 : us < 1'000'000 ? 100 : 1000;
  return static_cast<double>(us / width * width) + 0.5 * static_cast<double>(width);
}

// The value of the nearest rank among the times and `missing` longer ones; none: it is one of those. [ns]
std::optional<double> quantile_ns(std::vector<std::int64_t> times, double q, int missing = 0) {
  std::ranges::sort(times);
  const auto all = static_cast<double>(times.size()) + missing;
  const auto rank = static_cast<std::size_t>(std::max(1.0, std::ceil(q * all)));
  if (rank > times.size()) return std::nullopt;
  const auto least = static_cast<double>(times.front()), most = static_cast<double>(times.back());
  if (rank == times.size()) return most;
  return std::clamp(1e3 * bucket_us(times[rank - 1]), least, most);
}

std::string quantile_text(double q) { return q < 1 ? fmt::format("{:g} % quantile", q * 100) : "max"; }

// Why the host is no measure for a limit; empty: it is.
std::string unfit(const Drawn& run, double q, double bar_s) {
  if (!run.timing_unfit.empty()) return run.timing_unfit;
  std::vector<std::int64_t> late = run.late_ns;
  late.push_back(0);  // the first frame of the run
  const double late_s = *quantile_ns(late, q) * 1e-9;
  if (late_s <= 0.5 * bar_s) return "";
  return fmt::format("this host kept the bench itself {:.2f} ms late ({}), more than 50 % of the limit",
                     late_s * 1e3, quantile_text(q));
}

// The target's wait in each of 600 looks.
std::vector<std::int64_t> waits(const Drawn& run) {
  std::vector<std::int64_t> all(static_cast<std::size_t>(run.waits), run.waited_ns);
  all.resize(600);
  return all;
}

// A failure is not measured if the host kept the target waiting for more than half of the limit.
Judged unless_waited(const Drawn& run, double q, double bar_s, Judged verdict) {
  const double waited_s = waits(run).empty() ? 0 : *quantile_ns(waits(run), q) * 1e-9;
  if (verdict.outcome != Outcome::fail || waited_s <= 0.5 * bar_s) return verdict;
  return not_measured(fmt::format(
      "{}; on this host other programs kept the target waiting for a CPU for {:.2f} ms ({}), more "
      "than 50 % of the limit",
      verdict.measured, waited_s * 1e3, quantile_text(q)));
}

// How many times are above half of the limit, each as the middle of its bucket.
std::int64_t disturbing(const std::vector<std::int64_t>& times_ns, double bar_s) {
  return std::ranges::count_if(times_ns, [&](std::int64_t ns) { return bucket_us(ns) * 1e-6 > 0.5 * bar_s; });
}

// The target does not fail if `outside` of `count` values are beyond the limit, and those that the host did
// not spoil would pass. `off_ns`: how far the bench was off, for each stimulus. A wait shorter than the
// period spoils two values, and three if it is longer than `long_s`.
Judged unless_disturbed(const Drawn& run, double q, double bar_s, Judged verdict, std::int64_t outside,
                        std::int64_t count, std::int64_t missing, const std::vector<std::int64_t>& off_ns,
                        double long_s = std::numeric_limits<double>::infinity()) {
  const std::int64_t late = disturbing(off_ns, bar_s), waited = disturbing(waits(run), bar_s);
  const std::int64_t long_waits = disturbing(waits(run), std::max(bar_s, 2 * long_s));
  const std::int64_t spoiled = std::min(outside, late + 2 * waited + long_waits);
  const double good = std::max(1.0, std::ceil(q * static_cast<double>(count)));
  const bool enough_good = static_cast<double>(count - missing - outside + spoiled) >= good;
  if (verdict.outcome != Outcome::fail || spoiled == 0 || !enough_good) return verdict;
  verdict = unless_waited(run, q, bar_s, std::move(verdict));
  if (verdict.outcome != Outcome::fail) return verdict;
  return not_measured(fmt::format(
      "{}; {} of {} are beyond the limit, and this host can have caused {}: {} of the bench's stimuli were "
      "off, and the target had no CPU {} times, each by more than 50 % of the limit",
      verdict.measured, outside, count, spoiled, late, waited));
}

// Each sample once. If it was answered several times, its latency is the longest.
std::vector<std::int64_t> latencies(const PlainRun& of, const scenario::Window& window) {
  std::vector<std::int64_t> found;
  for (std::size_t i = 0; i < of.flight.epochs.size(); ++i) {
    const std::int64_t valid_us = of.flight.epochs[i].t_us;
    std::optional<std::int64_t> longest;
    for (const auto& [t_ns, answer] : of.run.answers) {
      if (answer.cause_us != valid_us) continue;
      longest = std::max(longest.value_or(0), t_ns - (valid_us * 1000 + of.run.late_ns[i]));
    }
    if (longest && lies_in(window, valid_us)) found.push_back(*longest);
  }
  return found;
}

Judged latency(const PlainRun& of, const Latency& rule) {
  const double bar_s = s(rule.below_us);
  if (!of.run.timing_unfit.empty()) return not_measured(of.run.timing_unfit);
  const PlainRun::Due due = of.due_in({.window = rule.window});
  if (2 * due.came < due.due) return of.too_few(due);  // although the host may have been late
  if (std::string why = unfit(of.run, rule.quantile, bar_s); !why.empty()) return not_measured(why);
  const auto times = latencies(of, rule.window);
  if (times.empty()) return fail("no answers");
  const auto value = quantile_ns(times, rule.quantile, due.due - due.came);
  if (!value) return of.too_few(due);
  const double value_s = *value * 1e-9;
  std::vector<std::int64_t> late;
  for (std::size_t i = 0; i < of.flight.epochs.size(); ++i) {
    if (lies_in(rule.window, of.flight.epochs[i].t_us)) late.push_back(of.run.late_ns[i]);
  }
  const auto outside =
      std::ranges::count_if(times, [&](std::int64_t ns) { return bucket_us(ns) * 1e-6 > bar_s; });
  return unless_disturbed(
      of.run, rule.quantile, bar_s,
      passes_if(value_s < bar_s, fmt::format("{:.3f} ms of {}", value_s * 1e3, times.size())), outside,
      std::ssize(times) + due.due - due.came, due.due - due.came, late);
}

std::string in(const scenario::Window& window) {
  return fmt::format(" from {:g} to {:g} s", s(window.from_us), s(window.to_us));
}

Judged latency_growth(const PlainRun& of, const LatencyGrowth& rule) {
  constexpr double half = 0.5;
  if (!of.run.timing_unfit.empty()) return not_measured(of.run.timing_unfit);
  std::vector<double> medians_s, host_s;
  std::vector<std::size_t> counts;
  std::optional<Judged> missing;
  for (const scenario::Window& window : {rule.first, rule.last}) {
    const auto times = latencies(of, window);
    if (times.empty()) return fail("no answers");
    const PlainRun::Due due = of.due_in({.window = window});
    const auto median = quantile_ns(times, half, due.due - due.came);
    if (!median && !missing) {
      missing = of.too_few(due);
      missing->measured += in(window);
    }
    medians_s.push_back(median.value_or(0) * 1e-9);
    counts.push_back(times.size());
    std::vector<std::int64_t> late;
    for (std::size_t i = 0; i < of.flight.epochs.size(); ++i) {
      if (lies_in(window, of.flight.epochs[i].t_us)) late.push_back(of.run.late_ns[i]);
    }
    host_s.push_back(*quantile_ns(late, half));
  }
  if (missing) return *missing;
  const double permitted_s = (rule.ratio_below - 1) * medians_s[0];
  Judged judged =
      unless_waited(of.run, half, permitted_s,
                    passes_if(medians_s[1] < rule.ratio_below * medians_s[0],
                              fmt::format("{:.3f} ms of {}, before {:.3f} ms of {}", medians_s[1] * 1e3,
                                          counts[1], medians_s[0] * 1e3, counts[0])));
  if (judged.outcome != Outcome::fail) return judged;
  const double host_grew_s = (host_s[1] - host_s[0]) * 1e-9, wake_s = host_s[1] * 1e-9;
  if (host_grew_s > 0.5 * permitted_s)
    return not_measured(
        judged.measured +
        fmt::format("; this host delayed the bench itself more by {:.3f} ms (median), more than "
                    "50 % of the allowed growth of the latency",
                    host_grew_s * 1e3));
  if (medians_s[1] - medians_s[0] >= wake_s) return judged;
  return not_measured(
      judged.measured +
      fmt::format("; it grew by less than this host takes to wake the bench itself, {:.3f} ms (median)",
                  wake_s * 1e3));
}

// All arrivals count, in the order in which they came; the window is that of their causes.
Judged output_period(const PlainRun& of, const OutputPeriod& rule) {
  const double permitted_s = nominal_s * rule.within;
  if (!of.run.timing_unfit.empty()) return not_measured(of.run.timing_unfit);
  std::vector<std::int64_t> arrivals, periods, stimuli, own_deviations;
  for (std::size_t i = 0; i < of.flight.epochs.size(); ++i) {
    const std::int64_t valid_us = of.flight.epochs[i].t_us;
    if (!lies_in(rule.window, valid_us)) continue;
    stimuli.push_back(valid_us * 1000 + of.run.late_ns[i]);
    if (i == 0) continue;
    const std::int64_t off_ns = of.run.late_ns[i] - of.run.late_ns[i - 1];
    const double lasts = std::round(1 + static_cast<double>(off_ns) * 1e-9 / nominal_s);
    for (double times = std::max(1.0, lasts); times > 0; --times)  // each period that it lasts
      own_deviations.push_back(std::abs(off_ns));
  }
  const double off_s = *quantile_ns(own_deviations, rule.quantile) * 1e-9;
  std::string why = unfit(of.run, rule.quantile, permitted_s);
  if (why.empty() && off_s > 0.5 * permitted_s)
    why = fmt::format("the bench's own stimuli came {:.3f} ms off", off_s * 1e3);
  if (!why.empty()) {
    const PlainRun::Due due = of.due_in({.window = rule.window});
    return 2 * due.came >= due.due ? not_measured(why) : of.too_few(due);
  }
  for (const auto& [t_ns, answer] : of.run.answers) {
    if (!lies_in(rule.window, answer.cause_us)) continue;
    if (!arrivals.empty()) periods.push_back(t_ns - arrivals.back());
    arrivals.push_back(t_ns);
  }
  if (periods.empty()) return fail("fewer than two arrivals");
  std::vector<double> deviations;  // each once for each nominal period that it lasts
  const auto add = [&](double period_s) {
    for (double times = std::max(1.0, std::round(period_s / nominal_s)); times > 0; --times)
      deviations.push_back(std::abs(period_s - nominal_s));
  };
  const auto [least, most] = std::ranges::minmax(periods);
  for (const std::int64_t period_ns : periods)
    add(std::clamp(bucket_us(period_ns) * 1e-6, static_cast<double>(least) * 1e-9,
                   static_cast<double>(most) * 1e-9));
  for (const std::int64_t silent_ns :
       {arrivals.front() - stimuli.front(), stimuli.back() - arrivals.back()}) {
    const double silent_s = static_cast<double>(silent_ns) * 1e-9;
    if (silent_s > nominal_s) add(silent_s);
  }
  std::ranges::sort(deviations);
  const double rank = std::max(1.0, std::ceil(rule.quantile * static_cast<double>(deviations.size())));
  const double value_s = deviations[static_cast<std::size_t>(rank) - 1];
  const auto outside =
      std::ranges::count_if(deviations, [&](double deviation_s) { return deviation_s > permitted_s; });
  return unless_disturbed(of.run, rule.quantile, permitted_s,
                          passes_if(value_s <= permitted_s,
                                    fmt::format("{:.3f} ms off, of {}", value_s * 1e3, deviations.size())),
                          outside, std::ssize(deviations), 0, own_deviations, nominal_s / 2);
}

Judged own_times(const PlainRun& of, const OwnTimes& /*rule*/) {
  if (!of.run.timing_unfit.empty()) return not_measured(of.run.timing_unfit);
  if (of.run.timings.empty()) return fail("no TargetTiming");
  std::vector<std::int64_t> first_answers;  // of each answered sample
  for (const Flown::Sample& epoch : of.flight.epochs) {
    const auto first = std::ranges::find_if(of.run.answers,
                                            [&](const auto& one) { return one.what.cause_us == epoch.t_us; });
    if (first != of.run.answers.end()) first_answers.push_back(first->t_ns);
  }
  if (first_answers.empty()) return fail("no answers");
  std::int64_t latency_ns = 0, queue_us = 0, compute_us = 0, reported = 0;
  for (const std::int64_t one : latencies(of, of.whole().window)) latency_ns += one;
  std::int64_t before_ns = 0;
  for (const auto& [t_ns, timing] : of.run.timings) {
    for (const std::int64_t answered_ns : first_answers) {
      if (answered_ns < before_ns || answered_ns >= t_ns) continue;
      ++reported;
      queue_us += timing.queue_mean_us;
      compute_us += timing.compute_mean_us;
    }
    before_ns = t_ns;
  }
  if (reported == 0) return fail("TargetTiming accounts for no stimulus");
  const auto mean_us = [](std::int64_t sum_ns, auto count) {
    return 1e-3 * static_cast<double>(sum_ns) / static_cast<double>(count);
  };
  const double queue = mean_us(1000 * queue_us, reported), compute = mean_us(1000 * compute_us, reported),
               took = mean_us(latency_ns, first_answers.size());
  return passes_if(
      queue + compute > 0 && queue + compute <= took,
      fmt::format("mean queueing {:.1f} us, computing {:.1f} us, latency {:.1f} us", queue, compute, took));
}

Judged heartbeat(const PlainRun& of, const Heartbeat& rule) {
  const double most_s = s(rule.silent_at_most_us);
  if (std::string why = unfit(of.run, 1, most_s); !why.empty()) return not_measured(why);
  std::vector<std::int64_t> times{0};
  for (const auto& [t_ns, beat] : of.run.heartbeats) times.push_back(t_ns);
  times.push_back(of.duration_us * 1000);
  std::int64_t longest_ns = 0;
  for (std::size_t i = 1; i < times.size(); ++i) longest_ns = std::max(longest_ns, times[i] - times[i - 1]);
  const double longest_s = static_cast<double>(longest_ns) * 1e-9;
  return unless_waited(of.run, 1, most_s,
                       passes_if(longest_s <= most_s, fmt::format("longest gap {:.3f} s", longest_s)));
}

class SlowJudgeOfTimes : public SlowJudge {
 protected:
  // The host stalls the bench now and then, and the answers come as much later; the target waits for a CPU,
  // now and then or most of the time.
  void disturb(Drawn& run) const {
    const double stalled = run.one_of({0, 0, 0.005, 0.05});
    std::int64_t sent_ns = 0;                       // in order: no frame before the one before it
    std::map<std::int64_t, std::int64_t> later_ns;  // by the time of the sample [us]
    for (std::size_t i = 0; i < run.late_ns.size(); ++i) {
      const std::int64_t due_ns = flight_.epochs[i].t_us * 1000, before_ns = run.late_ns[i];
      sent_ns = std::max(sent_ns + 1, due_ns + before_ns + (run.uniform() < stalled ? 8'000'000 : 0));
      run.late_ns[i] = sent_ns - due_ns;
      later_ns[flight_.epochs[i].t_us] = run.late_ns[i] - before_ns;
    }
    for (auto& [t_ns, answer] : run.answers) {
      if (const auto found = later_ns.find(answer.cause_us); found != later_ns.end()) t_ns += found->second;
    }
    std::ranges::stable_sort(run.answers, {}, [](const auto& one) { return one.t_ns; });
    run.waits = static_cast<std::uint64_t>(run.one_of({590, 60, 20, 3}));
  }
  const std::vector<Outcome> each_{Outcome::pass, Outcome::fail, Outcome::not_measured};
};

TEST_F(SlowJudgeOfTimes, AgreesAboutLatencies) {
  const auto draw = [this](Drawn& run) {
    disturb(run);
    return Latency{.message = message,
                   .window = window(run),
                   .below_us = std::llround(run.one_of({1e3, 2e3, 2e4, 1e5})),
                   .quantile = run.one_of({0.5, 0.6, 0.7, 0.99, 1})};
  };
  expect_agreement(each_, draw, latency, 1000);
}

TEST_F(SlowJudgeOfTimes, AgreesAboutLatenciesThatGrow) {
  const auto draw = [](Drawn& run) {
    const scenario::Window all = window(run);
    const std::int64_t third_us = (std::min(all.to_us, passage_us) - all.from_us) / 3;
    return LatencyGrowth{.message = message,
                         .first = {.from_us = all.from_us, .to_us = all.from_us + third_us},
                         .last = {.from_us = all.to_us - 2 * third_us, .to_us = all.to_us},
                         .ratio_below = run.one_of({1.2, 2, 3})};
  };
  expect_agreement(each_, draw, latency_growth);
}

TEST_F(SlowJudgeOfTimes, AgreesAboutPeriods) {
  const auto draw = [this](Drawn& run) {
    disturb(run);
    return OutputPeriod{.message = message,
                        .window = window(run),
                        .within = run.one_of({0.1, 0.5, 1.5}),
                        .quantile = run.one_of({0.5, 0.8, 0.9, 0.95, 1})};
  };
  expect_agreement(each_, draw, output_period, 1000);
}

TEST_F(SlowJudgeOfTimes, AgreesAboutTheTargetsOwnTimes) {
  expect_agreement(
      each_, [](Drawn& /*run*/) { return OwnTimes{}; }, own_times);
}

TEST_F(SlowJudgeOfTimes, AgreesAboutHeartbeats) {
  const auto draw = [](Drawn& run) {
    return Heartbeat{.silent_at_most_us = std::llround(run.one_of({5e3, 1.5e5, 5e5, 1.5e6}))};
  };
  expect_agreement(each_, draw, heartbeat);
}

}  // namespace
}  // namespace canhil::checks
