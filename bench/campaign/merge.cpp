#include "bench/campaign/merge.hpp"

#include <fmt/format.h>

#include <cstring>
#include <system_error>

#include "bench/campaign/shards.hpp"
#include "dbc/files/output_file.hpp"

namespace canhil::campaign {
namespace {

/// Writes each variant in exactly one transaction, because the bytes of the file depend on the transactions.
Result<void> write(const std::filesystem::path& file, const Shards& shards) {
  auto merged = Store::resume(file, shards.first().identity(), shards.first().sources());
  if (!merged) return tl::unexpected(merged.error());
  for (std::size_t variant = 0; variant < shards.campaign().variants.size(); ++variant) {
    std::vector<Finished> runs;
    for (std::uint64_t run = 0; run < shards.campaign().runs; ++run) {
      auto finished = shards.load({variant, run});
      if (!finished) return tl::unexpected(finished.error());
      runs.push_back(std::move(*finished));
    }
    if (auto added = merged->add(runs); !added) return added;
  }
  merged->close();
  return {};
}

/// Returns an Error if the file `out` exists and must not be overwritten, because it contains something other
/// than results of this campaign.
Result<void> check_replaceable(const std::filesystem::path& out, const Identity& identity) {
  if (!std::filesystem::exists(out)) return {};
  const auto old = Store::open(out);
  if (!old) return tl::unexpected(old.error());
  if (old->identity().campaign_hash == identity.campaign_hash) return {};
  return failure(fmt::format("{}: {}", out.string(), difference(old->identity(), identity)));
}

}  // namespace

Result<void> merge(const std::filesystem::path& out, std::span<const std::filesystem::path> files) {
  const auto shards = Shards::open(files);
  if (!shards) return tl::unexpected(shards.error());
  if (auto complete = shards->check_complete(); !complete) return complete;
  if (auto free = check_replaceable(out, shards->first().identity()); !free) return free;
  auto file = OutputFile::create(out.string());
  if (!file) return tl::unexpected(file.error());
  if (auto written = write(file->temporary_name(), *shards); !written) {
    std::error_code ignored;
    std::filesystem::remove(file->temporary_name() + "-journal", ignored);
    return written;
  }
  const int error = file->give_name(out.string());
  if (error == 0) return {};
  return failure(fmt::format("{}: cannot be written: {}", out.string(), std::strerror(error)));
}

}  // namespace canhil::campaign
