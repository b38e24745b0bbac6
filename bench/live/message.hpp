// Snapshots as messages for the page: JSON, docs/live.md describes it.
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "bench/live/snapshot.hpp"

namespace canhil::live {

/// What was sent of each series: of the next message only what came since is a part.
using Sent = std::map<std::string, std::size_t>;

/// All of it.
std::string whole_message(const Snapshot& snapshot);
/// What is new; `sent` becomes what was sent with it. The end of a flight is always whole.
std::string next_message(const Snapshot& snapshot, Sent& sent);

}  // namespace canhil::live
