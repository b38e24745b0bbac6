// What the frames of a run took to pass the bus, beside the bound of theory.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/checks/observations.hpp"

namespace canhil::checks {

/// A message of the bus's contract, on CAN FD a container, its longest response (see WireResponse) and the
/// bound: of theory for the order of the bus's queues and the messages that were seen, each as often as it
/// was sent or as the DBC says, whichever is more often. From being queued on, so that the lateness of the
/// bench and the target's computing are in neither.
struct WireBound {
  std::string_view message{};
  bool of_target = false;  ///< its response is a least one
  std::uint64_t count = 0;
  std::int64_t longest_ns = 0;
  std::int64_t frame_ns = 0;               ///< the longest that such a frame can be
  std::optional<std::int64_t> bound_ns{};  ///< none: the analysis finds none
};

/// By priority. Empty where the bit rate of the bus is not known.
std::vector<WireBound> wire_bounds(const Observations& seen);

/// Why bounds mean nothing in this run; empty: they do.
std::string no_bounds(const Observations& seen);

}  // namespace canhil::checks
