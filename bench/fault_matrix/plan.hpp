// The plan of `hil-bench faults`: a matrix with a column for each scenario and a row for each fault. Each
// scenario is flown with each fault that fits it, in one or several runs.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bench/scenario/scenario.hpp"
#include "bench/scenario/setting.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::fault_matrix {

/// A [[fault]] table as text: its keys, each with its TOML value.
struct FaultText {
  std::vector<scenario::Setting> keys{};

  /// The value of a key; null if the key is absent.
  [[nodiscard]] const scenario::Setting* find(std::string_view key) const;
  void set(std::string_view key, std::string value);
  /// The fault as an inline table, for example "{ kind = "lost", ... }".
  [[nodiscard]] std::string in_line() const;
};
bool operator==(const FaultText& a, const FaultText& b);

/// A scenario of the matrix. The faults and checks in its file are ignored.
struct Column {
  std::string file;
  std::string text;             ///< text of the file
  scenario::Scenario scenario;  ///< as read, with the faults and checks of the file
};
Result<Column> read_column(const std::string& file);

/// A fault that is flown in each scenario to which it applies.
struct Row {
  std::string fault;   ///< a kind of fault, or the name of a fault in a set
  std::string node{};  ///< the affected node; empty: the bus, or what the fault in the set states

  [[nodiscard]] std::string name() const { return node.empty() ? fault : fault + " " + node; }
};

/// A flight: its scenario with exactly these faults.
struct Cell {
  std::size_t row = 0, column = 0;
  std::uint64_t run = 0;  ///< number of the run; added to the scenario's seed
  std::vector<FaultText> faults{};
};

struct Plan {
  std::uint64_t seed = 0;
  std::uint64_t runs = 1;
  std::uint64_t set_hash = 0;  ///< hash of the set's text; 0: the generated set
  std::vector<Column> columns{};
  std::vector<Row> rows{};    ///< the first row is "no fault"
  std::vector<Cell> cells{};  ///< ordered by row, then by column, then by run
};

/// The generated set of faults: a row for each kind of fault (drawn.hpp) on each node of the bus, with
/// parameters drawn from the seed, and a row in which each flight has three faults at once.
Plan made_plan(std::vector<Column> columns, std::uint64_t seed, std::uint64_t runs);

/// The set of faults in a file: each [[fault]] table is a row; the faults with the same `together` share a
/// row. Returns an Error of one line if a row fits no scenario.
Result<Plan> plan_of(std::vector<Column> columns, const std::string& set_file, std::uint64_t seed,
                     std::uint64_t runs);

/// The scenario of a flight, with the checks of the matrix (response.hpp). If `duration_us` is 0, the flight
/// has the duration in the scenario file. Returns an Error of one line if the faults do not fit.
Result<scenario::Scenario> scenario_of(const Column& column, std::uint64_t run,
                                       const std::vector<FaultText>& faults, std::int64_t duration_us = 0);

/// The scenario of a flight as text. A file with this text is self-contained, so it may be in any folder. The
/// scenario in the text has only the check `check`.
std::string text_of(const Column& column, std::uint64_t run, const std::vector<FaultText>& faults,
                    std::int64_t duration_us, const std::string& check, const std::string& comment);

/// Returns a TOML text without the arrays of tables that `names` lists, and without the comments of these
/// tables.
std::string without_tables(const std::string& text, const std::vector<std::string>& names);

}  // namespace canhil::fault_matrix
