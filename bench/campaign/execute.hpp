// Flies a campaign, or one shard of it, on all cores. What comes out depends on (campaign, variant, run)
// alone, never on threads, shards or interruptions.
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

/// The runs with run % count == index.
struct Shard {
  std::uint64_t index = 0;
  std::uint64_t count = 1;
};

/// "i/N" with 0 <= i < N.
Result<Shard> parse_shard(const std::string& text);
/// The place in a Slurm job array, from SLURM_ARRAY_TASK_ID, _COUNT, _MIN and _STEP; all runs outside one.
Result<Shard> shard_of_environment();

/// Where a campaign stands.
struct Progress {
  std::size_t done = 0;    ///< in this call
  std::size_t stored = 0;  ///< found finished
  std::size_t total = 0;
};

struct Options {
  std::filesystem::path file;  ///< where the results go
  Shard shard;
  unsigned threads = 0;  ///< 0: as many as there are cores
  bool resume = false;   ///< go on with the file if it is there
  std::string
      target{};  ///< a program to fly against, over a bus in lockstep; empty: a Device in this process
  /// Called with what was committed, then with where the campaign stands; from one thread.
  std::function<void(std::span<const Finished>)> committed = [](std::span<const Finished>) {};
  std::function<void(const Progress&)> progress = [](const Progress&) {};
};

enum class Execution : std::uint8_t { complete, interrupted };

/// Runs what the file does not hold yet; every finished run is committed within half a second. `stop` ends it
/// early, in good order. Error: one line; what was committed before remains.
Result<Execution> execute(const Campaign& campaign, const Options& options, const std::atomic<bool>& stop);

}  // namespace canhil::campaign
