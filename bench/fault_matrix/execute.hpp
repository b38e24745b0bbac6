// Flies a matrix of faults, or one shard of it, on all cores. What comes out depends on the plan alone, never
// on threads, shards or interruptions.
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
  std::string target{};          ///< a program to fly against, in lockstep; empty: a Device in this process
  std::filesystem::path folder;  ///< where the scenarios of violations go
  unsigned threads = 0;          ///< 0: as many as there are cores
  std::function<Result<void>(Finished)> finished;  ///< takes a cell; one call at a time
};

/// "hil-bench run FILE --bus in-process": what flies a kept violation again.
std::string replay_command(const std::string& file, const std::string& target);

/// Flies these cells. Error: one line; a flight could not take place. `stop` ends it early, in good order.
Result<void> execute(const Plan& plan, const std::set<std::size_t>& cells, const Options& options,
                     const std::atomic<bool>& stop);

}  // namespace canhil::fault_matrix
