// Measured bus response times of a run, with their theoretical bounds.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/checks/observations.hpp"

namespace canhil::checks {

/// A message of the bus's DBC (on CAN FD a container) with its longest response (see WireResponse) and its
/// bound. The bound is the worst case of the response, by response-time analysis. The analysis assumes the
/// queue order of the bus and includes all messages that were observed. For each message it assumes the
/// observed rate or, if that is higher, the rate in the DBC. Response and bound count from the queueing of
/// the frame, so they contain neither the bench's lateness nor the target's computing time.
struct WireBound {
  std::string_view message{};
  bool of_target = false;  ///< sent by the target: `longest_ns` is a lower bound
  std::uint64_t count = 0;
  std::int64_t longest_ns = 0;
  std::int64_t frame_ns = 0;               ///< the longest time that one frame of this message occupies the
                                           ///< wire
  std::optional<std::int64_t> bound_ns{};  ///< none: the analysis finds no bound
};

/// The bounds sorted by priority. Empty if the bit rate of the bus is unknown.
std::vector<WireBound> wire_bounds(const Observations& seen);

/// Why bounds are not valid for this run; empty: they are valid.
std::string no_bounds(const Observations& seen);

}  // namespace canhil::checks
