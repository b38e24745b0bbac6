#include "bench/mapping/event_sender.hpp"

#include <algorithm>
#include <utility>

#include "bench/mapping/reading.hpp"

namespace canhil::mapping {
namespace {

using nodes::never_us;
using scenario::Event;

// The target must answer a first frame with flow control within this time (N_Bs of ISO 15765-2).
constexpr std::int64_t flow_control_us = 1'000'000;
// How often a condition is looked at until it holds.
constexpr std::int64_t condition_step_us = 10'000;

}  // namespace

EventSender::EventSender(const Mapping& mapping, const std::vector<Event>& events, scenario::Phase phase,
                         Dialogue& dialogue, Counters& counters, const world::Truths& truths,
                         std::int64_t end_us)
    : mapping_(mapping),
      events_(events),
      truths_(truths),
      end_us_(end_us),
      dialogue_(dialogue),
      counters_(counters),
      places_(mapping) {
  for (std::size_t i = 0; i < events.size(); ++i) {
    const Event& event = events[i];
    if (phase_of(events, event) != phase) continue;
    Waiting waiting{.event = i, .left = event.times};
    if (event.when == Event::When::start || event.when == Event::When::end) waiting.due_us = 0;
    if (event.when == Event::When::time) waiting.due_us = event.at_us;
    waiting.looks = event.when == Event::When::truth;
    if (waiting.looks)
      waiting.due_us = 0;
    else if (waiting.due_us != never_us)
      waiting.due_us += event.delay_us;
    waiting_.push_back(waiting);
  }
}

const EventChannel& EventSender::channel_of(std::size_t event) const {
  return mapping_.event_channels[events_[event].channel];
}

std::int64_t EventSender::due_us() const {
  std::int64_t due_us = ready_.empty() ? never_us : ready_.front().due_us;
  for (const auto& [channel, talk] : talks_) due_us = std::min(due_us, talk.due_us);
  for (const Waiting& one : waiting_) {
    if (one.looks || !talks_.contains(events_[one.event].channel)) due_us = std::min(due_us, one.due_us);
  }
  return due_us;
}

void EventSender::transmit(nodes::Transmission& out) {
  const std::int64_t now_us = due_us();
  if (!ready_.empty() && ready_.front().due_us == now_us) {
    out.put(ready_.front().frame);
    return ready_.pop_front();
  }
  for (auto& [channel, talk] : talks_) {
    if (talk.due_us != now_us) continue;
    const bool sends = talk.sender && talk.sender->may_send();
    if (!sends || !advance(talk, now_us, out)) end(channel, now_us, false);
    return;
  }
  const auto next = std::ranges::find_if(waiting_, [&](const Waiting& one) {
    return one.due_us == now_us && (one.looks || !talks_.contains(events_[one.event].channel));
  });
  if (next->looks) return look(*next, now_us);
  begin(*next, now_us, out);
}

void EventSender::look(Waiting& waiting, std::int64_t now_us) {
  const Event& event = events_[waiting.event];
  if (event.condition->at(truths_, now_us).value_or(0) != 0) {
    waiting.looks = false;
    waiting.due_us = now_us + event.delay_us;
  } else {
    waiting.due_us = now_us + condition_step_us > end_us_ ? never_us : now_us + condition_step_us;
  }
}

void EventSender::begin(Waiting& waiting, std::int64_t now_us, nodes::Transmission& out) {
  const std::size_t index = waiting.event;
  const Event& event = events_[index];
  if (--waiting.left > 0)
    waiting.due_us = now_us + event.period_us;
  else
    std::erase_if(waiting_, [&](const Waiting& one) { return one.event == index; });
  const EventChannel& channel = channel_of(index);
  dialogue_.expect(index);
  Talk talk{.event = index};
  if (channel.transport == EventChannel::Transport::iso_tp) {
    talk.sender.emplace(event.request, channel.settings);
  } else {
    transport::Bytes bytes = event.request;
    bytes.resize(channel.request.message->size);
    if (channel.request.protection) counters_[event.channel].protect(*channel.request.protection, bytes);
    out.put(channel.request.frame(bytes));
  }
  if (!advance(talks_[event.channel] = std::move(talk), now_us, out)) end(event.channel, now_us, false);
}

// Sends the next frame of a transport protocol, if there is one. Returns false if the talk is over: the
// request is complete, and no answer is expected.
bool EventSender::advance(Talk& talk, std::int64_t now_us, nodes::Transmission& out) {
  const Event& event = events_[talk.event];
  if (talk.sender && talk.sender->may_send()) {
    out.put(channel_of(talk.event).request.frame(*talk.sender->next()));
    if (talk.sender->may_send()) {
      talk.due_us = now_us + talk.sender->separation_us();
      return true;
    }
    if (!talk.sender->over()) {
      talk.due_us = now_us + flow_control_us;
      return true;
    }
  }
  talk.due_us = now_us + event.patience_us();
  return event.expected.has_value();
}

// The next event of the channel may begin, and those that waited for this answer.
void EventSender::end(std::size_t channel, std::int64_t now_us, bool has_answer) {
  const std::size_t event = talks_[channel].event;
  talks_.erase(channel);
  dialogue_.give_up(channel);
  for (Waiting& one : waiting_) {
    const Event& other = events_[one.event];
    if (has_answer && other.when == Event::When::answered && other.after == event && one.due_us == never_us)
      one.due_us = now_us + other.delay_us;
    if (other.channel == channel && one.due_us != never_us && !one.looks)
      one.due_us = std::max(one.due_us, now_us);
  }
}

bool EventSender::hear(const Frame& frame, std::int64_t now_us) {
  for (std::size_t channel = 0; channel < mapping_.event_channels.size(); ++channel) {
    const EventChannel& of = mapping_.event_channels[channel];
    if (!of.response || !is_of(frame, *of.response)) continue;
    const auto found = talks_.find(channel);
    if (found == talks_.end()) continue;
    Talk& talk = found->second;
    if (auto flow_control = dialogue_.flow_control(channel))
      ready_.push_back({.due_us = now_us, .frame = of.request.frame(*flow_control)});
    if (talk.sender && !talk.sender->over()) {
      talk.sender->take(frame.payload());
      if (talk.sender->may_send()) talk.due_us = now_us;
      if (talk.sender->over()) end(channel, now_us, false);
    } else if (!dialogue_.is_open(channel)) {
      end(channel, now_us, true);
    } else {  // a part of the answer, or "response pending"
      talk.due_us = now_us + events_[talk.event].patience_us();
    }
  }
  see_flags(frame, now_us);
  return true;
}

void EventSender::see_flags(const Frame& frame, std::int64_t now_us) {
  for (const std::size_t index : places_.hears(frame)) {
    const Hear& hear = mapping_.hears[index];
    if (hear.flags.empty()) continue;
    const Receiver::Taken taken = receivers_[index].take(hear.of, frame);
    if (taken.outcome != Receiver::Outcome::whole) continue;
    for (Waiting& one : waiting_) {
      const Event& event = events_[one.event];
      if (event.when != Event::When::flag || one.due_us != never_us) continue;
      for (const ReportedFlag& flag : hear.flags) {
        if (flag.name == event.flag && state_of(hear, flag, taken.bytes) == event.flag_set)
          one.due_us = now_us + event.delay_us;
      }
    }
  }
}

bool EventSender::awaits() const {
  return std::ranges::any_of(
      talks_, [](const auto& one) { return !one.second.sender || !one.second.sender->may_send(); });
}

void EventSender::give_up(std::int64_t now_us) {
  std::vector<std::size_t> waits;
  for (const auto& [channel, talk] : talks_) {
    if (!talk.sender || !talk.sender->may_send()) waits.push_back(channel);
  }
  for (const std::size_t channel : waits) end(channel, now_us, false);
}

}  // namespace canhil::mapping
