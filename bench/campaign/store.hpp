// Results of a campaign in one SQLite file: one row for each run of each variant, committed as runs finish.
// Shards and merged files have the same format. Every file contains the texts of the campaign.
#pragma once

#include <SQLiteCpp/Database.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/campaign/campaign.hpp"
#include "bench/campaign/row.hpp"
#include "bench/campaign/series.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::campaign {

/// Results can be merged only if their identities are equal.
struct Identity {
  std::uint64_t campaign_hash = 0;
  std::uint64_t dbc_hash = 0;
  Rounding rounding = Rounding::as_on_the_bus;
  std::string program;   ///< version and hash of the program that flew the campaign
  std::string target{};  ///< the target's command with its files' hashes; empty: the bench's own Device
  std::uint64_t runs = 0;
  friend bool operator==(const Identity&, const Identity&) = default;
};
/// The identity of the results that this program would compute for a campaign. `target`: see Options::target.
Identity identity_of(const Campaign& campaign, const std::string& target = {});

/// One line that states how the identity of a store differs from the expected identity; empty if both are
/// equal.
std::string difference(const Identity& found, const Identity& expected);

class Store {
 public:
  /// Creates a file. Returns an Error if the file exists or cannot be written.
  static Result<Store> create(const std::filesystem::path& path, const Identity& identity,
                              const Sources& sources);
  /// Opens a file to add runs, or creates the file. Returns an Error if the identity of the file differs, or
  /// if the file is damaged, in use or not writable.
  static Result<Store> resume(const std::filesystem::path& path, const Identity& identity,
                              const Sources& sources);
  /// Opens a file for reading only. Returns an Error if the file is not readable or is damaged.
  static Result<Store> open(const std::filesystem::path& path);

  [[nodiscard]] const Identity& identity() const { return identity_; }
  [[nodiscard]] const Sources& sources() const { return sources_; }
  /// The keys of the stored runs, ascending. keys() and load() fail if a row was changed since it was
  /// written.
  [[nodiscard]] Result<std::vector<Key>> keys() const;
  /// All series of a variant, in order of runs.
  [[nodiscard]] Result<std::vector<RunSeries>> load(std::size_t variant) const;
  [[nodiscard]] Result<RunSeries> load(const Key& key) const;

  /// Commits either all of these runs or, in case of an Error, none.
  Result<void> add(std::span<const Finished> runs);
  /// Writes everything to the disk and closes the file.
  void close();

 private:
  explicit Store(SQLite::Database database) : database_(std::move(database)) {}
  void initialise(const Identity& identity, const Sources& sources);
  void read_identity();

  SQLite::Database database_;
  Identity identity_;
  Sources sources_;
};

}  // namespace canhil::campaign
