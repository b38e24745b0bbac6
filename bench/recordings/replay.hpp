// The frames of a log, sent again.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/checks/histogram.hpp"
#include "dbc/ports/port.hpp"

namespace canhil::recordings {

struct ReplayOptions {
  double speed = 1;                   ///< times that of the recording
  std::uint64_t loops = 1;            ///< 0: until it is stopped
  std::vector<std::uint32_t> only{};  ///< ids; empty: all
  std::optional<bool> transmitted{};  ///< only what the recorder sent, or only what it received
};

struct Replayed {
  std::uint64_t frames = 0;
  std::uint64_t loops = 0;       ///< that were begun
  checks::Histogram lateness{};  ///< of each transmission after its deadline
};

/// Sends each frame at its time after the first one, by absolute deadlines, so that lateness does not add up.
/// Error frames are left out. `progress`: frames so far. Error: one line; the log cannot be read or has
/// nothing to send, the bus refuses a frame or takes none for a second.
Result<Replayed> replay(Port& port, const std::string& log, const ReplayOptions& options,
                        const std::atomic<bool>& stop, const std::function<void(std::uint64_t)>& progress);

}  // namespace canhil::recordings
