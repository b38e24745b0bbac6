// The programs of the bench that hil-bench goes on as: who flies single runs need not build campaigns with
// their statistics, nor who flies campaigns the papers.
#pragma once

#include <string>
#include <vector>

namespace canhil::commands {

/// Replaces this process by a program beside it, with these words for its command line (without its name).
/// Returns only where that cannot be started: the exit code, after one line that says why.
int become(const std::string& program, std::vector<std::string> words);

}  // namespace canhil::commands
