// Merges shards into one file whose bytes depend on the results alone.
#pragma once

#include <filesystem>
#include <span>

#include "dbc/wire/result.hpp"

namespace canhil::campaign {

/// Writes all runs of the shards `files`, ordered by variant and run, to a new file, and renames this file to
/// `out`. In case of an Error, `out` is unchanged. Possible errors: the identities of the shards differ; a
/// shard is given twice; runs are missing or differ between shards; `out` contains something other than
/// results of this campaign.
Result<void> merge(const std::filesystem::path& out, std::span<const std::filesystem::path> files);

}  // namespace canhil::campaign
