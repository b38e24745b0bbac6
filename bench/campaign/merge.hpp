// Shards to one file, whose bytes depend on the results alone.
#pragma once

#include <filesystem>
#include <span>

#include "dbc/wire/result.hpp"

namespace canhil::campaign {

/// Writes all runs of the shards `files`, in order of variant and run, to a new file that then takes the name
/// `out`. Error, one line, and `out` is untouched: shards of different campaigns, DBCs or programs, runs that
/// are in no shard, or differ between two, or `out` is something else than results of this campaign.
Result<void> merge(const std::filesystem::path& out, std::span<const std::filesystem::path> files);

}  // namespace canhil::campaign
