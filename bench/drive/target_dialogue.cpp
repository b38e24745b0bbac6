#include "bench/drive/target_dialogue.hpp"

#include <fmt/format.h>

#include "bench/protocol/decode_from_target.hpp"
#include "bench/protocol/heartbeat_errors.hpp"
#include "dbc/wire/transmit.hpp"

namespace canhil::drive {
namespace {

using namespace messages;

constexpr std::int64_t poll_ns = 20'000'000;

std::string parameter_name(Parameter parameter) {
  const std::string_view known = name_of(parameter);
  return known.empty() ? fmt::format("parameter {}", static_cast<int>(parameter)) : std::string(known);
}

std::string to_text(const TargetHeartbeat& beat) {
  return fmt::format("state {}, estimator {}, algorithm {}, errors: {}", name_of(beat.state),
                     name_of(beat.estimator), name_of(beat.algorithm), protocol::errors_of(beat));
}

}  // namespace

void Mailbox::received(const Received& received) {
  if (const auto beat = protocol::decode_from_target<TargetHeartbeat>(received)) {
    heartbeat = beat;
    beats_[static_cast<std::size_t>(beat->estimator)] = *beat;
  }
  if (const auto ack = protocol::decode_from_target<ParamAck>(received)) acknowledgement = ack;
  if (protocol::decode_from_target<Sync>(received)) other_bench = true;
}

void Mailbox::foreign(const Received& received) {
  foreign_heartbeat = foreign_heartbeat || (received.frame.id == TargetHeartbeat::info.id &&
                                            received.frame.extended == TargetHeartbeat::info.extended);
}

Result<void> Dialogue::until(const Step& step, const Request& request, const Condition& condition) {
  const std::int64_t deadline_ns = link_.now_ns() + step.limit_ns;
  std::int64_t repeat_at_ns = 0;
  sightings_.clear();
  mailbox_.acknowledgement.reset();
  for (;;) {
    if (link_.now_ns() >= repeat_at_ns) {
      if (auto sent = send(request); !sent) return sent;
      repeat_at_ns = link_.now_ns() + repeat_ns;
    }
    if (link_.drain() == LinkState::down)
      return failure(fmt::format("bus '{}': gone while {}", link_.port().name(), step.doing));
    if (second_.found())
      return failure(fmt::format("target on '{}': {}, expected to be the only one", link_.port().name(),
                                 protocol::SecondTarget::complaint));
    if (condition(mailbox_)) return {};
    if (const auto why = gone_()) return failure(fmt::format("{} while {}", *why, step.doing));
    if (link_.now_ns() >= deadline_ns) return failure(complaint(step));
    link_.wait_until(std::min(link_.now_ns() + poll_ns, deadline_ns));
  }
}

void Dialogue::listen(std::int64_t duration_ns) {
  const std::int64_t deadline_ns = link_.now_ns() + duration_ns;
  while (link_.now_ns() < deadline_ns && link_.drain() == LinkState::up) link_.wait_until(deadline_ns);
}

// If valid heartbeats arrived, reports the last heartbeat, the defects of frames and, if there is one, a
// ParamAck for another parameter. If no valid heartbeat arrived, lists the frames that arrived.
std::string Dialogue::complaint(const Step& step) const {
  const double limit_s = static_cast<double>(step.limit_ns) * 1e-9;
  const bool beats = mailbox_.heartbeat && sightings_.of(message_index<TargetHeartbeat>()).right > 0;
  if (!beats)
    return fmt::format("target on '{}': no answer within {:g} s while {}; seen: {}", link_.port().name(),
                       limit_s, step.doing, sightings_.to_text());
  std::string text =
      fmt::format("target on '{}': answers, but never says {} within {:g} s while {}: {}",
                  link_.port().name(), step.awaited, limit_s, step.doing, to_text(*mailbox_.heartbeat));
  if (const auto& ack = mailbox_.acknowledgement)
    text += fmt::format("; ParamAck for another parameter: {}", parameter_name(ack->parameter));
  const std::string seen = sightings_.faults();
  return seen.empty() ? text : fmt::format("{}; seen: {}", text, seen);
}

Result<void> Dialogue::send(const Request& request) {
  out_.clear();
  request(out_);
  for (const Frame& frame : out_.frames()) {
    if (link_.send(frame, answer_limit_ns) != LinkState::up) {
      return failure(fmt::format("bus '{}': takes no frames; is another node connected and the interface up?",
                                 link_.port().name()));
    }
  }
  return {};
}

}  // namespace canhil::drive
