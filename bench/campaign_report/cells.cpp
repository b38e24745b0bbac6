#include "bench/campaign_report/cells.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace canhil::campaign {
namespace {

using matrix::Response;
using matrix::Row;
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
  for (const Responded* cell : cells) {
    const Response& response = cell->run.response;
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
      return std::string(matrix::name(kind));
  }
  return {};
}

Table table_of(const Responses& all, std::size_t column) {
  const matrix::Column& of = all.matrix.columns[column];
  Table table{.title = fmt::format("{} ({})", of.name, estimators_of(of))};
  for (std::size_t row = 0; row < all.matrix.rows.size(); ++row) {
    Cells cells = cells_of(all, row, column);
    if (cells.empty()) continue;
    const auto& [fault, node] = all.matrix.rows[row];
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

Responses responses_in(const Campaign& campaign, const Evaluation& evaluation) {
  return {.matrix = *campaign.matrix, .runs = campaign.runs, .evaluation = evaluation};
}

Cells cells_of(const Responses& all, std::size_t row, std::size_t column) {
  Cells cells;
  for (const Responded& flight : all.evaluation.responses) {
    const matrix::Cell& cell = all.matrix.cells[flight.key.variant];
    if (cell.row == row && cell.column == column) cells.push_back(&flight);
  }
  return cells;
}

std::string summary(const Cells& cells) {
  if (cells.empty()) return "-";
  std::string text;
  for (const Kind kind : kinds_by_weight) {
    Cells its;
    std::ranges::copy_if(cells, std::back_inserter(its),
                         [&](const Responded* cell) { return cell->run.response.kind == kind; });
    if (its.empty()) continue;
    if (!text.empty()) text += "; ";
    if (cells.size() > 1) text += fmt::format("{} ", its.size());
    text += short_words(kind, its);
  }
  return text;
}

std::string estimators_of(const matrix::Column& column) {
  std::string text;
  for (const auto& setup : column.scenario.targets) text += (text.empty() ? "" : ", ") + setup.estimator;
  return text;
}

std::vector<Table> tables(const Responses& all) {
  const matrix::Matrix& matrix = all.matrix;
  std::vector<Table> tables;
  if (std::ranges::any_of(matrix.rows, [](const Row& row) { return !row.node.empty(); })) {
    for (std::size_t column = 0; column < matrix.columns.size(); ++column)
      tables.push_back(table_of(all, column));
    return tables;
  }
  Table& table = tables.emplace_back();
  for (const matrix::Column& column : matrix.columns) table.heads.push_back(column.name);
  for (std::size_t row = 0; row < matrix.rows.size(); ++row) {
    auto& [fault, cells] = table.rows.emplace_back(matrix.rows[row].fault, std::vector<Cells>{});
    for (std::size_t column = 0; column < matrix.columns.size(); ++column)
      cells.push_back(cells_of(all, row, column));
  }
  return tables;
}

}  // namespace canhil::campaign
