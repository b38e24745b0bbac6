// The exit codes of the bench's programs.
#pragma once

#include <cstdio>
#include <string>

#include "bench/checks/verdict.hpp"
#include "dbc/text/escape.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::commands {

enum class ExitCode : int { pass = 0, fail = 1, usage = 2, not_measured = 3 };

constexpr ExitCode exit_code(checks::Outcome outcome) {
  return outcome == checks::Outcome::pass   ? ExitCode::pass
         : outcome == checks::Outcome::fail ? ExitCode::fail
                                            : ExitCode::not_measured;
}

/// The outcome for an exit code. After a usage error the outcome is not_measured, because nothing ran.
constexpr checks::Outcome outcome_of(ExitCode code) {
  return code == ExitCode::pass   ? checks::Outcome::pass
         : code == ExitCode::fail ? checks::Outcome::fail
                                  : checks::Outcome::not_measured;
}

/// Writes a line to stderr, with the name of the program.
inline void say(const std::string& line) { std::fprintf(stderr, "hil-bench: %s\n", one_line(line).c_str()); }

/// Reports an error on stderr in one line, and each further error in a line of its own.
inline ExitCode complain(const Error& error) {
  say(error.message);
  for (const std::string& line : error.more) say(line);
  return ExitCode::usage;
}

}  // namespace canhil::commands
