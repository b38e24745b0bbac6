// The interface of objects that receive the events of a run.
#pragma once

#include <cstdint>

#include "dbc/ports/port.hpp"

namespace canhil::observe {

/// Receives every frame of a run. Times are on the port's stamp clock [ns].
class Observer {
 public:
  Observer() = default;
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;
  virtual ~Observer() = default;
  /// The bench handed a frame to the bus. `late_ns`: lateness relative to the deadline of the frame; 0
  /// without a deadline.
  virtual void transmitted(const Frame& /*frame*/, std::int64_t /*t_ns*/, std::int64_t /*late_ns*/) {}
  /// A frame arrived from the bus; `received.own`: the echo of the bench's own frame, with its transmit
  /// stamp.
  virtual void received(const Received& /*received*/) {}
  /// A frame arrived in a format that this bus does not use; this frame is not part of the run.
  virtual void foreign(const Received& /*received*/) {}
  /// The current virtual time of the run [ns].
  virtual void time_set(std::int64_t /*t_ns*/) {}
  /// The interface went down or was removed, or is back.
  virtual void interface_changed(bool /*up*/, std::int64_t /*t_ns*/) {}
};

}  // namespace canhil::observe
