// Checks that are programs of the user (checks::Program).
#pragma once

#include <atomic>

#include "bench/drive/session.hpp"
#include "bench/scenario/scenario.hpp"

namespace canhil::report {

/// Asks the program of each such check of a completed run, puts its judgements in the place of the check's
/// result, and concludes the verdict anew. A program that does not answer as it should leaves its check not
/// measured, with the reason. `stop`: ends the wait.
void judge_by_programs(const scenario::Scenario& scenario, drive::Run& run, const std::atomic<bool>& stop);

}  // namespace canhil::report
