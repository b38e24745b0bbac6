// Ctrl-C, SIGTERM and a closed terminal end a command cleanly.
#pragma once

#include <atomic>
#include <csignal>
#include <string>

#include "bench/commands/exit_code.hpp"

namespace canhil::commands {

/// Set to true by SIGINT, SIGTERM and SIGHUP after catch_interrupts() has been called.
inline std::atomic<bool> interrupted = false;

inline void catch_interrupts() {
  const auto handler = [](int) { interrupted = true; };
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, handler);
}

/// The exit code of an interrupted command; `how_to_go_on`: a remark for the user, or empty.
inline ExitCode end_interrupted(const std::string& how_to_go_on = "") {
  say("interrupted" + how_to_go_on);
  return ExitCode::not_measured;
}

/// Reports an error that ended a command. If the command was interrupted, this is the reason.
inline ExitCode end_with(const Error& error) { return interrupted ? end_interrupted() : complain(error); }

}  // namespace canhil::commands
