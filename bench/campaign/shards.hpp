// The results of one campaign in several files.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "bench/campaign/campaign.hpp"
#include "bench/campaign/store.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::campaign {

class Shards {
 public:
  /// Opens the files of the shards. Error, one line: a file is no results, is of another campaign than the
  /// first, or is given twice.
  static Result<Shards> open(std::span<const std::filesystem::path> files);

  [[nodiscard]] const Campaign& campaign() const { return campaign_; }
  [[nodiscard]] const Store& first() const { return stores_.front(); }
  /// A run. Error, one line: the files contain different results of it.
  [[nodiscard]] Result<Finished> load(const Key& key) const;
  /// Error, one line: runs are in none of the files.
  [[nodiscard]] Result<void> check_complete() const;
  /// The runs of a variant that the files contain, in order.
  [[nodiscard]] Result<std::vector<RunSeries>> load(std::size_t variant) const;

 private:
  std::vector<Store> stores_;
  std::vector<std::string> names_;
  std::map<Key, std::vector<std::size_t>> holders_;  // for each run: indices of stores that contain it
  Campaign campaign_;
};

/// The campaign to which stored results belong.
Result<Campaign> campaign_of(const Store& store);

}  // namespace canhil::campaign
