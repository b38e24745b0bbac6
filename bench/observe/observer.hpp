// Who looks on while a run goes by.
#pragma once

#include <cstdint>

#include "dbc/ports/port.hpp"

namespace canhil::observe {

/// Sees every frame of a run. Times are of the port's stamp clock [ns].
class Observer {
 public:
  Observer() = default;
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;
  virtual ~Observer() = default;
  /// The bench handed a frame to the bus. `late_ns`: after its deadline; 0 where there was none.
  virtual void transmitted(const Frame& /*frame*/, std::int64_t /*t_ns*/, std::int64_t /*late_ns*/) {}
  /// A frame came from the bus; `received.own`: the echo of one of ours, with its transmit stamp.
  virtual void received(const Received& /*received*/) {}
  /// A frame came that is not of this bus's format: no part of the run.
  virtual void foreign(const Received& /*received*/) {}
  /// The time of a run in virtual time, as it goes on [ns].
  virtual void time_told(std::int64_t /*t_ns*/) {}
  /// The interface went down or was removed, or is back.
  virtual void interface_changed(bool /*up*/, std::int64_t /*t_ns*/) {}
};

}  // namespace canhil::observe
