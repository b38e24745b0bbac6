// Ctrl-C and a polite kill end a command in good order.
#pragma once

#include <atomic>
#include <csignal>

namespace canhil::commands {

/// Set by SIGINT and SIGTERM once catch_interrupts() was called.
inline std::atomic<bool> interrupted = false;

inline void catch_interrupts() {
  const auto handler = [](int) { interrupted = true; };
  std::signal(SIGINT, handler);
  std::signal(SIGTERM, handler);
}

}  // namespace canhil::commands
