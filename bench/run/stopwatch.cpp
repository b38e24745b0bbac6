#include "bench/run/stopwatch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "bench/checks/timing.hpp"
#include "dbc/wire/e2e.hpp"
#include "dbc/wire/routes.hpp"

namespace canhil::run {
namespace {

constexpr Routes bench_messages([](const MessageInfo& info) {
  return info.sender != messages::TargetHeartbeat::info.sender;
});

std::int64_t nanoseconds(double t_s) { return std::llround(t_s * 1e9); }

}  // namespace

void Stopwatch::sent(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) {
  if (!first_ns_) first_ns_ = t_ns;
  record_.lateness.add(late_ns);
  record_.lateness_line.add(t_ns - *first_ns_, late_ns);
  const std::size_t index = bench_messages(frame);
  if (index == Routes::nowhere) return;
  record_.transmit[index].handed_over.add(late_ns);
  pending_[index][e2e::counter(frame.payload())] = {frame, t_ns, late_ns, true};
}

// Lateness is of CLOCK_MONOTONIC, stamps may be of another clock: only differences of stamps are taken.
void Stopwatch::echoed(const Received& received) {
  const std::size_t index = bench_messages(received.frame);
  if (index == Routes::nowhere) return;
  Pending& pending = pending_[index][e2e::counter(received.frame.payload())];
  if (!pending.waiting || !std::ranges::equal(pending.frame.payload(), received.frame.payload())) return;
  pending.waiting = false;
  record_.transmit[index].echoed.add(pending.late_ns + received.t_ns - pending.t_ns);
}

void Stopwatch::arrived(std::size_t index, const Received& received) {
  ++record_.stamps[static_cast<std::size_t>(received.source)];
  const MessageInfo& info = messages::all_messages[index];
  if (!info.answers.empty() || info.cycle_time_us == 0) return;
  const checks::Arrival arrival{.t_ns = received.t_ns, .hardware_ns = received.hardware_ns};
  if (last_[index]) {
    const std::int64_t period_ns = nanoseconds(elapsed_s(last_[index]->arrival, arrival));
    record_.answers[index].jitter.add(std::abs(period_ns - std::int64_t{info.cycle_time_us} * 1000));
  }
  last_[index] = {.arrival = arrival, .due_ns = 0};
}

void Stopwatch::answered(std::size_t index, const checks::Arrival& arrival,
                         const checks::Stimulus* stimulus) {
  checks::AnswerTiming& timing = record_.answers[index];
  if (stimulus == nullptr) {
    ++timing.unpaired;
    return;
  }
  const std::int64_t latency_ns = nanoseconds(elapsed_s(*stimulus, arrival));
  timing.latency.add(latency_ns);
  timing.latency_line.add(arrival.t_ns - first_ns_.value_or(arrival.t_ns), latency_ns);
  if (last_[index]) {
    const std::int64_t period_ns = nanoseconds(elapsed_s(last_[index]->arrival, arrival));
    timing.jitter.add(std::abs(period_ns - (stimulus->due_ns - last_[index]->due_ns)));
  }
  last_[index] = {.arrival = arrival, .due_ns = stimulus->due_ns};
}

}  // namespace canhil::run
