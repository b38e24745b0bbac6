#include "bench/campaign/matrix/matrix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "bench/campaign/matrix/drawn.hpp"
#include "bench/campaign/matrix/response.hpp"
#include "bench/drive/contract.hpp"
#include "bench/scenario/binding.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::campaign::matrix {
namespace {

using scenario::Section;
using scenario::Setting;

constexpr int at_once = 3;

Result<void> check_columns(const std::vector<Column>& columns) {
  for (const Column& column : columns) {
    if (!column.scenario.binding->handshake)
      return failure(
          fmt::format("{}: has a mapping, expected a scenario of canhil's own contract", column.file));
    if (auto read = scenario_of(column, 0, {}); !read) return tl::unexpected(read.error());
  }
  return {};
}

// Adds the cells of a row: one for each column that `fit` accepts.
template <class Fit>
void add_cells(Matrix& matrix, std::size_t row, const Fit& fit) {
  for (std::size_t column = 0; column < matrix.columns.size(); ++column) {
    if (row == 0 || fit(column)) matrix.cells.push_back({.row = row, .column = column});
  }
}

// The reason why some faults of a set do not fit a scenario; nullopt if all fit.
std::optional<Error> unfit(const Column& column, std::string_view set, const std::string& file,
                           const scenario::FaultPlaces& places) {
  scenario::Scenario scenario = column.scenario;
  scenario.faults.clear();
  const auto added = drive::add_faults(scenario, set, file, &places);
  return added ? std::nullopt : std::optional(added.error());
}

// The rows of a set, with the places of their faults in the file.
struct Set {
  std::vector<Row> rows{{.fault = std::string(no_fault)}};
  std::vector<std::vector<FaultText>> faults{{}};
  std::vector<scenario::FaultPlaces> places{{}};
};

Result<Set> read_set(std::string_view text, const std::string& file) {
  Set set;
  Section root = Section::parse(text, file);
  std::vector<Section> sections = root.tables("fault");
  for (std::size_t index = 0; index < sections.size(); ++index) {
    Section& section = sections[index];
    const std::string kind = section.text("kind");
    const std::string name = section.text("name", fmt::format("{} {}", kind, set.rows.size()));
    const std::string row = section.text("together", name);
    FaultText fault;
    for (Setting& key : section.settings()) {
      if (key.key != "together") fault.keys.push_back(std::move(key));
    }
    const auto known = std::ranges::find(set.rows, row, &Row::fault);
    const auto at = static_cast<std::size_t>(known - set.rows.begin());
    if (known == set.rows.end()) {
      set.rows.push_back({.fault = row});
      set.faults.emplace_back();
      set.places.emplace_back();
    } else if (!section.has("together")) {
      section.reject("name", fmt::format("'{}' is there twice", row), "each once");
    }
    set.faults[at].push_back(std::move(fault));
    set.places[at].push_back(index);
  }
  root.finish();
  if (const auto error = root.error()) return tl::unexpected(*error);
  return set;
}

}  // namespace

Result<Matrix> drawn_matrix(std::vector<Column> columns, std::uint64_t seed) {
  if (auto fine = check_columns(columns); !fine) return tl::unexpected(fine.error());
  Matrix matrix{.seed = seed, .columns = std::move(columns)};
  std::vector<std::string_view> nodes;
  for (const Column& column : matrix.columns) {
    for (const scenario::NodeSettings& node : column.scenario.nodes) {
      if (std::ranges::find(nodes, node.table().key) == nodes.end()) nodes.push_back(node.table().key);
    }
  }
  const std::vector<Drawn> drawn = drawn_rows(nodes);
  matrix.rows.push_back({.fault = std::string(no_fault)});
  add_cells(matrix, 0, [](std::size_t) { return true; });
  matrix.drawn.resize(matrix.columns.size());
  for (const Drawn& row : drawn) {
    matrix.rows.push_back({.fault = std::string(row.kind), .node = std::string(row.node)});
    add_cells(matrix, matrix.rows.size() - 1, [&](std::size_t column) {
      if (!fits(row, matrix.columns[column], seed)) return false;
      matrix.drawn[column].push_back(row);
      return true;
    });
  }
  matrix.rows.push_back({.fault = fmt::format("{} at once", at_once)});
  add_cells(matrix, matrix.rows.size() - 1, [](std::size_t) { return true; });
  return matrix;
}

Result<Matrix> matrix_of(std::vector<Column> columns, std::string_view set, const std::string& set_file) {
  if (auto fine = check_columns(columns); !fine) return tl::unexpected(fine.error());
  auto read = read_set(set, set_file);
  if (!read) return tl::unexpected(read.error());
  Matrix matrix{.columns = std::move(columns), .rows = std::move(read->rows), .set = std::move(read->faults)};
  for (std::size_t row = 0; row < matrix.rows.size(); ++row) {
    std::vector<std::optional<Error>> why;
    for (const Column& column : matrix.columns)
      why.push_back(unfit(column, set, set_file, read->places[row]));
    add_cells(matrix, row, [&](std::size_t column) { return !why[column]; });
    if (row == 0 || std::ranges::any_of(why, [](const auto& one) { return !one; })) continue;
    const std::string& first = why.front()->message;
    if (std::ranges::all_of(why, [&](const auto& one) { return one->message == first; }))
      return failure(first);
    return failure(
        fmt::format("{} in {}, and it fits no other scenario", first, matrix.columns.front().file));
  }
  return matrix;
}

std::vector<FaultText> Matrix::faults_of(const Cell& cell, std::uint64_t run) const {
  if (cell.row == 0) return {};
  if (!set.empty()) return set[cell.row];
  const Column& column = columns[cell.column];
  if (cell.row + 1 == rows.size()) return drawn_faults(at_once, drawn[cell.column], column, seed, run);
  const Row& row = rows[cell.row];
  auto fault = drawn_fault({.kind = row.fault, .node = row.node}, column, seed, run);
  if (!fault) return {};
  return {std::move(*fault)};
}

}  // namespace canhil::campaign::matrix
