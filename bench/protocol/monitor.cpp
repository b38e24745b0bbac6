#include "bench/protocol/monitor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bench/estimators/registry.hpp"
#include "bench/protocol/decode_from_target.hpp"
#include "bench/protocol/sightings.hpp"
#include "dbc/wire/e2e.hpp"
#include "dbc/wire/time_base.hpp"
#include "dbc/wire/transmit.hpp"

namespace canhil::protocol {
namespace {

using namespace messages;

constexpr bool is_answered(std::string_view group) {
  return std::ranges::any_of(all_messages, [&](const MessageInfo& info) {
    return std::ranges::find(info.answers, group) != info.answers.end();
  });
}

// The message that completes a sample group which the target answers.
template <class Message>
concept ClosesStimulus = requires(Message message) {
  message.time_of_validity_us;
}
&&is_answered(Message::info.sample_group);

// The message with the highest id of each sample group that the target answers. Membership in this table is a
// quick first test: two in three of the bench's frames complete no group.
constexpr Routes closing_messages([](const MessageInfo& info) {
  return is_answered(info.sample_group) && std::ranges::none_of(all_messages, [&](const MessageInfo& other) {
           return other.sample_group == info.sample_group && other.id > info.id;
         });
});

// The sample group that a frame of the bench completes, and its time of validity.
struct Closed {
  std::size_t message = Routes::nowhere;  // nowhere: the frame completes no group that the target answers
  std::uint32_t valid_us = 0;
  [[nodiscard]] std::string_view group() const { return all_messages[message].sample_group; }
};

// The time of validity in a message that closes a group; by index in all_messages.
using ValidityOf = std::uint32_t (*)(const Frame&);
template <class Message>
std::uint32_t validity_in(const Frame& frame) {
  return from_frame<Message>(frame).time_of_validity_us;
}
template <class Message>
constexpr ValidityOf validity_in_message() {
  if constexpr (ClosesStimulus<Message>)
    return validity_in<Message>;
  else
    return nullptr;
}
constexpr auto validity_of = []<class... Messages>(std::type_identity<std::tuple<Messages...>>) {
  std::array<ValidityOf, all_messages.size()> found{};
  ((found[message_index<Messages>()] = validity_in_message<Messages>()), ...);
  return found;
}(std::type_identity<AllMessages>{});

Closed closed_by(const Frame& frame) {
  const std::size_t message = closing_messages(frame);
  if (message == Routes::nowhere || validity_of[message] == nullptr) return {};
  return {message, validity_of[message](frame)};
}

// Equal texts nearly always are the same literal.
bool same(std::string_view a, std::string_view b) {
  return a.size() == b.size() && (a.data() == b.data() || a == b);
}

}  // namespace

Monitor::Monitor(std::optional<Asked> asked) {
  if (asked) {
    seen_.timing.windows = std::move(asked->windows);
    seen_.timing.wire = asked->wire;
    seen_.own_interval_s = std::move(asked->own_interval_s);
    stopwatch_.emplace(seen_.timing);
    takers_ = std::move(asked->takers);
    model_.emplace(takers_);
  }
  for (std::size_t i = 0; i < all_messages.size(); ++i) {
    checks::Sighting& sighting = seen_.from_target[i];
    sighting.has_counter = sighting.has_checksum = is_targets(all_messages[i]);
  }
  for (const estimators::Estimator* estimator : estimators::all()) {
    estimators::Reception* own = receptions_.emplace_back(estimator->reception()).get();
    for (std::size_t message = 0; message < reception_of_.size(); ++message) {
      if (own->takes(message)) reception_of_[message] = own;
    }
  }
}

void Monitor::target_restarts() {
  in_handshake_ = true;
  seen_.reports.restart();
}

// The first Sync after the handshake: both sides count from here on.
void Monitor::flight_goes_on() {
  in_handshake_ = false;
  receivers_ = {};
  if (model_) model_.emplace(takers_);
}

void Monitor::transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) {
  if (!sent_any_) seen_.first_ns = t_ns;
  sent_any_ = true;
  seen_.last_ns = t_ns;
  if (stopwatch_) stopwatch_->sent(frame, t_ns, late_ns);
  if (frame.id == Sync::info.id) {
    if (in_handshake_) flight_goes_on();
    const auto sync = from_frame<Sync>(frame);
    now_us_ = static_cast<std::int64_t>(sync.time_us);
    if (model_) model_->synchronised(sync.lockstep != 0);
  } else if (const Closed closed = closed_by(frame); closed.message != Routes::nowhere) {
    const std::int64_t valid_us = unwrap_us(closed.valid_us, now_us_);
    checks::StimulusCount*& stimuli = stimuli_[closed.message];
    if (stimuli == nullptr) stimuli = &seen_.stimuli[closed.group()];
    stimuli->add(valid_us);
    for (const auto& reception : receptions_) reception->sent(closed.group(), valid_us, seen_);
    const bool must_use = !model_ || model_->sent(frame, valid_us, now_us_);
    if (stopwatch_)
      stopwatch_->stimulus(closed.group(), {.valid_us = valid_us,
                                            .counter = e2e::counter(frame.payload()),
                                            .t_ns = t_ns,
                                            .due_ns = t_ns - late_ns,
                                            .owed_answer = must_use});
    return;
  }
  if (model_) model_->sent(frame, std::nullopt, now_us_);
}

checks::Observations Monitor::finish() {
  if (stopwatch_) stopwatch_->finish();
  if (model_) seen_.longest_input_gap_us = model_->longest_gap_us(now_us_);
  seen_.complaints.end(now_us_);
  seen_.reports.end(now_us_);
  stimuli_ = {};  // they are in what is given away
  return std::move(seen_);
}

// The transmit stamp of the echo replaces the bench's own stamp of the stimulus.
void Monitor::echoed(const Received& received) {
  const Closed closed = closed_by(received.frame);
  const bool closes = closed.message != Routes::nowhere;
  if (closes) seen_.transmit_stamps_echoed = true;
  if (stopwatch_)
    stopwatch_->echoed(received, closes ? closed.group() : "", unwrap_us(closed.valid_us, now_us_));
}

void Monitor::received(const Received& received) {
  if (received.own) return echoed(received);
  const Frame& frame = received.frame;
  const std::size_t index = target_messages(frame);
  if (index == Routes::nowhere) return;
  const MessageInfo* info = &all_messages[index];
  checks::Sighting& sighting = seen_.from_target[index];
  const auto spoilt = [&] { look_at(frame, *info, sighting); };
  if (frame.size != info->size || frame.fd != info->fd) return spoilt();
  if (in_handshake_) receivers_[index] = {};  // the commands reset the target's transmit counters
  switch (receivers_[index].check(frame.payload(), info->e2e_data_id)) {
    case e2e::Check::wrong_crc:
      return spoilt();
    case e2e::Check::repeated:
      ++sighting.repeated;
      return;
    case e2e::Check::some_lost:
      sighting.lost += static_cast<std::uint64_t>(receivers_[index].lost());
      break;
    case e2e::Check::ok:
      break;
  }
  ++sighting.right;
  if (stopwatch_) stopwatch_->arrived(index, received);
  decode(frame, index);
}

void Monitor::decode(const Frame& frame, std::size_t index) {
  if (estimators::Reception* reception = reception_of_[index]; reception != nullptr) {
    // When the answer is complete, it consists of the newest arrival of each of its messages.
    const auto whole = reception->take(frame, index, now_us_, seen_);
    if (!whole) return;
    for (const std::size_t message : whole->messages) {
      const auto owed = all_messages[message].answers;  // a further answer does not replace one that is owed
      if (std::ranges::any_of(owed, [&](std::string_view one) { return same(one, whole->cause_group); }))
        ++seen_.answers[message];
    }
    if (stopwatch_)
      stopwatch_->answered(whole->messages, whole->cause_group, whole->cause_us, whole->cause_counter);
    return;
  }
  if (frame.id == TargetCounters::info.id) {
    if (in_handshake_) return;
    seen_.counters = from_frame<TargetCounters>(frame);
    seen_.complaints.hear(*seen_.counters, now_us_);
    seen_.reports.hear(*seen_.counters, now_us_);
    if (model_) seen_.expected_counts = model_->expected();
  } else if (frame.id == TargetHeartbeat::info.id) {
    const auto heartbeat = from_frame<TargetHeartbeat>(frame);
    seen_.complaints.hear(heartbeat, now_us_);
    if (!in_handshake_) seen_.reports.hear(heartbeat, now_us_);
    if (seen_.target_version.empty())
      seen_.target_version = fmt::format("{}.{}", heartbeat.version_major, heartbeat.version_minor);
  } else if (frame.id == TargetTiming::info.id) {
    const auto timing = from_frame<TargetTiming>(frame);
    seen_.target_timing_seen = true;
    seen_.queue_max_us = std::max(seen_.queue_max_us, timing.queue_max_us);
    seen_.compute_max_us = std::max(seen_.compute_max_us, timing.compute_max_us);
    if (stopwatch_) stopwatch_->on_target_timing(timing);
  }
}

}  // namespace canhil::protocol
