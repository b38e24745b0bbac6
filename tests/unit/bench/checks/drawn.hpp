// Random runs of a fly-past: what the target sends, and what the host and the bus do to the bench.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "bench/checks/judge.hpp"
#include "bench/estimators/los_rate/answers.hpp"
#include "bench/observe/stopwatch.hpp"
#include "tests/unit/bench/checks/fly_past.hpp"

namespace canhil::checks {

/// Something that the target sent, and its arrival.
template <class What>
struct Came {
  std::int64_t t_ns = 0;
  What what;
};

/// One run. Answers are lost, late, given twice, out of order, not a number, and silent for a while or from a
/// time on; so are heartbeats and counters. A test may change the run before it is judged.
class Drawn {
 public:
  Drawn(unsigned seed, const Flown& flight, std::int64_t duration_us) : random_(seed) {
    draw_host(flight);
    draw_answers(flight);
    draw_reports(duration_us);
  }
  double uniform() { return std::uniform_real_distribution<double>()(random_); }
  double normal() { return std::normal_distribution<double>()(random_); }
  double one_of(const std::vector<double>& values) {
    return values[std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(random_)];
  }

  /// The bench transmits each sample late by this time [ns], in the order of the flight.
  std::vector<std::int64_t> late_ns;
  std::vector<Came<estimators::LosAnswer>> answers;  ///< in order of arrival
  std::vector<Came<messages::TargetHeartbeat>> heartbeats;
  std::vector<Came<messages::TargetCounters>> counters;
  std::vector<Came<messages::TargetTiming>> timings;
  ExpectedCounts expected_counts;
  std::uint32_t frames_lost = 0;  ///< frames of the target that were lost on the way
  std::uint64_t outages = 0;      ///< times that the bus was away
  std::int64_t waited_ns = 0;     ///< other programs held the target's CPU for this time
  std::uint64_t waits = 600;      ///< in so many of 600 looks
  std::string timing_unfit;
  std::optional<FaultRecord> fault;

 private:
  struct Silence {
    double from_us = 0, to_us = 0;
    [[nodiscard]] bool covers(std::int64_t t_us) const {
      return static_cast<double>(t_us) >= from_us && static_cast<double>(t_us) < to_us;
    }
  };
  Silence silence() {
    const double from_us = one_of({1e9, 1e9, uniform() * 5e6});
    return {.from_us = from_us, .to_us = from_us + one_of({1e9, 2e5, 1.2e6})};
  }
  void draw_host(const Flown& flight) {
    const double late_us = one_of({50, 50, 500, 3000}), growth = one_of({0, 0, 0.3, 2});
    std::int64_t sent_ns = 0;  // in order: no frame before the one before it
    for (const Flown::Sample& epoch : flight.epochs) {
      const double grown = 1 + growth * static_cast<double>(epoch.t_us) * 1e-6;
      const std::int64_t due_ns = epoch.t_us * 1000;
      sent_ns = std::max<std::int64_t>(sent_ns + 1, due_ns + std::llround(uniform() * late_us * grown * 1e3));
      late_ns.push_back(sent_ns - due_ns);
    }
    waited_ns = std::llround(one_of({0, 0, 0, 3e6}));
    if (uniform() < 0.1) timing_unfit = "virtual time";
    frames_lost = static_cast<std::uint32_t>(one_of({0, 0, 10, 1000}));
    outages = uniform() < 0.2 ? 1 : 0;
  }
  void draw_answers(const Flown& flight) {
    constexpr double mrad = 1e-3;
    const double lost = one_of({0, 0, 0, 0.02, 0.3, 0.6}), late = one_of({0, 0.01, 0.5}),
                 twice = one_of({0, 0, 0.05, 0.5}), wrong = one_of({0, 0, 0, 0.001}),
                 blind = one_of({0, 0.2}), coasting = one_of({0, 0.1, 0.002}), scale = one_of({0.3, 1, 3}),
                 growth = one_of({0, 0, 0.3});
    const double most_late_us = one_of({15e3, 100e3, 2e6});
    const Silence silent = silence();
    const double degraded_from_us = one_of({1e9, 1e9, -1, uniform() * 5e6});
    const Silence degraded{.from_us = degraded_from_us, .to_us = degraded_from_us + one_of({1e9, 2e5, 1e6})};
    const auto error = [&] { return (uniform() < 0.005 ? 10 : 1) * scale * mrad * normal(); };
    auto late_by_ns = late_ns.begin();
    for (const Flown::Sample& epoch : flight.epochs) {
      const std::int64_t sent_ns = epoch.t_us * 1000 + *late_by_ns++;
      if (uniform() < lost || silent.covers(epoch.t_us)) continue;
      const auto t_us = static_cast<double>(epoch.t_us);
      const auto sigma = [&] { return (1 + uniform() + t_us * 2e-7) * mrad; };
      for (int times = uniform() < twice ? 2 : 1; times > 0; --times) {
        estimators::LosAnswer answer;
        answer.cause_us = epoch.t_us;
        answer.outcome =
            uniform() < coasting ? messages::LosRateOutcome::coasting : messages::LosRateOutcome::updated;
        if (epoch.t_us <= 2 * flight.epochs[0].t_us) answer.outcome = messages::LosRateOutcome::waiting;
        answer.blind = uniform() < blind;
        answer.degraded = degraded.covers(epoch.t_us);
        answer.rate = {.pitch = epoch.los_rate.pitch + error(), .yaw = epoch.los_rate.yaw + error()};
        answer.rate_sigma = {.pitch = sigma(), .yaw = sigma()};
        answer.nis = -2 * std::log(1 - uniform());
        for (double* value : {&answer.rate.pitch, &answer.rate.yaw, &answer.rate_sigma.pitch, &answer.nis}) {
          if (uniform() < wrong) *value = uniform() < 0.5 ? NAN : HUGE_VAL;
        }
        const double soon_us = (300 + 400 * uniform()) * (1 + growth * t_us * 1e-6);
        const double took_us = uniform() < late ? uniform() * most_late_us : soon_us;
        answers.push_back({.t_ns = sent_ns + std::llround(took_us * 1e3), .what = answer});
      }
    }
    std::ranges::stable_sort(answers, {}, &Came<estimators::LosAnswer>::t_ns);
  }
  void draw_reports(std::int64_t duration_us) {
    const double lost = one_of({0, 0, 0.1, 0.6}), counting = one_of({0, 0, 0.02}),
                 restart = one_of({0, 0, 0.02}), queue_us = one_of({0, 100, 400}),
                 input_lost_us = one_of({1e9, 1e9, uniform() * 6e6});
    const double degraded_from_us = one_of({1e9, 1e9, uniform() * 6e6});
    const Silence degraded{.from_us = degraded_from_us, .to_us = degraded_from_us + one_of({1e9, 4e5})};
    const Silence silent = silence();
    messages::TargetCounters counts{.frames_lost = static_cast<std::uint16_t>(one_of({0, 0, 3, 8191}))};
    for (std::int64_t due_us = 0; due_us < duration_us;
         due_us += messages::TargetHeartbeat::info.cycle_time_us) {
      const std::int64_t t_us = due_us + std::llround(uniform() * 3e3);
      for (std::uint16_t* count : {&counts.frames_lost, &counts.bad_crc, &counts.bad_group, &counts.late}) {
        if (uniform() < counting && *count < 8191) ++*count;
      }
      if (uniform() < restart) counts = {};
      if (silent.covers(t_us) || uniform() < lost) continue;
      const auto is_so = [](bool it) { return static_cast<std::uint8_t>(it ? 1 : 0); };
      heartbeats.push_back({.t_ns = t_us * 1000,
                            .what = {.state = messages::TargetState::running,
                                     .error_input_lost = is_so(static_cast<double>(t_us) >= input_lost_us),
                                     .degraded = is_so(degraded.covers(t_us))}});
      counters.push_back({.t_ns = t_us * 1000, .what = counts});
      timings.push_back({.t_ns = t_us * 1000,
                         .what = {.queue_mean_us = static_cast<std::uint16_t>(uniform() * queue_us),
                                  .compute_mean_us = static_cast<std::uint16_t>(uniform() * queue_us)}});
    }
    if (uniform() < 0.05) counters.clear();
    expected_counts.least.frames_lost = static_cast<std::uint64_t>(one_of({0, 3, 8191, 9000}));
    expected_counts.most = expected_counts.least;
    expected_counts.most.bad_group = static_cast<std::uint64_t>(one_of({0, 1, 2}));
  }

  std::mt19937 random_;
};

/// What the bench observes of a run, with the times that the checks need.
inline Observations observed(const Drawn& run, const Flown& flight, std::int64_t duration_us,
                             const std::vector<scenario::Check>& checks) {
  Observations seen;
  seen.timing.windows = timed_windows(checks);
  observe::Stopwatch stopwatch(seen.timing);
  constexpr std::size_t answer = message_index<messages::LosRateTarget>();
  constexpr std::size_t heartbeat = message_index<messages::TargetHeartbeat>();
  std::multimap<std::int64_t, std::function<void()>> events;  // by time [ns]
  events.emplace(0, [&] { stopwatch.sent({}, 0, 0); });
  for (std::size_t i = 0; i < flight.epochs.size(); ++i) {
    const std::int64_t valid_us = flight.epochs[i].t_us, t_ns = valid_us * 1000 + run.late_ns[i];
    events.emplace(t_ns, [&, valid_us, t_ns] {
      stopwatch.sent({}, t_ns, t_ns - valid_us * 1000);
      stopwatch.stimulus("Seeker", {.valid_us = valid_us, .t_ns = t_ns, .due_ns = valid_us * 1000});
      seen.stimuli["Seeker"].add(valid_us);
    });
  }
  for (const Came<estimators::LosAnswer>& one : run.answers) {
    events.emplace(one.t_ns, [&] {
      seen.of<estimators::LosAnswers>().push_back(one.what);
      stopwatch.arrived(answer, {.frame = {}, .t_ns = one.t_ns});
      stopwatch.answered({&answer, 1}, "Seeker", one.what.cause_us);
    });
  }
  for (const Came<messages::TargetHeartbeat>& one : run.heartbeats) {
    events.emplace(one.t_ns, [&] {
      stopwatch.arrived(heartbeat, {.frame = {}, .t_ns = one.t_ns});
      seen.complaints.hear(one.what, one.t_ns / 1000);
      seen.reports.hear(one.what, one.t_ns / 1000);
    });
  }
  for (const Came<messages::TargetCounters>& one : run.counters) {
    events.emplace(one.t_ns, [&] {
      seen.counters = one.what;
      seen.complaints.hear(one.what, one.t_ns / 1000);
      seen.reports.hear(one.what, one.t_ns / 1000);
    });
  }
  for (const Came<messages::TargetTiming>& one : run.timings) {
    events.emplace(one.t_ns, [&] {
      seen.target_timing_seen = true;
      stopwatch.on_target_timing(one.what);
    });
  }
  for (const auto& [t_ns, event] : events) event();
  stopwatch.finish();
  seen.complaints.end(duration_us);
  seen.reports.end(duration_us);
  seen.last_ns = duration_us * 1000;
  seen.expected_counts = run.expected_counts;
  seen.from_target.front().lost = run.frames_lost;
  seen.bus.downs = run.outages;
  if (run.fault) seen.faults.push_back(*run.fault);
  return seen;
}

}  // namespace canhil::checks
