#include "bench/protocol/sightings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bench/protocol/decode_from_target.hpp"
#include "dbc/wire/e2e.hpp"
#include "dbc/wire/transmit.hpp"

namespace canhil::protocol {

bool look_at(const Frame& frame, const MessageInfo& message, checks::Sighting& sighting) {
  if (frame.size != message.size || frame.fd != message.fd) {
    ++sighting.wrong_size;
    sighting.size = frame.size;
  } else if (frame.data[0] != e2e::crc(frame.payload(), message.e2e_data_id)) {
    ++sighting.wrong_crc;
  } else if (e2e::counter(frame.payload()) >= e2e::counter_period) {
    ++sighting.wrong_counter;
    sighting.counter = e2e::counter(frame.payload());
  } else {
    ++sighting.right;
    return true;
  }
  return false;
}

void Sightings::received(const Received& received) {
  const Frame& frame = received.frame;
  if (received.own) return;
  if (frame.error) {
    ++seen_.errors;
    return;
  }
  if (const std::size_t index = target_messages(frame); index != Routes::nowhere) {
    look_at(frame, messages::all_messages[index], seen_.of_target[index]);
    return;
  }
  const Other other{.id = frame.id, .extended = frame.extended};
  if (std::ranges::find(seen_.others, other) != seen_.others.end()) return;
  if (seen_.others.size() < most_others) {
    seen_.others.push_back(other);
  } else {
    seen_.more_others = true;
  }
}

std::string Sightings::faults() const {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < seen_.of_target.size(); ++i) {
    const MessageInfo& message = messages::all_messages[i];
    if (const std::string what = faults_of(seen_.of_target[i], message); !what.empty())
      parts.push_back(fmt::format("{}: {}", message.name, what));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::string Sightings::to_text() const {
  std::vector<std::string> parts;
  if (std::string wrong = faults(); !wrong.empty()) parts.push_back(std::move(wrong));
  for (std::size_t i = 0; i < seen_.of_target.size(); ++i) {
    if (seen_.of_target[i].right > 0)
      parts.push_back(fmt::format("{}: {}", messages::all_messages[i].name, seen_.of_target[i].right));
  }
  if (!seen_.others.empty()) {
    std::vector<std::string> ids;
    for (const Other& other : seen_.others) ids.push_back(fmt::format("0x{:x}", other.id));
    parts.push_back(
        fmt::format("frames of other ids: {}{}", fmt::join(ids, ", "), seen_.more_others ? " and more" : ""));
  }
  if (seen_.errors > 0) parts.push_back(fmt::format("{} error frames", seen_.errors));
  if (parts.empty()) return "no frame";
  const checks::Sighting& heartbeat = seen_.of_target[message_index<messages::TargetHeartbeat>()];
  const bool any = heartbeat.right + heartbeat.wrong_crc + heartbeat.wrong_counter + heartbeat.wrong_size > 0;
  if (!any) parts.emplace_back("no heartbeat");
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace canhil::protocol
