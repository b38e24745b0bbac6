// Sends the frames of a log to a bus again.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/checks/histogram.hpp"
#include "dbc/logs/log.hpp"
#include "dbc/ports/port.hpp"

namespace canhil::recordings {

struct ReplayOptions {
  double speed = 1;                   ///< 2 means twice as fast as recorded
  std::uint64_t loops = 1;            ///< number of repetitions; 0: repeats until stopped
  std::vector<std::uint32_t> only{};  ///< ids of the frames to send; empty: all
  /// true: sends only the frames that the recorder had sent; false: sends only the frames that the recorder
  /// had received; nullopt: sends both.
  std::optional<bool> transmitted{};
};

/// A bus, and the interface of the log whose frames it carries.
struct ReplayBus {
  Port& port;
  std::string interface {};  ///< empty: the frames of all interfaces
};

struct Replayed {
  std::uint64_t frames = 0;
  std::uint64_t loops = 0;       ///< number of repetitions that have begun
  checks::Histogram lateness{};  ///< transmission time minus deadline, for each frame
};

/// The interfaces of the frames that the options select, in the order of their first frames. Returns an error
/// of one line if the log cannot be read.
Result<std::vector<std::string>> interfaces_of(const LogFile& log, const ReplayOptions& options);

/// Sends the frames of a log to one bus or to several buses, each of which carries the frames of another
/// interface; frames of other interfaces are not sent. The time from the first frame to each other frame is
/// the time in the log, divided by the speed. The deadlines are absolute, so that lateness does not
/// accumulate. Error frames are not sent. `progress` receives the number of frames so far. Returns an error
/// of one line if the log cannot be read or has no frame to send, if the bus rejects a frame, or if the bus
/// accepts no frame for one second.
Result<Replayed> replay(const std::vector<ReplayBus>& buses, const LogFile& log, const ReplayOptions& options,
                        const std::atomic<bool>& stop, const std::function<void(std::uint64_t)>& progress);

}  // namespace canhil::recordings
