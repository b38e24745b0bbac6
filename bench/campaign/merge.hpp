// Merges shards into one file, whose bytes depend on the results alone.
#pragma once

#include <filesystem>
#include <span>

#include "dbc/wire/result.hpp"

namespace canhil::campaign {

/// Writes all runs of the shards `files`, ordered by variant and run, to a new file that is then renamed to
/// `out`. Error, one line, and `out` is unchanged: the shards differ in campaign, DBC or program, runs are
/// missing or differ between shards, or `out` is something else than results of this campaign.
Result<void> merge(const std::filesystem::path& out, std::span<const std::filesystem::path> files);

}  // namespace canhil::campaign
