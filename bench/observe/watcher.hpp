// Who makes observations of a run's frames.
#pragma once

#include "bench/checks/observations.hpp"
#include "bench/observe/observer.hpp"

namespace canhil::observe {

class Watcher : public Observer {
 public:
  /// The target was started again: its counters and counts begin anew.
  virtual void target_restarted() {}
  /// What was seen so far.
  [[nodiscard]] virtual const checks::Observations& observations() const = 0;
  /// The run is over: all that was seen.
  virtual checks::Observations finish() = 0;
};

}  // namespace canhil::observe
