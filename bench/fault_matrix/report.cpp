#include "bench/fault_matrix/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "bench/fault_matrix/execute.hpp"
#include "bench/fault_matrix/summary.hpp"
#include "bench/report/page_parts.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::fault_matrix {
namespace {

using checks::Outcome;
using report::escaped;
using Kind = Response::Kind;

// One line for each cell whose response is of a kind. For a violation, the line also contains the faults and
// the command that repeats the violation.
std::vector<std::string> lines_of(const Results& results, Kind kind, const std::string& folder) {
  std::vector<std::string> lines;
  for (const auto& [index, cell] : results.cells) {
    if (cell.response.kind != kind) continue;
    std::string line = fmt::format("{}, {}{}: {}", results.identity.rows[cell.row].name(),
                                   head_of(results.identity.columns[cell.column]),
                                   results.identity.runs > 1 ? fmt::format(", run {}", cell.run) : "",
                                   to_text(cell.response));
    lines.push_back(one_line(line));
    if (cell.replay.empty()) continue;
    for (const std::string& fault : cell.faults) lines.push_back("  flown: " + fault);
    for (const std::string& fault : cell.least) lines.push_back("  least: " + fault);
    const std::string file = (std::filesystem::path(folder) / cell.replay).string();
    std::error_code unknown;
    lines.push_back("  " + (std::filesystem::exists(file, unknown)
                                ? replay_command(file, results.identity.target)
                                : fmt::format("{} is not there any more: no replay", file)));
  }
  return lines;
}

std::size_t count(const Results& results, Kind kind) {
  return static_cast<std::size_t>(std::ranges::count_if(
      results.cells, [&](const auto& cell) { return cell.second.response.kind == kind; }));
}

std::string counts(const Results& results) {
  std::string text = fmt::format("{} of {} flights", results.cells.size(), results.identity.cells);
  for (const Kind kind : kinds_by_weight) {
    if (const std::size_t its = count(results, kind); its > 0)
      text += fmt::format(", {} {}", its, name(kind));
  }
  return text;
}

std::string escaped_lines(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += escaped(line) + "\n";
  return text;
}

std::string target_words(const Identity& identity) {
  return identity.target.empty() ? "the target's own code, in process" : identity.target;
}

// The summary with the symbol and colour of the worst response.
std::string marked_summary(const Cells& cells) {
  if (cells.empty()) return summary(cells);
  const auto any = [&](Kind kind) {
    return std::ranges::any_of(cells, [&](const Finished* cell) { return cell->response.kind == kind; });
  };
  const auto [style, sign] = report::look_of(any(Kind::violated)       ? "fail"
                                             : any(Kind::not_measured) ? "not measured"
                                                                       : "pass");
  return fmt::format("<span class=\"{}\">{}</span> {}", style, sign, escaped(summary(cells)));
}

}  // namespace

Outcome outcome_of(const Results& results) {
  if (count(results, Kind::violated) > 0) return Outcome::fail;
  if (results.cells.size() < results.identity.cells || count(results, Kind::not_measured) > 0)
    return Outcome::not_measured;
  return Outcome::pass;
}

std::string text(const Results& results, const std::string& folder) {
  const Identity& identity = results.identity;
  std::size_t widest = 0;
  for (const Row& row : identity.rows) widest = std::max(widest, row.name().size());
  std::string out = fmt::format("Faults and responses, seed {}, {} run{} a cell, against {}\n", identity.seed,
                                identity.runs, identity.runs == 1 ? "" : "s", target_words(identity));
  // Prints one table per scenario: cells are too wide for several scenarios side by side on a terminal.
  for (std::size_t column = 0; column < identity.columns.size(); ++column) {
    out += fmt::format("\n{} ({})\n", one_line(head_of(identity.columns[column])),
                       identity.columns[column].estimators);
    for (std::size_t row = 0; row < identity.rows.size(); ++row) {
      const auto cells = cells_of(results, row, column);
      if (!cells.empty())
        out += fmt::format("  {:<{}}  {}\n", identity.rows[row].name(), widest, summary(cells));
    }
  }
  for (const auto& [kind, title] :
       {std::pair(Kind::not_measured, "Not measured"),
        std::pair(Kind::violated, "Violated, each with the smallest scenario that shows it")}) {
    const auto lines = lines_of(results, kind, folder);
    if (!lines.empty()) out += fmt::format("\n{}\n  {}\n", title, fmt::join(lines, "\n  "));
  }
  return out + fmt::format("\n{}: {}\n", checks::name(outcome_of(results)), counts(results));
}

std::string markdown(const Results& results) {
  std::string out;
  for (const Table& table : tables(results)) {
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

std::string json(const Results& results) {
  using Json = nlohmann::ordered_json;
  const Identity& identity = results.identity;
  Json columns = Json::array(), cells = Json::array(), rows = Json::array();
  for (const Row& row : identity.rows) rows.push_back(row.name());
  for (const Identity::Column& column : identity.columns)
    columns.push_back(
        {{"scenario", column.file}, {"title", column.title}, {"estimators", column.estimators}});
  for (const auto& [index, cell] : results.cells) {
    const Response& response = cell.response;
    Json json{{"row", identity.rows[cell.row].name()},
              {"fault", identity.rows[cell.row].fault},
              {"node", identity.rows[cell.row].node},
              {"column", head_of(identity.columns[cell.column])},
              {"run", cell.run},
              {"faults", cell.faults},
              {"response", name(response.kind)},
              {"words", to_text(response)}};
    if (response.detected_s) json["detected_s"] = *response.detected_s;
    if (!response.by.empty()) json["by"] = response.by;
    if (response.recovered_s) json["recovered_s"] = *response.recovered_s;
    if (!response.why.empty()) json["why"] = response.why;
    if (!response.check.empty()) json["check"] = response.check;
    if (!cell.replay.empty()) json["replay"] = cell.replay;
    if (!cell.least.empty()) json["least"] = cell.least;
    cells.push_back(std::move(json));
  }
  const Json page{{"outcome", checks::name(outcome_of(results))},
                  {"target", identity.target},
                  {"seed", identity.seed},
                  {"runs", identity.runs},
                  {"columns", columns},
                  {"rows", rows},
                  {"cells", cells}};
  return page.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string html(const Results& results, const std::string& folder) {
  const Identity& identity = results.identity;
  std::string body = fmt::format(
      "<h1>Faults and responses</h1>\n<p class=\"sub\">{} &middot; seed {} &middot; against {}</p>\n",
      escaped(counts(results)), identity.seed, escaped(target_words(identity)));
  for (const Table& table : tables(results)) {
    std::vector<std::string> head{"fault"};
    for (const std::string& one : table.heads) head.push_back(escaped(one));
    report::Rows rows;
    for (const auto& [fault, cells] : table.rows) {
      rows.push_back({escaped(fault)});
      for (const Cells& each : cells) rows.back().push_back(marked_summary(each));
    }
    const std::string shown = report::table(head, rows);
    body += table.title.empty()
                ? shown
                : fmt::format("<section><h2>{}</h2>\n{}</section>\n", escaped(table.title), shown);
  }
  for (const auto& [kind, title] :
       {std::pair(Kind::not_measured, "Not measured"), std::pair(Kind::violated, "Violated")}) {
    const auto lines = lines_of(results, kind, folder);
    if (!lines.empty())
      body += fmt::format("<section><h2>{}</h2>\n<pre style=\"white-space:pre-wrap\">{}</pre></section>\n",
                          title, escaped_lines(lines));
  }
  return report::whole_page("Faults and responses", report::styles, body);
}

}  // namespace canhil::fault_matrix
