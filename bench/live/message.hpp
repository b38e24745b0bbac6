// Snapshots as messages for the page: JSON, docs/live.md describes it.
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "bench/live/snapshot.hpp"

namespace canhil::live {

/// The number of points of each series that were already sent. The next message contains newer points, and
/// the last sent point again, because it may have changed.
using Sent = std::map<std::string, std::size_t>;

/// The complete snapshot.
std::string whole_message(const Snapshot& snapshot);
/// The changes since the messages that `sent` counts; updates `sent`. At the end of a flight the message
/// contains everything.
std::string next_message(const Snapshot& snapshot, Sent& sent);

}  // namespace canhil::live
