// What a user recorded, as numbers by the names of its columns. Whatever turns a recording of another kind
// into a Table (a log of somebody else's DBC with a mapping of its signals) can be flown as a CSV file is.
//
// A CSV file has a first line of names, and then a row of numbers a line, separated by commas. A name ends in
// its unit, as keys of a scenario do, and any unit of the quantity will do: roll_deg, roll_rad or roll_mrad.
// Columns that nobody asks for may hold anything.
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
  std::string file;                ///< as messages name it
  std::vector<std::string> asked;  ///< names, each in the unit in which its values are here
  std::vector<std::string> found;  ///< the column's own name, for each; empty: there is none
  std::vector<double> values;      ///< row by row, one for each name; 0 where there is no column
  std::vector<std::size_t> lines;  ///< of the file, for each row

  [[nodiscard]] std::size_t rows() const { return lines.size(); }
  [[nodiscard]] bool has(std::size_t index) const { return !found[index].empty(); }
  [[nodiscard]] double value(std::size_t row, std::size_t index) const {
    return values[row * asked.size() + index];
  }
  /// "flight.csv:17: column 'roll_rad': WHAT".
  [[nodiscard]] Error about(std::size_t row, std::size_t index, std::string_view what) const;
  /// "flight.csv:1: column 'roll_deg': is missing, expected it, or 'roll_rad' ...".
  [[nodiscard]] Error missing(std::size_t index) const;
};

/// Reads a CSV text. Error: one line with file, line and column.
Result<Table> read_table(std::string_view text, std::string_view file, std::span<const std::string> names);

/// Times of rows [us] after `from_us`, of a column in s. Error: they do not ascend.
Result<std::vector<std::int64_t>> times_of(const Table& table, std::size_t index, std::int64_t from_us);

/// Rows of a table, one after the other.
struct Rows {
  std::size_t first = 0, last = 0;
};

/// The rows from the last one at or before 0 to the first one at or after end_us. Error: there is no such
/// one, or from one of them to the next it is longer than gap_us.
Result<Rows> covering(const Table& table, std::size_t index, std::span<const std::int64_t> t_us,
                      std::int64_t end_us, std::int64_t gap_us);

/// The middle one of the times from one of these to the next; they are two at least.
std::int64_t median_step(std::span<const std::int64_t> ascending);

/// At most so much is read of a recording.
inline constexpr std::size_t most_recorded_bytes = std::size_t{1} << 30U;

}  // namespace canhil::scenario
