#include "bench/live/flight.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "bench/checks/answered.hpp"
#include "bench/checks/judge.hpp"
#include "bench/checks/rule.hpp"
#include "bench/estimators/registry.hpp"
#include "bench/faults/rule.hpp"
#include "bench/report/summary.hpp"

namespace canhil::live {
namespace {

constexpr std::int64_t window_us = 10'000'000;
// The age at which values are final: by then all answers, even to a late fix, have arrived.
constexpr std::int64_t settled_us = 1'500'000;

double us(double ns) { return ns * 1e-3; }
double seconds(std::int64_t t_us) { return static_cast<double>(t_us) * 1e-6; }

// Whether the view shows a series. The view shows statistics and errors; if the truth is unknown, it shows
// estimates in place of errors.
bool is_shown(report::Series::Kind kind, bool known) {
  using enum report::Series::Kind;
  return kind == statistic || kind == (known ? error : estimate);
}

std::vector<CheckLine> open_checks(const scenario::Scenario& scenario) {
  std::vector<CheckLine> lines;
  for (const scenario::Check& check : scenario.checks) lines.push_back({.name = check.name});
  return lines;
}

std::vector<FaultLine> faults_of(const scenario::Scenario& scenario) {
  std::vector<FaultLine> lines;
  for (const scenario::Fault& fault : scenario.faults)
    lines.push_back({.name = fault.name,
                     .kind = fault.kind,
                     .stage = std::string(faults::name(fault.rule->stage())),
                     .from_s = seconds(fault.from_us),
                     .to_s = seconds(std::min(fault.to_us, scenario.duration_us)),
                     .begins_in_run = fault.begins_in_run});
  return lines;
}

std::vector<TimingLine> timing_of(const checks::TimingRecord& timing) {
  std::vector<TimingLine> lines;
  for (std::size_t i = 0; i < timing.messages.size(); ++i) {
    const checks::AnswerTiming& answers = timing.answers[i];
    if (answers.latency.count() == 0) continue;
    TimingLine line{.message = std::string(timing.messages[i].name),
                    .count = answers.latency.count(),
                    .p50_us = us(answers.latency.quantile_ns(0.5)),
                    .p99_us = us(answers.latency.quantile_ns(0.99)),
                    .max_us = us(static_cast<double>(answers.latency.max_ns())),
                    .jitter_count = answers.jitter.count(),
                    .jitter_p99_us = us(answers.jitter.quantile_ns(0.99)),
                    .jitter_max_us = us(static_cast<double>(answers.jitter.max_ns()))};
    if (checks::closes_answer(timing.messages, i)) {
      line.stretch_s = static_cast<double>(answers.latency_line.stretch_ns()) * 1e-9;
      for (const std::int64_t ns : answers.latency_line.largest_ns())
        line.slowest_us.push_back(ns < 0 ? std::numeric_limits<double>::quiet_NaN()
                                         : us(static_cast<double>(ns)));
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

void add_load(Flight& flight, std::span<const wire::BitLength> lengths, wire::BitRates known,
              BusFormat format) {
  const wire::BitRates rates = report::load_rates(known, format).front();
  flight.bit_rate = checks::to_text(rates) + (known.nominal > 0 ? "" : " assumed");
  const auto whole = checks::whole_seconds(lengths);
  flight.load = checks::bus_load(whole, rates);
  flight.load_line = checks::load_line(whole, rates);
  flight.load_now = whole.empty() ? 0 : wire::bus_load(whole.back(), 1.0, rates);
}

// The end of the window in which a check judges values. Nullopt if the check can only be judged after the
// run: because it compares no values with a limit, because its window is a range of the time to go, or
// because it judges timing.
std::optional<std::int64_t> over_at_us(const scenario::Check& check) {
  const auto bar = check.rule->bar();
  if (!bar || bar->stretch.to_go_s || !check.rule->timed().empty()) return std::nullopt;
  return bar->stretch.window.to_us;
}

}  // namespace

Flight flight_of(const scenario::Scenario& scenario, const drive::Options& options) {
  return {.title = scenario.title,
          .scenario = scenario.file,
          .bus = options.bus.text,
          .clock = options.lockstep         ? "lockstep"
                   : options.bus.in_process ? "virtual time"
                                            : "real time",
          .duration_s = seconds(scenario.duration_us),
          .checks = open_checks(scenario),
          .faults = faults_of(scenario)};
}

Flight flight_of(const scenario::Scenario& scenario, const drive::Run& run) {
  Flight flight = flight_of(scenario, run.options);
  flight.clock = report::clock_name(run);
  flight.t_s =
      seconds(run.ending.kind == drive::Ending::Kind::completed ? scenario.duration_us : run.ending.t_us);
  flight.outcome = run.verdict.outcome;
  flight.reason = run.verdict.reason;
  flight.checks.clear();
  for (const checks::CheckResult& check : run.verdict.checks)
    flight.checks.push_back({.name = check.name,
                             .outcome = check.outcome,
                             .measured = check.measured,
                             .expected = check.expected});
  for (report::Series& series : report::series(scenario, run)) {
    if (is_shown(series.kind, run.truth.is_known())) flight.series.push_back(std::move(series));
  }
  if (run.clock == drive::ClockKind::lockstep)
    flight.no_timing = "virtual time";
  else
    flight.timing = timing_of(run.seen.timing);
  add_load(flight, run.seen.length_by_second, run.seen.bit_rates, run.options.format);
  return flight;
}

FlightInProgress::FlightInProgress(const drive::Departure& departure)
    : departure_(departure),
      load_(departure.format, departure.load_by),
      judged_at_us_(departure.scenario.checks.size(), -1) {
  for (const world::PlantRecord* one : drive::growing_plants_of(departure_.per_run_truth))
    plants_.emplace_back(one->columns());
  if (!departure_.watcher) return;
  whole_ = departure_.watcher(true);
  recent_ = departure_.watcher(true);
  next_recent_ = departure_.watcher(true);
}

void FlightInProgress::each_watcher(const std::function<void(observe::Observer&)>& show) {
  show(load_);
  for (observe::Watcher* watcher : {whole_.get(), recent_.get(), next_recent_.get()}) {
    if (watcher != nullptr) show(*watcher);
  }
}

void FlightInProgress::transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) {
  if (!first_ns_) first_ns_ = t_ns;
  last_ns_ = t_ns;
  each_watcher([&](observe::Observer& to) { to.transmitted(frame, t_ns, late_ns); });
  if (now_us() - window_since_us_ > window_us) move_window();
}
void FlightInProgress::received(const Received& received) {
  each_watcher([&](observe::Observer& to) { to.received(received); });
}
void FlightInProgress::foreign(const Received& received) {
  each_watcher([&](observe::Observer& to) { to.foreign(received); });
}
void FlightInProgress::time_set(std::int64_t t_ns) {
  virtual_ns_ = t_ns;
  each_watcher([&](observe::Observer& to) { to.time_set(t_ns); });
}
void FlightInProgress::interface_changed(bool up, std::int64_t t_ns) {
  each_watcher([&](observe::Observer& to) { to.interface_changed(up, t_ns); });
}

// Replaces the older watcher by the newer one and starts another one. The newer watcher has also received all
// frames since the last update, so the tracks lose no value.
void FlightInProgress::move_window() {
  window_since_us_ = now_us();
  if (!recent_) return;
  recent_ = std::exchange(next_recent_, departure_.watcher(true));
}

std::int64_t FlightInProgress::now_us() const {
  return (virtual_ns_ ? *virtual_ns_ : last_ns_ - first_ns_.value_or(last_ns_)) / 1000;
}

estimators::Truth FlightInProgress::truth() const {
  const scenario::Scenario& scenario = departure_.scenario;
  estimators::Truth truth = drive::truth_of(departure_.truth, departure_.per_run_truth, scenario.duration_us);
  const world::PlantRecords growing = drive::growing_plants_of(departure_.per_run_truth);
  for (std::size_t i = 0; i < growing.size(); ++i)
    std::ranges::replace(truth.plants, growing[i], static_cast<const world::PlantRecord*>(&plants_[i]));
  return truth;
}

void FlightInProgress::update(Flight& flight, bool all_seen, bool landed) {
  const scenario::Scenario& scenario = departure_.scenario;
  flight.t_s = seconds(std::clamp<std::int64_t>(now_us(), 0, scenario.duration_us));
  flight.no_timing = virtual_ns_ ? "virtual time" : "";
  add_load(flight, load_.lengths(), departure_.wire.rates, departure_.format);
  if (!whole_) {
    flight.no_tracks = "the scenario has a mapping: quantities and times are shown at the end of the run";
    return;
  }
  if (flight.no_timing.empty()) flight.timing = timing_of(whole_->observations().timing);
  take_tracks(flight, landed ? std::numeric_limits<std::int64_t>::max() : now_us() - settled_us);
  if (all_seen) judge_ended(flight);
}

void FlightInProgress::take_tracks(Flight& flight, std::int64_t until_us) {
  for (const estimators::Estimator* one : estimators::in(departure_.scenario)) {
    if (!departure_.scenario.runs(one->name)) continue;
    estimators::give_tracks(*one, recent_->observations(), truth(), [&](const quantities::Track& track) {
      take(one->name, track, false, until_us);
      if (!track.estimate_title.empty()) take(one->name, track, true, until_us);
    });
  }
  flight.series.clear();
  for (const Known& one : known_) {
    if (one.shown && !one.series.series().points.empty()) flight.series.push_back(one.series.series());
  }
}

void FlightInProgress::take(std::string_view estimator, const quantities::Track& track, bool estimates,
                            std::int64_t until_us) {
  auto known = std::ranges::find_if(known_, [&](const Known& one) {
    return one.estimator == estimator && one.quantity == track.quantity && one.estimates == estimates;
  });
  if (known == known_.end()) {
    known_.push_back({.estimator = estimator,
                      .quantity = track.quantity,
                      .estimates = estimates,
                      .series = report::GrowingSeries(estimator, track, estimates, departure_.scenario)});
    known = std::prev(known_.end());
  }
  const report::Series& series = known->series.series();
  if (!is_shown(series.kind, departure_.truth.is_known())) return;
  known->series.take(track, until_us);
  known->shown = estimates || !track.only_if_judged || !series.bars.empty();
}

// Judges all checks whose last value has arrived, in one pass over the whole flight. The number of passes
// never exceeds the number of checks, however long the flight is.
void FlightInProgress::judge_ended(Flight& flight) {
  const scenario::Scenario& scenario = departure_.scenario;
  std::vector<std::size_t> due;
  for (std::size_t i = 0; i < scenario.checks.size(); ++i) {
    const auto over_us = over_at_us(scenario.checks[i]);
    if (judged_at_us_[i] < 0 && over_us && now_us() > *over_us + settled_us) due.push_back(i);
  }
  if (due.empty()) return;
  const checks::Verdict verdict = checks::judge(
      scenario, {.seen = whole_->observations(), .truth = truth(), .estimators = estimators::in(scenario)});
  for (const std::size_t i : due) {
    judged_at_us_[i] = now_us();
    const checks::CheckResult& result = verdict.checks[i];
    flight.checks[i] = {.name = result.name,
                        .outcome = result.outcome,
                        .measured = result.measured,
                        .expected = result.expected};
  }
}

}  // namespace canhil::live
