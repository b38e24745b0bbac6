// Turns the frames of a run into observations.
#pragma once

#include "bench/checks/observations.hpp"
#include "bench/observe/observer.hpp"

namespace canhil::observe {

class Watcher : public Observer {
 public:
  /// A fault restarts the target. A handshake follows, up to the next Sync; then all counters begin again.
  virtual void target_restarts() {}
  /// The observations so far.
  [[nodiscard]] virtual const checks::Observations& observations() const = 0;
  /// Must be called after the run. Returns all observations.
  virtual checks::Observations finish() = 0;
};

}  // namespace canhil::observe
