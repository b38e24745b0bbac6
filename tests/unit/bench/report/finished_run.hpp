// A finished run for the tests of pages and JSON.
#pragma once

#include "bench/bindings/canhil.hpp"
#include "bench/estimators/transfer_alignment/answers.hpp"
#include "bench/report/run_reports.hpp"
#include "bench/world/motion/rest.hpp"
#include "dbc/realtime/process.hpp"

namespace canhil::report {

inline scenario::Scenario scenario_of() {
  scenario::Scenario scenario;
  scenario.binding = bindings::canhil();
  scenario.title = "<script>alert(1)</script>";
  scenario.duration_us = 2'000'000;
  scenario.targets.emplace_back().estimator = "transfer_alignment";
  return scenario;
}

inline drive::Run run_of() {
  drive::Run run{
      .verdict = {.outcome = checks::Outcome::fail,
                  .reason = "1 of 2 checks failed",
                  .checks = {{"latency", "latency", "REQ-7", checks::Outcome::fail, "9 ms", "< 5 ms"},
                             {"two", "kind", "", checks::Outcome::not_measured, "late & slow", "x"}}},
      .ending = {},
      .seen = {},
      .truth = {{.start = {}, .motion = world::Rest{}}, 2'000'000, 10'000},
      .options = {},
      .host = realtime::standing(),
      .wall_s = 2};
  run.options.bus.text = "local:x";
  checks::Observations& seen = run.seen;
  for (std::int64_t t_us = 10'000; t_us <= 2'000'000; t_us += 10'000) {
    seen.of<estimators::TransferAnswers>().navigation.push_back(
        {.cause_us = t_us, .angles = {.roll = 0.001, .pitch = 0, .heading = 0}});
    auto& timing = seen.timing.answers[message_index<messages::AlignVelocityD>()];
    timing.latency.add(200'000 + t_us / 10);
    timing.latency_line.add(t_us * 1000, 200'000);
    timing.jitter.add(5'000);
    seen.timing.lateness.add(30'000);
    seen.timing.lateness_line.add(t_us * 1000, 30'000);
    seen.timing.transmit[message_index<messages::Sync>()].handed_over.add(30'000);
    if (t_us % 100'000 == 0)
      seen.of<estimators::TransferAnswers>().filter.push_back(
          {.cause_us = t_us, .nis = 3, .attitude_sigma = world::Vector3::Constant(0.002)});
  }
  seen.length_by_second.resize(2);
  return run;
}

// A run at 500 kbit/s with 100 stimuli. On average, the echo of a stimulus comes after 0.3 ms; 0.2 ms of this
// time is the duration of its frame. The answer comes 1 ms after the echo.
inline drive::Run run_on_a_wire() {
  drive::Run run = run_of();
  run.seen.bit_rates = {.nominal = 500'000};
  run.seen.transmit_stamps_echoed = true;
  run.seen.last_ns = 2'000'000'000;
  checks::TimingRecord& timing = run.seen.timing;
  timing.wire.rates = run.seen.bit_rates;
  timing.breakdown = {.stimuli = 100,
                      .echoed = 100,
                      .to_echo_ns = 30'000'000,
                      .stimulus_wire_ns = 20'000'000,
                      .latency_ns = 100'000'000,
                      .reply_wire_ns = 60'000'000,
                      .accounted = 50,
                      .target_queue_ns = 5'000'000,
                      .target_compute_ns = 10'000'000};
  timing.slowest = {.message = "AlignVelocityD", .t_ns = 1'500'000'000, .latency_ns = 9'000'000};
  timing.slowest.queue_max_us = 8191;
  timing.responses[message_index<messages::Sync>()] = {.count = 200, .max_ns = 250'000};
  timing.responses[message_index<messages::AlignVelocityD>()] = {.count = 100, .max_ns = 9'000'000};
  timing.answers[message_index<messages::AlignVelocityD>()].last_ns = 1;
  return run;
}

}  // namespace canhil::report
