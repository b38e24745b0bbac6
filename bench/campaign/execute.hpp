// Flies a campaign, or one shard of it, on all cores. Results depend on (campaign, variant, run) alone, not
// on threads, shards or interruptions.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>

#include "bench/campaign/campaign.hpp"
#include "bench/campaign/store.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::campaign {

/// A shard contains each `count`-th run from number `index` on. A run has the number row_id().
struct Shard {
  std::uint64_t index = 0;
  std::uint64_t count = 1;
};

/// Parses "i/N" with 0 <= i < N.
Result<Shard> parse_shard(const std::string& text);
/// The shard of this task in a Slurm job array, from SLURM_ARRAY_TASK_ID, _COUNT, _MIN and _STEP. Outside of
/// an array, the shard contains all runs.
Result<Shard> shard_of_environment();

/// Progress of a campaign.
struct Progress {
  std::size_t done = 0;    ///< runs done in this call
  std::size_t stored = 0;  ///< runs stored before this call
  std::size_t total = 0;
};

struct Options {
  std::filesystem::path file;  ///< the results file
  Shard shard;
  unsigned threads = 0;  ///< number of threads; 0: one per core
  bool resume = false;   ///< continue an existing file
  std::string
      target{};  ///< a program to fly against, over a bus in lockstep; empty: a Device in this process
  /// After each commit, `committed` is called with the runs of this commit, and then `progress` is called.
  /// Both are always called from the same thread.
  std::function<void(std::span<const Finished>)> committed = [](std::span<const Finished>) {};
  std::function<void(const Progress&)> progress = [](const Progress&) {};
  /// If a run cannot be flown, for example because the target does not answer, this function is called before
  /// execute() returns the error. It is not called for errors of the campaign or of its results file.
  std::function<void(const Error&)> not_flown = [](const Error&) {};
};

enum class Execution : std::uint8_t { complete, interrupted };

/// Flies the runs that the file does not contain yet; every finished run is committed within half a second.
/// If `stop` is set, the execution ends early and cleanly. An Error has one line; runs that were committed
/// before the error are kept.
Result<Execution> execute(const Campaign& campaign, const Options& options, const std::atomic<bool>& stop);

}  // namespace canhil::campaign
