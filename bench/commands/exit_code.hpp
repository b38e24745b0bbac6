// The exit codes of the bench's programs.
#pragma once

#include <cstdio>

#include "bench/checks/verdict.hpp"
#include "dbc/command_line/command_line.hpp"
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

/// Reports an error on stderr in one line.
inline ExitCode complain(const Error& error) {
  std::fprintf(stderr, "hil-bench: %s\n", command_line::one_line(error.message).c_str());
  return ExitCode::usage;
}

}  // namespace canhil::commands
