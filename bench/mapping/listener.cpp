#include "bench/mapping/listener.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "bench/mapping/reading.hpp"
#include "dbc/parser/codec.hpp"

namespace canhil::mapping {

Listener::Listener(const Conversation& conversation, std::vector<checks::TimedWindow> windows,
                   const WireFacts& wire, bool virtual_time)
    : conversation_(conversation),
      seen_([&] {
        checks::Observations seen(conversation.mapping.messages);
        seen.timing.windows = std::move(windows);
        seen.timing.wire = wire;
        seen.answers_each_sample = false;
        return seen;
      }()),
      stopwatch_(seen_.timing),
      places_(conversation.mapping),
      passing_(conversation),
      receivers_(conversation.mapping.hears.size()),
      pairings_(conversation.mapping.hears.size()),
      virtual_time_(virtual_time) {
  const Mapping& mapping = conversation.mapping;
  for (const Hear& hear : mapping.hears) {
    const Mapped& of = hear.of;
    // The frames have numbers.
    if (of.has_several_frames()) seen_.from_target[of.index].has_counter = true;
    if (!of.protection) continue;
    seen_.from_target[of.index].has_counter = of.protection->settings().counter.has_value();
    seen_.from_target[of.index].has_checksum = of.protection->settings().checksum.has_value();
  }
}

// The transmission of a play that a frame completes; none: the frame is damaged, so the target need not
// answer the play. Several plays may end with pages of one message.
std::optional<Passing::Whole> Listener::closed_by(std::size_t message, const Frame& frame) const {
  const auto& plays = conversation_.mapping.plays;
  for (std::size_t i = 0; i < plays.size(); ++i) {
    if (plays[i].messages.back().of.index != message) continue;
    const auto& sent = conversation_.sent[i];
    const auto found =
        std::find_if(sent.rbegin(), sent.rend(), [&](const Sent& one) { return one.frames.back() == frame; });
    if (found != sent.rend()) return Passing::Whole{.play = i, .sent = &*found};
  }
  return std::nullopt;
}

void Listener::transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) {
  if (!std::exchange(sent_any_, true)) seen_.first_ns = t_ns;
  seen_.last_ns = t_ns;
  stopwatch_.sent(frame, t_ns, late_ns);
  const auto whole = passing_.take(frame);
  if (!whole) return;
  // A delayed frame is not at its time of the time base.
  const Sent& newest = conversation_.sent[whole->play].back();
  if (virtual_time_ || whole->sent == &newest) {
    due_us_ = newest.due_us;
    due_ns_ = t_ns - late_ns;
  }
  const std::string_view group = conversation_.mapping.groups[whole->play];
  const std::int64_t valid_us = whole->sent->valid_us;
  seen_.stimuli[group].add(valid_us);
  stopwatch_.stimulus(group, {.valid_us = valid_us, .t_ns = t_ns, .due_ns = t_ns - late_ns});
  for (std::size_t i = 0; i < pairings_.size(); ++i) {
    const Hear& hear = conversation_.mapping.hears[i];
    if (hear.is_owed() && hear.answers == whole->play)
      pairings_[i].pairing.sent(carried_by(hear, *whole->sent), valid_us, t_ns, settler(hear));
  }
}

void Listener::received(const Received& received) {
  const std::size_t index = places_(received.frame);
  if (index == MessagePlaces::nowhere) return;
  if (received.own) {
    const auto whole = closed_by(index, received.frame);
    if (whole) seen_.transmit_stamps_echoed = true;
    return stopwatch_.echoed(received, whole ? conversation_.mapping.groups[whole->play] : "",
                             whole ? whole->sent->valid_us : 0);
  }
  for (const std::size_t one : places_.hears(received.frame))
    hear(conversation_.mapping.hears[one], received);
}

void Listener::hear(const Hear& hear, const Received& received) {
  using Outcome = Receiver::Outcome;
  const std::size_t index = hear.of.index;
  checks::Sighting& sighting = seen_.from_target[index];
  auto& receiver = receivers_[static_cast<std::size_t>(&hear - conversation_.mapping.hears.data())];
  const Receiver::Taken taken = receiver.take(hear.of, received.frame);
  sighting.lost += taken.lost;
  switch (taken.outcome) {
    case Outcome::part:
      return;
    case Outcome::wrong_size:
      ++sighting.wrong_size;
      sighting.size = taken.size;
      return;
    case Outcome::wrong_checksum:
      ++sighting.wrong_crc;
      return;
    case Outcome::wrong_counter:
      ++sighting.wrong_counter;
      return;
    case Outcome::repeated:
      ++sighting.repeated;
      return;
    case Outcome::whole:
      break;
  }
  ++sighting.right;
  ++seen_.answers[index];
  // Before the first play there is nothing to answer.
  if (!hear.is_owed() || conversation_.sent[*hear.answers].empty()) {
    stopwatch_.arrived(index, received);
    if (!hear.answers && sent_any_) record(hear, taken.bytes, bench_us(received.t_ns));
    const Sent* cause = hear.task_us > 0 ? cause_of(conversation_, hear, taken.bytes) : nullptr;
    if (cause != nullptr) record(hear, taken.bytes, cause->valid_us);
    return;
  }
  // An echo that matches no play counts as an answer without a cause. Without an echo, an answer to a play
  // that was answered before shows that the order of the answers does not reveal their causes.
  Paired otherwise{.answer = received,
                   .bytes = {taken.bytes.begin(), taken.bytes.end()},
                   .certain = hear.echo.has_value()};
  const std::uint64_t echoed = echoed_by(hear, taken.bytes);
  otherwise.owed = !passing_.carried_changed(hear, echoed);
  if (const Sent* latest = cause_of(conversation_, hear, taken.bytes)) {
    otherwise.cause_us = latest->valid_us;
    if (hear.echo && passing_.may_answer(*hear.answers, latest->valid_us, hear.echo->message))
      otherwise.owed = false;
  }
  pairing_of(hear).pairing.answered(received, echoed, otherwise, settler(hear));
}

Listener::OwnPairing& Listener::pairing_of(const Hear& hear) {
  return pairings_[static_cast<std::size_t>(&hear - conversation_.mapping.hears.data())];
}

Pairing::Give Listener::settler(const Hear& hear) {
  return [this, &hear](const Paired& paired) { settle(hear, paired); };
}

// An uncertain cause is good enough for the values of the answer, which a check may then not judge, but not
// for a latency.
void Listener::settle(const Hear& hear, const Paired& paired) {
  const std::size_t index = hear.of.index;
  stopwatch_.arrived(index, paired.answer);
  // The answer to a stimulus that was never complete has no latency, and neither has its second page.
  const bool counts = paired.owed && !is_another_page(hear, paired);
  if (counts && paired.certain) {
    stopwatch_.answered({&index, 1}, conversation_.mapping.groups[*hear.answers],
                        paired.cause_us.value_or(-1));
  } else if (counts) {
    OwnPairing& own = pairing_of(hear);
    if (own.uncertain++ == 0) own.apart_us = paired.apart_us;
    own.apart_us = std::min(own.apart_us, paired.apart_us);
  }
  if (paired.cause_us) record(hear, paired.bytes, *paired.cause_us);
}

// A target may spread its answer to a sample over pages of a multiplexed message. None of them is given
// twice.
bool Listener::is_another_page(const Hear& hear, const Paired& paired) {
  const auto& signals = hear.of.message->signals;
  if (!paired.cause_us || !is_multiplexed(*hear.of.message)) return false;
  std::vector<bool> page;
  for (std::size_t i = 0; i < signals.size(); ++i) page.push_back(hear.of.plan.is_present(i, paired.bytes));
  OwnPairing& own = pairing_of(hear);
  const bool same_cause = std::exchange(own.cause_us, paired.cause_us) == paired.cause_us;
  if (!same_cause) own.pages.clear();
  return own.pages.insert(std::move(page)).second && same_cause;
}

void Listener::record(const Hear& hear, std::span<const std::uint8_t> bytes, std::int64_t t_us) {
  auto& answers = seen_.of<Answers>();
  answers.messages[hear.of.message->name].push_back(t_us);
  read(hear, bytes, values_, [&](const ReportedSignal& telling, double value, bool invalid) {
    // A value that is not a number is recorded too: it makes checks fail.
    if (telling.what != ReportedSignal::What::value || !invalid)
      answers.values[&telling].push_back({.t_us = t_us, .value = value, .none = invalid});
  });
  for (const ReportedFlag& flag : hear.flags) {
    if (state_of(hear, flag, bytes).value_or(false)) answers.flags[&flag].push_back(t_us);
  }
}

std::int64_t Listener::bench_us(std::int64_t t_ns) const {
  return virtual_time_ ? due_us_ : due_us_ + (t_ns - due_ns_) / 1000;
}

void Listener::target_restarts() {
  receivers_ = std::vector<Receiver>(receivers_.size());
  for (const Hear& hear : conversation_.mapping.hears) pairing_of(hear).pairing.end(settler(hear));
}

checks::Observations Listener::finish() {
  for (const Hear& hear : conversation_.mapping.hears) {
    OwnPairing& own = pairing_of(hear);
    own.pairing.end(settler(hear));
    if (own.uncertain == 0) continue;
    seen_.timing.answers[hear.of.index].ambiguous =
        fmt::format("{} of {} answers in {} may belong to more than one sample: {}", own.uncertain,
                    seen_.answers[hear.of.index], hear.of.message->name,
                    hear.echo ? fmt::format("{} comes round every {:g} ms", hear.echo->repeated->name,
                                            1e-3 * static_cast<double>(own.apart_us))
                              : "it has no echo of the sample that it answers");
  }
  stopwatch_.finish();
  return std::move(seen_);
}

}  // namespace canhil::mapping
