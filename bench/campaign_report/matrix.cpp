#include "bench/campaign_report/matrix.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <tuple>

#include "bench/campaign/matrix/flights.hpp"
#include "bench/campaign_report/cells.hpp"
#include "bench/report/page_parts.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::campaign {
namespace {

using report::escaped;
using Kind = matrix::Response::Kind;

// One line for each cell whose response is of a kind. For a violation, the line also contains the faults and
// the command that repeats the violation.
std::vector<std::string> lines_of(const Responses& all, Kind kind, const std::filesystem::path& folder) {
  std::vector<std::string> lines;
  for (const Responded& flight : all.evaluation.responses) {
    if (flight.run.response.kind != kind) continue;
    const matrix::Cell& cell = all.matrix.cells[flight.key.variant];
    lines.push_back(one_line(fmt::format(
        "{}, {}{}: {}", all.matrix.rows[cell.row].name(), all.matrix.columns[cell.column].name,
        all.runs > 1 ? fmt::format(", run {}", flight.key.run) : "", to_text(flight.run.response))));
    if (flight.run.replay.empty()) continue;
    for (const std::string& fault : flight.run.faults) lines.push_back("  flown: " + fault);
    for (const std::string& fault : flight.run.least) lines.push_back("  least: " + fault);
    const std::string file = (folder / flight.run.replay).string();
    std::error_code unknown;
    lines.push_back("  " + (std::filesystem::exists(file, unknown)
                                ? matrix::replay_command(file, flight.run.target)
                                : fmt::format("{} is not there any more: no replay", file)));
  }
  return lines;
}

std::string counts(const Responses& all) {
  const auto& responses = all.evaluation.responses;
  std::string text = fmt::format("{} flights", responses.size());
  for (const Kind kind : kinds_by_weight) {
    const auto its = std::ranges::count_if(
        responses, [&](const Responded& flight) { return flight.run.response.kind == kind; });
    if (its > 0) text += fmt::format(", {} {}", its, matrix::name(kind));
  }
  return text;
}

std::string escaped_lines(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += escaped(line) + "\n";
  return text;
}

std::string target_words(const Evaluation& evaluation) {
  return evaluation.identity.target.empty() ? "the target's own code, in process"
                                            : evaluation.identity.target;
}

// The summary with the symbol and colour of the worst response.
std::string marked_summary(const Cells& cells) {
  if (cells.empty()) return summary(cells);
  const auto any = [&](Kind kind) {
    return std::ranges::any_of(cells, [&](const Responded* cell) { return cell->run.response.kind == kind; });
  };
  return report::outcome_words(any(Kind::violated)       ? "fail"
                               : any(Kind::not_measured) ? "not measured"
                                                         : "pass",
                               escaped(summary(cells)));
}

}  // namespace

std::string matrix_text(const Campaign& campaign, const Evaluation& evaluation,
                        const std::filesystem::path& folder) {
  const Responses all = responses_in(campaign, evaluation);
  std::size_t widest = 0;
  for (const matrix::Row& row : all.matrix.rows) widest = std::max(widest, row.name().size());
  std::string out =
      fmt::format("Faults and responses, seed {}, {} run{} a cell, against {}\n", all.matrix.seed, all.runs,
                  all.runs == 1 ? "" : "s", target_words(evaluation));
  // Prints one table per scenario: cells are too wide for several scenarios side by side on a terminal.
  for (std::size_t column = 0; column < all.matrix.columns.size(); ++column) {
    out += fmt::format("\n{} ({})\n", one_line(all.matrix.columns[column].name),
                       estimators_of(all.matrix.columns[column]));
    for (std::size_t row = 0; row < all.matrix.rows.size(); ++row) {
      const auto cells = cells_of(all, row, column);
      if (!cells.empty())
        out += fmt::format("  {:<{}}  {}\n", all.matrix.rows[row].name(), widest, summary(cells));
    }
  }
  for (const auto& [kind, title] :
       {std::pair(Kind::not_measured, "Not measured"),
        std::pair(Kind::violated, "Violated, each with the smallest scenario that shows it")}) {
    const auto lines = lines_of(all, kind, folder);
    if (!lines.empty()) out += fmt::format("\n{}\n  {}\n", title, fmt::join(lines, "\n  "));
  }
  return out + fmt::format("\n{}: {}\n", checks::name(evaluation.outcome()), counts(all));
}

std::string matrix_markdown(const Campaign& campaign, const Evaluation& evaluation) {
  std::string out;
  for (const Table& table : tables(responses_in(campaign, evaluation))) {
    if (!table.title.empty()) out += fmt::format("{}### {}\n\n", out.empty() ? "" : "\n", table.title);
    out += fmt::format("| fault | {} |\n|---|", fmt::join(table.heads, " | "));
    for (std::size_t i = 0; i < table.heads.size(); ++i) out += "---|";
    out += "\n";
    for (const auto& [fault, cells] : table.rows) {
      out += fmt::format("| {} |", fault);
      for (const Cells& each : cells) out += fmt::format(" {} |", summary(each));
      out += "\n";
    }
  }
  return out;
}

void add_matrix(nlohmann::ordered_json& json, const Campaign& campaign, const Evaluation& evaluation) {
  using Json = nlohmann::ordered_json;
  const matrix::Matrix& matrix = *campaign.matrix;
  Json columns = Json::array(), cells = Json::array(), rows = Json::array();
  for (const matrix::Row& row : matrix.rows) rows.push_back(row.name());
  for (const matrix::Column& column : matrix.columns)
    columns.push_back(
        {{"scenario", column.file}, {"title", column.scenario.title}, {"estimators", estimators_of(column)}});
  for (const Responded& flight : evaluation.responses) {
    const matrix::Cell& cell = matrix.cells[flight.key.variant];
    Json one{{"row", matrix.rows[cell.row].name()},
             {"fault", matrix.rows[cell.row].fault},
             {"node", matrix.rows[cell.row].node},
             {"column", matrix.columns[cell.column].name},
             {"run", flight.key.run},
             {"words", to_text(flight.run.response)}};
    one.update(matrix::json_of(flight.run));
    cells.push_back(std::move(one));
  }
  json["columns"] = columns;
  json["rows"] = rows;
  json["cells"] = cells;
}

std::string matrix_html(const Campaign& campaign, const Evaluation& evaluation,
                        const std::filesystem::path& folder) {
  const Responses all = responses_in(campaign, evaluation);
  std::string body = fmt::format("<p class=\"sub\">{} &middot; seed {} &middot; against {}</p>\n",
                                 escaped(counts(all)), all.matrix.seed, escaped(target_words(evaluation)));
  std::size_t number = 0;
  for (const Table& table : tables(all)) {
    std::vector<std::string> head{"fault"};
    for (const std::string& one : table.heads) head.push_back(escaped(one));
    report::Rows rows;
    for (const auto& [fault, cells] : table.rows) {
      rows.push_back({escaped(fault)});
      for (const Cells& each : cells) rows.back().push_back(marked_summary(each));
    }
    const std::string shown = report::table(head, rows);
    body +=
        table.title.empty() ? shown : report::section(fmt::format("matrix-{}", ++number), table.title, shown);
  }
  for (const auto& [kind, id, title] : {std::tuple(Kind::not_measured, "not-measured", "Not measured"),
                                        std::tuple(Kind::violated, "violated", "Violated")}) {
    const auto lines = lines_of(all, kind, folder);
    if (!lines.empty())
      body += report::section(id, title, fmt::format("<pre>{}</pre>\n", escaped_lines(lines)));
  }
  return body;
}

}  // namespace canhil::campaign
