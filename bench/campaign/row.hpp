// Writes a run as a row of the results file, and reads and validates such a row.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "bench/campaign/series.hpp"

namespace SQLite {
class Statement;
}

namespace canhil::campaign {

/// Identifies a run of a variant; `variant` is the index in Campaign::variants.
struct Key {
  std::size_t variant = 0;
  std::uint64_t run = 0;
  friend auto operator<=>(const Key&, const Key&) = default;  // NOLINT(modernize-use-nullptr): false positive
};
struct Finished {
  std::size_t variant = 0;
  RunSeries series;
};
/// The id of a run's row if each variant has `runs` runs. The id does not depend on the shard that flew the
/// run.
std::int64_t row_id(const Key& key, std::uint64_t runs);

/// FNV-1a over a sequence of integers and texts. The length of a text is hashed before the text.
class Digest {
 public:
  Digest& add(std::int64_t value);
  Digest& add(std::string_view text);
  /// The digest in SQLite's integer type.
  [[nodiscard]] std::int64_t value() const;

 private:
  std::string bytes_;
};

/// The columns of the table of runs: row_schema is for `create table`, row_columns for `select`. The column
/// named `columns` lists the quantities of the samples, in their order; `judged` is RunSeries::judged.
inline constexpr std::string_view row_schema =
    "id integer primary key, variant integer, run integer, ending integer, end_us integer, detail text, "
    "columns text, samples blob, judged text, hash integer";
inline constexpr std::string_view row_columns =
    "id, variant, run, ending, end_us, detail, columns, samples, judged, hash";
inline constexpr std::string_view row_places = "?, ?, ?, ?, ?, ?, ?, ?, ?, ?";
inline constexpr std::string_view key_columns = "id, variant, run";

/// Binds the columns of a row.
void bind_row(SQLite::Statement& statement, std::uint64_t runs, const Finished& finished);
/// The key of the current row of a statement that selects key_columns or row_columns. Throws Unfit if the row
/// is not valid: then the file was damaged.
Key key_of(const SQLite::Statement& row, std::uint64_t runs);
/// The run in the current row of a statement that selects row_columns. Throws Unfit if the row was changed
/// since it was written.
Finished read_row(const SQLite::Statement& row, std::uint64_t runs);

}  // namespace canhil::campaign
