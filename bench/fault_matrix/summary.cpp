#include "bench/fault_matrix/summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

namespace canhil::fault_matrix {
namespace {

using Kind = Response::Kind;

// A value or a range, for example "0.020" or "0.020 to 0.500".
std::string range(const std::vector<double>& values) {
  const auto [least, most] = std::ranges::minmax(values);
  return least == most ? fmt::format("{:.3f}", least) : fmt::format("{:.3f} to {:.3f}", least, most);
}

std::string several(std::vector<std::string> words) {
  std::ranges::sort(words);
  words.erase(std::unique(words.begin(), words.end()), words.end());
  return fmt::format("{}", fmt::join(words, ", "));
}

// A short summary of the cells whose response is of one kind.
std::string short_words(Kind kind, const Cells& cells) {
  std::vector<double> detected_s, recovered_s;
  std::vector<std::string> what;
  for (const Finished* cell : cells) {
    const Response& response = cell->response;
    if (response.detected_s) detected_s.push_back(*response.detected_s);
    if (response.recovered_s) recovered_s.push_back(*response.recovered_s);
    if (kind == Kind::ended) what.push_back(response.why);
    if (kind == Kind::violated) what.push_back(response.check);
  }
  switch (kind) {
    case Kind::detected: {
      std::string text = fmt::format("detected in {} s", range(detected_s));
      if (!recovered_s.empty()) text += fmt::format(", recovered in {} s", range(recovered_s));
      if (const std::size_t left = cells.size() - recovered_s.size(); left > 0)
        text += cells.size() == 1 ? ", not recovered" : fmt::format(", {} not recovered", left);
      return text;
    }
    case Kind::ended:
      return fmt::format("ended in {} s: {}", range(detected_s), several(what));
    case Kind::violated:
      return fmt::format("violated {}", several(what));
    case Kind::tolerated:
    case Kind::not_measured:
      return std::string(name(kind));
  }
  return {};
}

Table table_of(const Results& results, std::size_t column) {
  const Identity& identity = results.identity;
  Table table{.title = fmt::format("{} ({})", head_of(identity.columns[column]),
                                   identity.columns[column].estimators)};
  for (std::size_t row = 0; row < identity.rows.size(); ++row) {
    Cells cells = cells_of(results, row, column);
    if (cells.empty()) continue;
    const auto& [fault, node] = identity.rows[row];
    const std::string head = node.empty() ? "the bus" : node;
    const auto at = std::ranges::find(table.heads, head) - table.heads.begin();
    if (static_cast<std::size_t>(at) == table.heads.size()) table.heads.push_back(head);
    auto known = std::ranges::find(table.rows, fault, &decltype(table.rows)::value_type::first);
    if (known == table.rows.end()) known = table.rows.insert(known, {fault, {}});
    known->second.resize(table.heads.size());
    known->second[static_cast<std::size_t>(at)] = std::move(cells);
  }
  for (auto& [fault, cells] : table.rows) cells.resize(table.heads.size());
  return table;
}

}  // namespace

Cells cells_of(const Results& results, std::size_t row, std::size_t column) {
  Cells cells;
  for (const auto& [index, cell] : results.cells) {
    if (cell.row == row && cell.column == column) cells.push_back(&cell);
  }
  return cells;
}

std::string summary(const Cells& cells) {
  if (cells.empty()) return "-";
  std::string text;
  for (const Kind kind : kinds_by_weight) {
    Cells its;
    std::ranges::copy_if(cells, std::back_inserter(its),
                         [&](const Finished* cell) { return cell->response.kind == kind; });
    if (its.empty()) continue;
    if (!text.empty()) text += "; ";
    if (cells.size() > 1) text += fmt::format("{} ", its.size());
    text += short_words(kind, its);
  }
  return text;
}

std::string head_of(const Identity::Column& column) {
  return std::filesystem::path(column.file).stem().string();
}

std::vector<Table> tables(const Results& results) {
  const Identity& identity = results.identity;
  std::vector<Table> all;
  if (std::ranges::any_of(identity.rows, [](const Row& row) { return !row.node.empty(); })) {
    for (std::size_t column = 0; column < identity.columns.size(); ++column)
      all.push_back(table_of(results, column));
    return all;
  }
  Table& table = all.emplace_back();
  for (const Identity::Column& column : identity.columns) table.heads.push_back(head_of(column));
  for (std::size_t row = 0; row < identity.rows.size(); ++row) {
    auto& [fault, cells] = table.rows.emplace_back(identity.rows[row].fault, std::vector<Cells>{});
    for (std::size_t column = 0; column < identity.columns.size(); ++column)
      cells.push_back(cells_of(results, row, column));
  }
  return all;
}

}  // namespace canhil::fault_matrix
