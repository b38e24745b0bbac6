// Displays that show a flight while it happens: a page or a terminal.
#pragma once

#include <chrono>

#include "bench/live/snapshot.hpp"

namespace canhil::live {

class Display {
 public:
  Display() = default;
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;
  virtual ~Display() = default;

  virtual void show(const Snapshot& snapshot) = 0;
  /// Serves the viewers for about `time`: exchanges data with browsers, or reads keys.
  virtual void run_for(std::chrono::milliseconds time) = 0;
  /// Whether all output has reached the viewers.
  [[nodiscard]] virtual bool settled() const { return true; }
};

}  // namespace canhil::live
