#include "bench/mapping/dialogue.hpp"

#include <utility>

#include "dbc/transport/uds.hpp"

namespace canhil::mapping {
namespace {

using transport::Bytes;

// Whether an event sends this request. The counter of a protected message changes.
bool is_request(const EventChannel& channel, const scenario::Event& event, const Bytes& request) {
  Bytes whole = event.request;
  if (channel.transport == EventChannel::Transport::frame) whole.resize(channel.request.message->size);
  return channel.request.protection || whole == request;
}

Bytes bytes_of(const Frame& frame) { return {frame.payload().begin(), frame.payload().end()}; }

}  // namespace

bool is_of(const Frame& frame, const Mapped& message) {
  return !frame.error && frame.id == message.message->id && frame.extended == message.message->extended;
}

Dialogue::Dialogue(const Mapping& mapping, const std::vector<scenario::Event>& events)
    : mapping_(mapping), events_(events) {
  for (const EventChannel& channel : mapping.event_channels) lines_.emplace_back(channel);
}

void Dialogue::expect(std::size_t event) { lines_[events_[event].channel].event = event; }

std::optional<Bytes> Dialogue::flow_control(std::size_t channel) {
  return std::exchange(lines_[channel].flow_control, std::nullopt);
}

void Dialogue::transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t /*late_ns*/) {
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const EventChannel& channel = mapping_.event_channels[i];
    if (!is_of(frame, channel.request)) continue;
    if (channel.transport == EventChannel::Transport::frame)
      asked(i, frame, bytes_of(frame), t_ns);
    else if (auto taken = lines_[i].requests.take(frame.payload()); taken.message)
      asked(i, frame, std::move(*taken.message), t_ns);
  }
}

void Dialogue::received(const Received& received) {
  const Frame& frame = received.frame;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const EventChannel& channel = mapping_.event_channels[i];
    Line& line = lines_[i];
    if (received.own) {  // its transmit stamp is better than that of the bench
      if (line.open && line.last == frame) exchanges_[*line.open].sent_ns = received.t_ns;
      continue;
    }
    if (!channel.response || !is_of(frame, *channel.response)) continue;
    if (channel.transport == EventChannel::Transport::frame) {
      answered(i, bytes_of(frame), received.t_ns);
      continue;
    }
    auto taken = line.answers.take(frame.payload());
    line.flow_control = std::move(taken.flow_control);
    if (!taken.broken.empty() && line.open) exchanges_[*line.open].broken = std::move(taken.broken);
    if (taken.message) answered(i, std::move(*taken.message), received.t_ns);
  }
}

std::optional<std::size_t> Dialogue::by_order(std::size_t channel, const Bytes& request) {
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i < events_.size(); ++i) {
    if (events_[i].channel != channel || !is_request(mapping_.event_channels[channel], events_[i], request))
      continue;
    last = i;
    if (seen_[i] < events_[i].times) break;
  }
  if (last) ++seen_[*last];
  return last;
}

void Dialogue::asked(std::size_t channel, const Frame& frame, Bytes request, std::int64_t t_ns) {
  Line& line = lines_[channel];
  std::optional<std::size_t> event = std::exchange(line.event, std::nullopt);
  if (!event) event = by_order(channel, request);
  if (!event) return;
  if (events_[*event].expected) line.open = exchanges_.size();
  line.last = frame;
  exchanges_.push_back({.event = *event, .request = std::move(request), .sent_ns = t_ns});
}

void Dialogue::answered(std::size_t channel, Bytes answer, std::int64_t t_ns) {
  Line& line = lines_[channel];
  if (!line.open) return;
  if (transport::negative_code(exchanges_[*line.open].request, answer) == transport::response_pending) return;
  checks::Exchange& one = exchanges_[*std::exchange(line.open, std::nullopt)];
  one.answer = std::move(answer);
  one.answered_ns = t_ns;
}

}  // namespace canhil::mapping
