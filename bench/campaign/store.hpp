// Results of a campaign in one SQLite file: a row a run and variant, committed as runs finish. Shards, and
// what they are merged into, have the same form; the texts of the campaign are inside.
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

/// What results must have in common to be put together.
struct Identity {
  std::uint64_t campaign_hash = 0;
  std::uint64_t dbc_hash = 0;
  Rounding rounding = Rounding::as_on_the_bus;
  std::string program;  ///< version and hash of the program that ran it
  std::string
      target{};  ///< name and hash of the program that it was flown against; empty: a Device of its own
  std::uint64_t runs = 0;
  friend bool operator==(const Identity&, const Identity&) = default;
};
/// Of results that this program makes of a campaign. `target`: see Options.
Identity identity_of(const Campaign& campaign, const std::string& target = {});

/// One line that says in what a store's identity differs from what is expected; empty: in nothing.
std::string difference(const Identity& found, const Identity& expected);

class Store {
 public:
  /// A new file. Error: it exists, or cannot be written.
  static Result<Store> create(const std::filesystem::path& path, const Identity& identity,
                              const Sources& sources);
  /// For more runs; a new file if there is none. Error: another campaign's, in use, or not writable.
  static Result<Store> resume(const std::filesystem::path& path, const Identity& identity,
                              const Sources& sources);
  /// For reading only. Error: not readable, or damaged.
  static Result<Store> open(const std::filesystem::path& path);

  [[nodiscard]] const Identity& identity() const { return identity_; }
  [[nodiscard]] const Sources& sources() const { return sources_; }
  /// What is there, ascending. Errors of this and of load(): a row is not as it was written.
  [[nodiscard]] Result<std::vector<Key>> keys() const;
  /// All series of a variant, in order of runs.
  [[nodiscard]] Result<std::vector<RunSeries>> load(std::size_t variant) const;
  [[nodiscard]] Result<RunSeries> load(const Key& key) const;

  /// Commits runs, all or none.
  Result<void> add(std::span<const Finished> runs);
  /// Writes everything to the disk and lets go of the file.
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
