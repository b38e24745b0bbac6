// Converts snapshots to JSON messages for the page; docs/live.md describes the format.
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "bench/live/snapshot.hpp"

namespace canhil::live {

/// The number of points of each series that were already sent. The next message contains the newer points and
/// also the last sent point, because this point may have changed.
using Sent = std::map<std::string, std::size_t>;

/// A message with the complete snapshot.
std::string whole_message(const Snapshot& snapshot);
/// A message with the changes since the messages that `sent` records; updates `sent`. At the end of a flight
/// the message contains everything.
std::string next_message(const Snapshot& snapshot, Sent& sent);

}  // namespace canhil::live
