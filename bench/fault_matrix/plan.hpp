// What `hil-bench faults` flies: scenarios beside one another, faults below one another, a cell for each pair
// that fits, some runs a cell.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bench/scenario/scenario.hpp"
#include "bench/scenario/setting.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::fault_matrix {

/// A [[fault]] as a file has it: its keys, each with its value as TOML text.
struct FaultText {
  std::vector<scenario::Setting> keys{};

  /// The value of a key; null: it is not there.
  [[nodiscard]] const scenario::Setting* find(std::string_view key) const;
  void set(std::string_view key, std::string value);
  /// "{ kind = "lost", ... }".
  [[nodiscard]] std::string in_line() const;
};
bool operator==(const FaultText& a, const FaultText& b);

/// A scenario. Its own faults and checks are left out.
struct Column {
  std::string file;
  std::string text;             ///< of the file
  scenario::Scenario scenario;  ///< of it, as it stands there
};
Result<Column> read_column(const std::string& file);

/// A fault that is flown in each scenario that it fits.
struct Row {
  std::string fault;   ///< a kind, or its name in a set
  std::string node{};  ///< that it befalls; empty: the bus, or whatever a set says

  [[nodiscard]] std::string name() const { return node.empty() ? fault : fault + " " + node; }
};

/// A flight: its scenario with these faults and no others.
struct Cell {
  std::size_t row = 0, column = 0;
  std::uint64_t run = 0;  ///< flown with the scenario's seed and that much more
  std::vector<FaultText> faults{};
};

struct Plan {
  std::uint64_t seed = 0;
  std::uint64_t runs = 1;
  std::uint64_t set_hash = 0;  ///< of the text of a set; 0: the set that is made of the scenarios
  std::vector<Column> columns{};
  std::vector<Row> rows{};    ///< the first is "no fault"
  std::vector<Cell> cells{};  ///< row by row, then column by column, then run by run
};

/// The set that is made of the scenarios: each kind of fault (drawn.hpp) on each node that is on the bus,
/// what else it is drawn from the seed; and three of them at once.
Plan made_plan(std::vector<Column> columns, std::uint64_t seed, std::uint64_t runs);

/// That of a file: each [[fault]] is a row; those with the same `together` are one. Error: one line; one of
/// them fits no scenario.
Result<Plan> plan_of(std::vector<Column> columns, const std::string& set_file, std::uint64_t seed,
                     std::uint64_t runs);

/// The scenario of a flight, judged by the checks of the matrix (response.hpp). `duration_us`: 0: as the file
/// says. Error: one line; the faults do not fit.
Result<scenario::Scenario> scenario_of(const Column& column, std::uint64_t run,
                                       const std::vector<FaultText>& faults, std::int64_t duration_us = 0);

/// The same as a file of its own, wherever it lies, with one check alone.
std::string text_of(const Column& column, std::uint64_t run, const std::vector<FaultText>& faults,
                    std::int64_t duration_us, const std::string& check, const std::string& comment);

/// A TOML text without the arrays of tables of these names, comments and all.
std::string without_tables(const std::string& text, const std::vector<std::string>& names);

}  // namespace canhil::fault_matrix
