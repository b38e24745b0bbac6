// Looks out for the target while a run goes by, for the loops that drive it: whether it is there, whether it
// gave up, whether it is done with a step of virtual time.
#pragma once

#include <optional>
#include <string>

#include "bench/observe/observer.hpp"

namespace canhil::observe {

class TargetWatch : public Observer {
 public:
  /// Whether it was heard since this was last asked.
  virtual bool heard() = 0;
  /// Why the run is over; none: it is not.
  [[nodiscard]] virtual std::optional<std::string> fault() const = 0;
  /// Whether a frame that is about to be sent closes a step, whose end is then awaited.
  virtual bool closes_step(const Frame& frame) = 0;
  /// Whether the step that is awaited is done.
  [[nodiscard]] virtual bool step_done() const = 0;
  /// That step, for people: "step 17".
  [[nodiscard]] virtual std::string step() const = 0;
};

}  // namespace canhil::observe
