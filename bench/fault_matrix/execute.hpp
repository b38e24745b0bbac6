// Flies a matrix of faults, or one shard of it, on all cores. The results depend on the plan alone, not on
// threads, shards or interruptions.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <set>
#include <string>

#include "bench/fault_matrix/plan.hpp"
#include "bench/fault_matrix/results.hpp"

namespace canhil::fault_matrix {

struct Options {
  std::string target{};          ///< a target program, flown in lockstep; empty: a Device in this process
  std::filesystem::path folder;  ///< for the scenarios of violations
  unsigned threads = 0;          ///< 0: one per core
  std::function<Result<void>(Finished)> finished;  ///< receives each finished cell; calls do not overlap
};

/// The command that repeats a saved violation: "hil-bench run FILE --bus in-process".
std::string replay_command(const std::string& file, const std::string& target);

/// Flies these cells. Error: one line; a flight could not be flown. `stop` ends it early and cleanly.
Result<void> execute(const Plan& plan, const std::set<std::size_t>& cells, const Options& options,
                     const std::atomic<bool>& stop);

}  // namespace canhil::fault_matrix
