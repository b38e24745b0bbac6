#include "bench/campaign/merge.hpp"

#include <fmt/format.h>

#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <system_error>

#include "bench/campaign/store.hpp"
#include "dbc/files/output_file.hpp"

namespace canhil::campaign {
namespace {

struct Shards {
  std::vector<Store> stores;
  std::vector<std::string> names;
  std::map<Key, std::vector<std::size_t>> holders;  ///< for each run: indices of stores that contain it
};

/// Returns an Error if a file is given twice, possibly under two names, because another file has then
/// probably been forgotten.
Result<void> check_distinct(std::span<const std::filesystem::path> files) {
  std::error_code ignored;  // a missing file is reported when it is opened
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!std::filesystem::equivalent(files[k], files[i], ignored)) continue;
      return failure(fmt::format("{}: is given twice, expected each shard once", files[i].string()));
    }
  }
  return {};
}

Result<Shards> open_all(std::span<const std::filesystem::path> files) {
  Shards shards;
  if (auto distinct = check_distinct(files); !distinct) return tl::unexpected(distinct.error());
  for (const std::filesystem::path& file : files) {
    auto store = Store::open(file);
    if (!store) return tl::unexpected(store.error());
    if (!shards.stores.empty()) {
      if (const auto what = difference(store->identity(), shards.stores[0].identity()); !what.empty()) {
        return failure(fmt::format("{}: {} as {}", file.string(), what, shards.names[0]));
      }
    }
    const auto keys = store->keys();
    if (!keys) return tl::unexpected(keys.error());
    for (const Key& key : *keys) shards.holders[key].push_back(shards.stores.size());
    shards.stores.push_back(std::move(*store));
    shards.names.push_back(file.string());
  }
  return shards;
}

/// Returns an Error if some runs are missing.
Result<void> check_complete(const Shards& shards, const Campaign& campaign) {
  const std::uint64_t runs = shards.stores[0].identity().runs;
  const std::size_t total = campaign.variants.size() * runs;
  if (shards.holders.size() == total) return {};
  for (std::size_t variant = 0; variant < campaign.variants.size(); ++variant) {
    for (std::uint64_t run = 0; run < runs; ++run) {
      if (shards.holders.contains({variant, run})) continue;
      return failure(
          fmt::format("{} of {} runs are in no shard (first: run {} of variant '{}'), expected all",
                      total - shards.holders.size(), total, run, campaign.variants[variant].name));
    }
  }
  return failure("shards hold runs that are not of the campaign");
}

bool same(const RunSeries& a, const RunSeries& b) {
  return a.ending.kind == b.ending.kind && a.ending.t_us == b.ending.t_us &&
         a.ending.detail == b.ending.detail && encode(a.samples) == encode(b.samples);
}

Result<Finished> take(const Shards& shards, const Key& key) {
  std::optional<RunSeries> first;
  const std::vector<std::size_t>& holders = shards.holders.at(key);
  for (const std::size_t holder : holders) {
    auto series = shards.stores[holder].load(key);
    if (!series) return tl::unexpected(series.error());
    if (!first) {
      first = std::move(*series);
    } else if (!same(*first, *series)) {
      return failure(fmt::format("{}: run {} of variant {} differs from that in {}, expected the same",
                                 shards.names[holder], key.run, key.variant, shards.names[holders[0]]));
    }
  }
  return Finished{.variant = key.variant, .series = std::move(*first)};
}

/// Writes each variant in exactly one transaction, because the bytes of the file depend on the transactions.
Result<void> write(const std::filesystem::path& file, const Shards& shards, const Campaign& campaign) {
  const Identity& identity = shards.stores[0].identity();
  auto merged = Store::resume(file, identity, shards.stores[0].sources());
  if (!merged) return tl::unexpected(merged.error());
  for (std::size_t variant = 0; variant < campaign.variants.size(); ++variant) {
    std::vector<Finished> runs;
    for (std::uint64_t run = 0; run < identity.runs; ++run) {
      auto finished = take(shards, {variant, run});
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
  const auto shards = open_all(files);
  if (!shards) return tl::unexpected(shards.error());
  if (shards->stores.empty()) return failure("no shard to merge, expected at least one");
  if (auto free = check_replaceable(out, shards->stores[0].identity()); !free) return free;
  const auto campaign = parse_campaign(shards->stores[0].sources());
  if (!campaign) return tl::unexpected(campaign.error());
  if (auto complete = check_complete(*shards, *campaign); !complete) return complete;

  auto file = OutputFile::create(out.string());
  if (!file) return tl::unexpected(file.error());
  if (auto written = write(file->temporary_name(), *shards, *campaign); !written) {
    std::error_code ignored;
    std::filesystem::remove(file->temporary_name() + "-journal", ignored);
    return written;
  }
  const int error = file->give_name(out.string());
  if (error == 0) return {};
  return failure(fmt::format("{}: cannot be written: {}", out.string(), std::strerror(error)));
}

}  // namespace canhil::campaign
