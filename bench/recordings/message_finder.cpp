#include "bench/recordings/message_finder.hpp"

#include <algorithm>

#include "dbc/wire/j1939.hpp"

namespace canhil::recordings {
namespace {

constexpr std::uint8_t null_address = 254;  // no node has it, so a DBC uses it for messages of any source

}  // namespace

MessageFinder::MessageFinder(const dbc::Database& database, bool j1939) : j1939_(j1939) {
  for (const dbc::Message& message : database.messages) {
    by_id_.emplace(std::pair(message.id, message.extended), &message);
    if (is_group(message)) groups_[wire::j1939_group(message.id)].push_back(&message);
  }
}

MessageFinder::Found MessageFinder::find(const Frame& frame) const {
  if (frame.error) return {};
  if (const auto found = by_id_.find({frame.id, frame.extended}); found != by_id_.end())
    return {Match::found, found->second, is_group(*found->second)};
  if (!frame.extended) return {};
  const auto group = groups_.find(wire::j1939_group(frame.id));
  if (group == groups_.end()) return {};
  for (const std::uint8_t source : {wire::j1939_source(frame.id), null_address}) {
    const auto same = std::ranges::find(
        group->second, source, [](const dbc::Message* message) { return wire::j1939_source(message->id); });
    if (same != group->second.end()) return {Match::found, *same, true};
  }
  if (group->second.size() > 1) return {Match::ambiguous, nullptr, true};
  return {Match::found, group->second.front(), true};
}

}  // namespace canhil::recordings
