// A matrix of faults: a column for each scenario of a campaign, and a row for each fault. Each scenario is
// flown with each fault that fits it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bench/scenario/scenario.hpp"
#include "bench/scenario/setting.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::campaign::matrix {

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
  std::string name;
  std::string file;                           ///< as the campaign names it
  std::string folder{};                       ///< of the file
  std::string text;                           ///< of the file
  std::vector<scenario::Setting> settings{};  ///< values that replace those of the file
  std::vector<std::string> checks{};          ///< besides those of the matrix, as inline tables
  scenario::Scenario scenario;                ///< as read, with the faults and checks of the file
};

/// A fault that is flown in each scenario to which it applies.
struct Row {
  std::string fault;   ///< a kind of fault, or the name of a fault in a set
  std::string node{};  ///< the affected node; empty: the bus, or what the fault in the set states

  [[nodiscard]] std::string name() const { return node.empty() ? fault : fault + " " + node; }
};

/// A fault that fits a scenario.
struct Cell {
  std::size_t row = 0, column = 0;
};

/// A row of drawn faults: a kind of fault and the affected node. An empty `node` means the bus.
struct Drawn {
  std::string_view kind, node{};
  bool operator==(const Drawn&) const = default;
};

struct Matrix {
  std::uint64_t seed = 1;  ///< of the faults that are drawn
  std::vector<Column> columns{};
  std::vector<Row> rows{};                    ///< the first row is "no fault"
  std::vector<Cell> cells{};                  ///< ordered by row, then by column
  std::vector<std::vector<FaultText>> set{};  ///< the faults of each row; empty: they are drawn
  std::vector<std::vector<Drawn>> drawn{};    ///< the rows that fit each column, if they are drawn

  /// The faults of a run of a cell; they depend on nothing else.
  [[nodiscard]] std::vector<FaultText> faults_of(const Cell& cell, std::uint64_t run) const;
};

/// A row for each kind of fault (drawn.hpp) on each node of the bus, with parameters drawn from the seed, and
/// a row in which each flight has three faults at once. Error, one line: a column cannot have faults.
Result<Matrix> drawn_matrix(std::vector<Column> columns, std::uint64_t seed);

/// The faults of a file with the text `set`: each [[fault]] table is a row; the faults with the same
/// `together` share a row. Returns an Error of one line if a row fits no scenario.
Result<Matrix> matrix_of(std::vector<Column> columns, std::string_view set, const std::string& set_file);

/// The scenario of a flight, with the checks of the matrix (response.hpp). If `duration_us` is 0, the flight
/// has the duration in the scenario file. The seed is that of the column plus `run`. Returns an Error of one
/// line if the faults do not fit.
Result<scenario::Scenario> scenario_of(const Column& column, std::uint64_t run,
                                       const std::vector<FaultText>& faults, std::int64_t duration_us = 0);

/// The scenario of a flight as text. A file with this text is self-contained, so it may be in any folder. The
/// scenario in the text has only the check with this name, or, if that is a check of the campaign, all checks
/// of the campaign. `comment`: its first lines.
std::string text_of(const Column& column, std::uint64_t run, const std::vector<FaultText>& faults,
                    std::int64_t duration_us, const std::string& check, const std::string& comment);

}  // namespace canhil::campaign::matrix
