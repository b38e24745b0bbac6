#include "bench/campaign/shards.hpp"

#include <fmt/format.h>

#include <optional>
#include <system_error>

namespace canhil::campaign {
namespace {

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

bool same(const RunSeries& a, const RunSeries& b) {
  return a.ending.kind == b.ending.kind && a.ending.t_us == b.ending.t_us &&
         a.ending.detail == b.ending.detail && encode(a.samples) == encode(b.samples) && a.judged == b.judged;
}

}  // namespace

Result<Campaign> campaign_of(const Store& store) {
  auto campaign = parse_campaign(store.sources());
  if (!campaign) return campaign;
  campaign->runs = store.identity().runs;
  campaign->rounding = store.identity().rounding;
  return campaign;
}

Result<Shards> Shards::open(std::span<const std::filesystem::path> files) {
  Shards shards;
  if (files.empty()) return failure("no shard, expected at least one");
  if (auto distinct = check_distinct(files); !distinct) return tl::unexpected(distinct.error());
  for (const std::filesystem::path& file : files) {
    auto store = Store::open(file);
    if (!store) return tl::unexpected(store.error());
    if (!shards.stores_.empty()) {
      if (const auto what = difference(store->identity(), shards.first().identity()); !what.empty())
        return failure(fmt::format("{}: {} as {}", file.string(), what, shards.names_[0]));
    }
    const auto keys = store->keys();
    if (!keys) return tl::unexpected(keys.error());
    for (const Key& key : *keys) shards.holders_[key].push_back(shards.stores_.size());
    shards.stores_.push_back(std::move(*store));
    shards.names_.push_back(file.string());
  }
  auto campaign = campaign_of(shards.first());
  if (!campaign) return tl::unexpected(campaign.error());
  shards.campaign_ = std::move(*campaign);
  return shards;
}

Result<void> Shards::check_complete() const {
  const std::size_t total = campaign_.variants.size() * campaign_.runs;
  if (holders_.size() == total) return {};
  for (std::size_t variant = 0; variant < campaign_.variants.size(); ++variant) {
    for (std::uint64_t run = 0; run < campaign_.runs; ++run) {
      if (holders_.contains({variant, run})) continue;
      return failure(
          fmt::format("{} of {} runs are in no shard (first: run {} of variant '{}'), expected all",
                      total - holders_.size(), total, run, campaign_.variants[variant].name));
    }
  }
  return failure("shards hold runs that are not of the campaign");
}

Result<Finished> Shards::load(const Key& key) const {
  std::optional<RunSeries> first;
  const std::vector<std::size_t>& holders = holders_.at(key);
  for (const std::size_t holder : holders) {
    auto series = stores_[holder].load(key);
    if (!series) return tl::unexpected(series.error());
    if (!first) {
      first = std::move(*series);
    } else if (!same(*first, *series)) {
      return failure(fmt::format("{}: run {} of variant {} differs from that in {}, expected the same",
                                 names_[holder], key.run, key.variant, names_[holders[0]]));
    }
  }
  return Finished{.variant = key.variant, .series = std::move(*first)};
}

Result<std::vector<RunSeries>> Shards::load(std::size_t variant) const {
  if (stores_.size() == 1) return first().load(variant);
  std::vector<RunSeries> runs;
  const auto end = holders_.lower_bound({.variant = variant + 1});
  for (auto one = holders_.lower_bound({.variant = variant}); one != end; ++one) {
    auto finished = load(one->first);
    if (!finished) return tl::unexpected(finished.error());
    runs.push_back(std::move(finished->series));
  }
  return runs;
}

}  // namespace canhil::campaign
