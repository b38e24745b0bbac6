// Ctrl-C, SIGTERM and a closed terminal end a command cleanly.
#pragma once

#include <atomic>
#include <csignal>

namespace canhil::commands {

/// Set to true by SIGINT, SIGTERM and SIGHUP after catch_interrupts() has been called.
inline std::atomic<bool> interrupted = false;

inline void catch_interrupts() {
  const auto handler = [](int) { interrupted = true; };
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, handler);
}

}  // namespace canhil::commands
