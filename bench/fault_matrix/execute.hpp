// Flies a matrix of faults, or one shard of it, on all cores. The results depend on the plan alone, not on
// threads, shards or interruptions.
#pragma once

#include <array>
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
  std::string target{};          ///< a target program, run in lockstep; empty: a Device in this process
  std::filesystem::path folder;  ///< folder in which the scenarios of violations are saved
  unsigned threads = 0;          ///< number of threads; 0: one per core
  std::function<Result<void>(Finished)> finished;  ///< receives each finished cell; calls do not overlap
};

/// The files in which a violation in a cell is saved: the minimal scenario, and the log of its flight.
std::array<std::filesystem::path, 2> files_of_violation(const std::filesystem::path& folder,
                                                        std::size_t cell);

/// The command that repeats a saved violation, for example "hil-bench run FILE --bus in-process".
std::string replay_command(const std::string& file, const std::string& target);

/// Flies the cells whose indices are in `cells`. If `stop` is set, the execution ends early and cleanly.
/// Returns an Error of one line if a flight could not be flown.
Result<void> execute(const Plan& plan, const std::set<std::size_t>& cells, const Options& options,
                     const std::atomic<bool>& stop);

}  // namespace canhil::fault_matrix
