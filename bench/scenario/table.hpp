// A recording as numbers by column name. To accept another format (such as a log with a mapping of its
// signals), convert it to a Table. The first line of a CSV file contains the names; each further line is a
// row of numbers, separated by commas. A name has its unit as suffix, like the keys of a scenario. Any unit
// of the quantity is accepted: roll_deg, roll_rad or roll_mrad. Columns that are not requested may contain
// anything.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dbc/wire/result.hpp"

namespace canhil::scenario {

struct Table {
  std::string file;                ///< its name in messages
  std::vector<std::string> asked;  ///< requested names, each with the unit of the values here
  std::vector<std::string> found;  ///< for each requested name, the column's name in the file; empty: absent
  std::vector<double> values;      ///< row by row, one value for each requested name; 0 for an absent column
  std::vector<std::size_t> lines;  ///< for each row, its line in the file

  [[nodiscard]] std::size_t rows() const { return lines.size(); }
  [[nodiscard]] bool has(std::size_t index) const { return !found[index].empty(); }
  [[nodiscard]] double value(std::size_t row, std::size_t index) const {
    return values[row * asked.size() + index];
  }
  /// "flight.csv:17: column 'roll_rad': WHAT".
  [[nodiscard]] Error about(std::size_t row, std::size_t index, std::string_view what) const;
  /// Returns an error such as "flight.csv:1: column 'roll_deg': is missing, expected it, or 'roll_rad' ...".
  [[nodiscard]] Error missing(std::size_t index) const;
};

/// Reads a CSV text. An error is one line with file, line and column.
Result<Table> read_table(std::string_view text, std::string_view file, std::span<const std::string> names);

/// The times of the rows [us], relative to `from_us`. The column `index` contains these times in s. It is an
/// error if the times do not ascend.
Result<std::vector<std::int64_t>> times_of(const Table& table, std::size_t index, std::int64_t from_us);

/// A contiguous range of a table's rows.
struct Rows {
  std::size_t first = 0, last = 0;
};

/// The rows from the last row at or before time 0 to the first row at or after end_us. It is an error if one
/// of these two rows does not exist, or if a gap between rows exceeds gap_us.
Result<Rows> covering(const Table& table, std::size_t index, std::span<const std::int64_t> t_us,
                      std::int64_t end_us, std::int64_t gap_us);

/// The median of the differences between successive times; needs at least two times.
std::int64_t median_step(std::span<const std::int64_t> ascending);

/// Size limit of a recording.
inline constexpr std::size_t most_recorded_bytes = std::size_t{1} << 30U;

}  // namespace canhil::scenario
