// Replays the frames of a log.
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
  double speed = 1;                   ///< factor relative to the recording
  std::uint64_t loops = 1;            ///< 0: until stopped
  std::vector<std::uint32_t> only{};  ///< ids; empty: all
  std::optional<bool> transmitted{};  ///< true: only frames that the recorder sent; false: received
};

struct Replayed {
  std::uint64_t frames = 0;
  std::uint64_t loops = 0;       ///< repetitions begun
  checks::Histogram lateness{};  ///< transmission time minus deadline, for each frame
};

/// Sends each frame at its time after the first one, by absolute deadlines, so that lateness does not
/// accumulate. Error frames are not sent. `progress` receives the number of frames so far. Error: one line;
/// the log cannot be read or has no frame to send, or the bus rejects a frame or accepts none for a second.
Result<Replayed> replay(Port& port, const std::string& log, const ReplayOptions& options,
                        const std::atomic<bool>& stop, const std::function<void(std::uint64_t)>& progress);

}  // namespace canhil::recordings
