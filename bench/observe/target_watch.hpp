// Watches the target for the loops that drive a run: whether it is present, whether it gave up, and whether
// it has finished a step of virtual time.
#pragma once

#include <optional>
#include <string>

#include "bench/observe/observer.hpp"

namespace canhil::observe {

class TargetWatch : public Observer {
 public:
  /// Whether any frame of the target arrived since the last call.
  virtual bool heard() = 0;
  /// Why the run is over; none: the run goes on.
  [[nodiscard]] virtual std::optional<std::string> fault() const = 0;
  /// Whether a frame that is about to be sent closes a step; the watch then waits for the end of that step.
  virtual bool closes_step(const Frame& frame) = 0;
  /// Whether the awaited step is done.
  [[nodiscard]] virtual bool step_done() const = 0;
  /// The awaited step, as text for messages: "step 17".
  [[nodiscard]] virtual std::string step() const = 0;
};

}  // namespace canhil::observe
