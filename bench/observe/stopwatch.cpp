#include "bench/observe/stopwatch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "bench/checks/answered.hpp"
#include "bench/checks/finding.hpp"

namespace canhil::observe {
namespace {

using checks::Stimulus;
using checks::TimedWindow;

// Adds the time between two stimuli minus the time between their deadlines.
void add_deviation(TimedWindow& window, const Stimulus& from, const Stimulus& to) {
  const std::int64_t period_ns = elapsed_ns(from, to);
  const std::int64_t due_ns = to.due_ns - from.due_ns;
  const double times =
      due_ns > 0 ? std::round(static_cast<double>(period_ns) / static_cast<double>(due_ns)) : 1.0;
  window.stimulus_deviation.add(std::abs(period_ns - due_ns),
                                static_cast<std::uint64_t>(std::max(1.0, times)));
}

void add_arrival(TimedWindow& window, const checks::Arrival& arrival) {
  if (window.last_arrival) window.period.add(elapsed_ns(*window.last_arrival, arrival));
  if (!window.first_arrival) window.first_arrival = arrival;
  window.last_arrival = arrival;
}

void add(checks::WireResponse& response, std::int64_t ns) {
  ++response.count;
  response.max_ns = std::max(response.max_ns, ns);
}

}  // namespace

/// The index of a message that the bench sends; nowhere: the bench does not send this frame.
std::size_t Stopwatch::of_bench(const Frame& frame) const {
  const std::size_t index = places_(frame);
  const bool targets = index != MessagePlaces::nowhere && is_targets(record_.messages[index]);
  return targets ? MessagePlaces::nowhere : index;
}

bool Stopwatch::answers(std::size_t index, std::string_view group) const {
  const auto groups = record_.messages[index].answers;
  return std::ranges::find(groups, group) != groups.end();
}

/// The frame on the wire that ends with this message; none: the frame on the wire is a container that also
/// contains later messages.
std::optional<Frame> Stopwatch::closed_by(const Frame& message, FdPacker& packer) const {
  if (!record_.wire.fd || message.fd) return message;
  if (packer.due_before(message)) packer.clear();  // the container was sent without its last message
  return packer.put(message);
}

std::int64_t Stopwatch::on_wire_ns(const Frame& frame) const {
  const wire::BitRates& rates = record_.wire.rates;
  return rates.nominal == 0 ? 0 : wire::duration_ns(wire::bit_length(frame), rates);
}

/// The time to subtract from a frame's time on the wire, so that the difference is comparable with the time
/// from hand-over to echo. For a container this is the intermission, because the echo is stamped before the
/// intermission. For the last frame of a classic group nothing is subtracted, because the time from hand-over
/// to echo already contains one intermission: that of the previous frame.
std::int64_t Stopwatch::no_intermission_ns() const {
  return record_.wire.fd ? wire::duration_ns({.nominal = wire::intermission_bits}, record_.wire.rates) : 0;
}

void Stopwatch::sent(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) {
  if (!first_ns_) first_ns_ = t_ns;
  record_.lateness.add(late_ns);
  record_.lateness_line.add(t_ns - *first_ns_, late_ns);
  const std::size_t index = of_bench(frame);
  if (index == MessagePlaces::nowhere) return;
  record_.transmit[index].handed_over.add(late_ns);
  std::vector<Pending>& pending = pending_[index];
  if (pending.size() == on_their_way) pending.erase(pending.begin());
  pending.push_back({.frame = frame, .t_ns = t_ns, .late_ns = late_ns});
}

void Stopwatch::stimulus(std::string_view name, const Stimulus& stimulus) {
  const auto [place, is_new] = groups_.try_emplace(name);
  Group& group = place->second;
  for (std::size_t index = 0; is_new && index < record_.messages.size(); ++index) {
    if (answers(index, name) && checks::closes_answer(record_.messages, index))
      group.answered_by.push_back(index);
  }
  group.sent.push_back({.stimulus = stimulus});
  if (group.sent.size() > remembered) forget_oldest(name, group);
}

// The clock of the lateness is CLOCK_MONOTONIC; the clock of the stamps may be another one. Therefore only
// differences of stamps are used.
void Stopwatch::echoed(const Received& received, std::string_view group, std::int64_t valid_us) {
  const std::size_t index = of_bench(received.frame);
  if (index == MessagePlaces::nowhere) return;
  std::vector<Pending>& waiting = pending_[index];
  const auto pending = std::ranges::find_if(waiting, [&](const Pending& one) {
    return std::ranges::equal(one.frame.payload(), received.frame.payload());
  });
  const std::optional<Frame> on_wire = closed_by(received.frame, echoes_);
  std::optional<std::int64_t> on_bus_ns;  // from hand-over to echo
  if (pending != waiting.end()) {
    on_bus_ns = received.t_ns - pending->t_ns;
    record_.transmit[index].echoed.add(pending->late_ns + *on_bus_ns);
    if (on_wire) add(record_.responses[carriers_[index].first], *on_bus_ns);
    waiting.erase(pending);
  }
  Sent* sent = group.empty() ? nullptr : find(group, valid_us);
  if (sent == nullptr) return;
  if (on_bus_ns) sent->to_echo_ns = on_bus_ns;
  if (on_wire) sent->wire_ns = on_wire_ns(*on_wire) - no_intermission_ns();
  sent->stimulus.t_ns = received.t_ns;
  sent->stimulus.hardware_ns = received.hardware_ns;
}

void Stopwatch::arrived(std::size_t index, const Received& received) {
  ++record_.stamps[static_cast<std::size_t>(received.source)];
  if (received.hardware_ns == 0) ++record_.without_hardware_stamp;
  const checks::Arrival arrival{.t_ns = received.t_ns, .hardware_ns = received.hardware_ns};
  newest_[index] = arrival;
  if (const auto on_wire = closed_by(received.frame, arrivals_))
    wire_ns_[carriers_[index].first] = on_wire_ns(*on_wire);
  checks::AnswerTiming& timing = record_.answers[index];
  const std::int64_t heard_ns = timing.last_ns.value_or(first_ns_.value_or(arrival.t_ns));
  timing.longest_silence_ns = std::max(timing.longest_silence_ns, arrival.t_ns - heard_ns);
  timing.last_ns = arrival.t_ns;
  ++timing.count;

  const MessageInfo& info = record_.messages[index];
  if (!info.answers.empty()) return;
  for (TimedWindow& window : record_.windows) {
    if (window.message == index) add_arrival(window, arrival);
  }
  if (info.cycle_time_us == 0) return;
  if (last_[index]) {
    const std::int64_t period_ns = elapsed_ns(last_[index]->arrival, arrival);
    timing.jitter.add(std::abs(period_ns - std::int64_t{info.cycle_time_us} * 1000));
  }
  last_[index] = {.arrival = arrival, .due_ns = 0};
}

void Stopwatch::without_cause(std::span<const std::size_t> indices, std::string_view group,
                              std::int64_t cause_us) {
  std::optional<std::int64_t> nearest_us;
  if (const auto found = groups_.find(group); found != groups_.end()) {
    for (const Sent& sent : found->second.sent) {
      const std::int64_t off_us = std::abs(sent.stimulus.valid_us - cause_us);
      nearest_us = std::min(nearest_us.value_or(off_us), off_us);
    }
  }
  for (const std::size_t index : indices) {
    checks::AnswerTiming& timing = record_.answers[index];
    ++timing.unpaired;
    if (nearest_us) timing.nearest_us = std::min(timing.nearest_us.value_or(*nearest_us), *nearest_us);
  }
}

void Stopwatch::answered(std::span<const std::size_t> indices, std::string_view group, std::int64_t cause_us,
                         std::optional<std::uint8_t> counter) {
  Sent* sent = find(group, cause_us, counter);
  if (sent == nullptr) return without_cause(indices, group, cause_us);
  if (counter && *counter != sent->stimulus.counter) {
    for (const std::size_t index : indices) {
      checks::AnswerTiming& timing = record_.answers[index];
      if (timing.wrong_counter++ > 0) continue;
      timing.counter_reported = *counter;
      timing.counter_sent = sent->stimulus.counter;
    }
  }
  const bool again = sent->answered_by.test(indices.back());
  sent->answered_by.set(indices.back());
  const std::size_t first = indices.front();
  const std::int64_t began_ns = newest_[first].t_ns - wire_ns_[carriers_[first].first];
  std::size_t before = carriers_.size();
  for (const std::size_t index : indices) {
    // The messages of a container arrive together; the first message represents the container.
    const std::size_t carrier = carriers_[index].first;
    const bool another = std::exchange(before, carrier) != carrier;
    if (again) ++record_.answers[index].repeated;
    answered(index, group, *sent, another ? wire_ns_[carrier] : 0, cause_us);
    if (another) add(record_.responses[carrier], newest_[index].t_ns - began_ns);
  }
}

void Stopwatch::answered(std::size_t index, std::string_view group, Sent& sent, std::int64_t wire_ns,
                         std::int64_t cause_us) {
  checks::AnswerTiming& timing = record_.answers[index];
  const checks::Arrival& arrival = newest_[index];
  const std::int64_t latency_ns = elapsed_ns(sent.stimulus, arrival);
  timing.latency.add(latency_ns);
  timing.latency_line.add(arrival.t_ns - first_ns_.value_or(arrival.t_ns), latency_ns);
  if (last_[index]) {
    const std::int64_t period_ns = elapsed_ns(last_[index]->arrival, arrival);
    timing.jitter.add(std::abs(period_ns - (sent.stimulus.due_ns - last_[index]->due_ns)));
  }
  last_[index] = {.arrival = arrival, .due_ns = sent.stimulus.due_ns};
  for (TimedWindow& window : record_.windows) {
    if (window.message != index || !checks::within(window.window, cause_us)) continue;
    sent.latest[index] = latency_ns;
    add_arrival(window, arrival);
  }
  split(index, group, sent, wire_ns, latency_ns);
}

checks::LatencyBreakdown& Stopwatch::split_of(std::string_view group) {
  auto& all = record_.breakdown_by_group;
  const auto found = std::ranges::find(all, group, &checks::GroupBreakdown::group);
  return found != all.end()
             ? found->breakdown
             : all.emplace_back(checks::GroupBreakdown{.group = group, .breakdown = {}}).breakdown;
}

// A stimulus may have several answers. The stimulus is counted once, with the latency of the last answer.
void Stopwatch::split(std::size_t index, std::string_view group, Sent& sent, std::int64_t wire_ns,
                      std::int64_t latency_ns) {
  sent.reply_wire_ns += wire_ns;
  record_.answers[index].reply_wire_ns += sent.reply_wire_ns;
  for (checks::LatencyBreakdown* breakdown : {&record_.breakdown, &split_of(group)}) {
    breakdown->reply_wire_ns += wire_ns;
    breakdown->latency_ns += latency_ns - sent.latency_ns;
    if (sent.answered) continue;
    ++breakdown->stimuli;
    if (!sent.to_echo_ns) continue;
    ++breakdown->echoed;
    breakdown->to_echo_ns += *sent.to_echo_ns;
    breakdown->stimulus_wire_ns += sent.wire_ns;
  }
  sent.latency_ns = latency_ns;
  if (!sent.answered) ++pending_window_.stimuli;
  sent.answered = true;
  if (latency_ns <= pending_window_.slowest.latency_ns) return;
  pending_window_.slowest = {.message = record_.messages[index].name,
                             .t_ns = newest_[index].t_ns - first_ns_.value_or(0),
                             .latency_ns = latency_ns,
                             .reply_wire_ns = sent.reply_wire_ns};
}

void Stopwatch::on_target_timing(const messages::TargetTiming& timing) {
  const auto stimuli = static_cast<std::int64_t>(pending_window_.stimuli);
  record_.breakdown.accounted += pending_window_.stimuli;
  if (stimuli > 0) {
    record_.breakdown.queue_clipped |= timing.queue_mean_us >= checks::most_reported_us;
    record_.breakdown.compute_clipped |= timing.compute_mean_us >= checks::most_reported_us;
  }
  record_.breakdown.target_queue_ns += stimuli * timing.queue_mean_us * 1000;
  record_.breakdown.target_compute_ns += stimuli * timing.compute_mean_us * 1000;
  if (pending_window_.slowest.latency_ns > record_.slowest.latency_ns) {
    record_.slowest = pending_window_.slowest;
    record_.slowest.queue_max_us = timing.queue_max_us;
    record_.slowest.compute_max_us = timing.compute_max_us;
  }
  pending_window_ = {};
}

void Stopwatch::finish() {
  for (auto& [name, group] : groups_) {
    while (!group.sent.empty()) forget_oldest(name, group);
  }
}

// Searches from the newest stimulus backwards, because an answer comes soon or never. If several stimuli are
// valid at the same time, takes the one whose counter is equal to `counter` or, if there is none, the newest
// of them.
Stopwatch::Sent* Stopwatch::find(std::string_view name, std::int64_t valid_us,
                                 std::optional<std::uint8_t> counter) {
  const auto group = groups_.find(name);
  if (group == groups_.end()) return nullptr;
  std::deque<Sent>& sent = group->second.sent;
  const auto found = std::find_if(sent.rbegin(), sent.rend(),
                                  [&](const Sent& s) { return s.stimulus.valid_us == valid_us; });
  if (found == sent.rend()) return nullptr;
  if (!counter || found->stimulus.counter == *counter) return &*found;
  const auto same = std::find_if(found, sent.rend(), [&](const Sent& s) {
    return s.stimulus.valid_us == valid_us && s.stimulus.counter == *counter;
  });
  return same == sent.rend() ? &*found : &*same;
}

// Called so late that the echo of the oldest stimulus has either arrived or will never arrive.
void Stopwatch::forget_oldest(std::string_view name, Group& group) {
  const Stimulus stimulus = group.sent.front().stimulus;
  const auto latest = std::move(group.sent.front().latest);
  if (stimulus.owed_answer) {
    for (const std::size_t index : group.answered_by)
      record_.owed[index].push_back(
          {.valid_us = stimulus.valid_us, .came = group.sent.front().answered_by.test(index)});
  }
  group.sent.pop_front();
  ++(stimulus.hardware_ns != 0 ? record_.stimuli_with_hardware_stamp : record_.without_hardware_stamp);
  for (TimedWindow& window : record_.windows) {
    if (!answers(window.message, name)) continue;
    if (checks::within(window.window, stimulus.valid_us)) {
      // A stimulus that was answered several times counts once, with the latency of its last answer.
      if (const auto found = latest.find(window.message); found != latest.end()) {
        if (!window.slowest_us || found->second > window.latency.max_ns())
          window.slowest_us = stimulus.valid_us;
        window.latency.add(found->second);
      }
      if (!window.first_stimulus_ns) window.first_stimulus_ns = stimulus.t_ns;
      window.lateness.add(stimulus.t_ns - stimulus.due_ns);
      if (group.before) add_deviation(window, *group.before, stimulus);
    }
    if (stimulus.valid_us <= window.window.to_us)
      window.last_stimulus_ns = std::max(window.last_stimulus_ns.value_or(stimulus.t_ns), stimulus.t_ns);
  }
  group.before = stimulus;
}

}  // namespace canhil::observe
