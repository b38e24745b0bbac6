#include "bench/fault_matrix/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "bench/fault_matrix/execute.hpp"
#include "bench/report/page_parts.hpp"

namespace canhil::fault_matrix {
namespace {

using checks::Outcome;
using report::escaped;
using Kind = Response::Kind;

constexpr std::string_view no_cell = "-";

std::vector<const Finished*> cells_of(const Results& results, std::size_t row, std::size_t column) {
  std::vector<const Finished*> cells;
  for (const auto& [place, cell] : results.cells) {
    if (cell.row == row && cell.column == column) cells.push_back(&cell);
  }
  return cells;
}

// "0.020", "0.020 to 0.500".
std::string range(const std::vector<double>& values) {
  const auto [least, most] = std::ranges::minmax(values);
  return least == most ? fmt::format("{:.3f}", least) : fmt::format("{:.3f} to {:.3f}", least, most);
}

std::string several(std::vector<std::string> words) {
  std::ranges::sort(words);
  words.erase(std::unique(words.begin(), words.end()), words.end());
  return fmt::format("{}", fmt::join(words, ", "));
}

// What the cells of one kind have in common, in a few words.
std::string short_words(Kind kind, const std::vector<const Finished*>& cells) {
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

constexpr std::array kinds{Kind::violated, Kind::not_measured, Kind::ended, Kind::detected, Kind::tolerated};

// The worst first; with counts where there are several runs.
std::string summary(const std::vector<const Finished*>& cells) {
  if (cells.empty()) return std::string(no_cell);
  std::string text;
  for (const Kind kind : kinds) {
    std::vector<const Finished*> its;
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

// A line for each cell of a kind.
std::vector<std::string> told(const Results& results, Kind kind, const std::string& folder) {
  std::vector<std::string> lines;
  for (const auto& [place, cell] : results.cells) {
    if (cell.response.kind != kind) continue;
    std::string line = fmt::format(
        "{}, {}{}: {}", results.identity.rows[cell.row], head_of(results.identity.columns[cell.column]),
        results.identity.runs > 1 ? fmt::format(", run {}", cell.run) : "", words(cell.response));
    lines.push_back(std::move(line));
    for (const std::string& fault : cell.least) lines.push_back("  " + fault);
    if (!cell.replay.empty())
      lines.push_back("  " + replay_command((std::filesystem::path(folder) / cell.replay).string(),
                                            results.identity.target));
  }
  return lines;
}

std::size_t count(const Results& results, Kind kind) {
  return static_cast<std::size_t>(std::ranges::count_if(
      results.cells, [&](const auto& cell) { return cell.second.response.kind == kind; }));
}

std::string counts(const Results& results) {
  std::string text = fmt::format("{} of {} flights", results.cells.size(), results.identity.cells);
  for (const Kind kind : kinds) {
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
  for (const std::string& row : identity.rows) widest = std::max(widest, row.size());
  std::string out = fmt::format("Faults and responses, seed {}, {} run{} a cell, against {}\n", identity.seed,
                                identity.runs, identity.runs == 1 ? "" : "s", target_words(identity));
  // A scenario after the other: cells say more than fits beside one another on a terminal.
  for (std::size_t column = 0; column < identity.columns.size(); ++column) {
    out += fmt::format("\n{} ({})\n", head_of(identity.columns[column]), identity.columns[column].estimators);
    for (std::size_t row = 0; row < identity.rows.size(); ++row) {
      const auto cells = cells_of(results, row, column);
      if (!cells.empty()) out += fmt::format("  {:<{}}  {}\n", identity.rows[row], widest, summary(cells));
    }
  }
  for (const auto& [kind, title] :
       {std::pair(Kind::not_measured, "Not measured"),
        std::pair(Kind::violated, "Violated, each with the least that shows it")}) {
    const auto lines = told(results, kind, folder);
    if (!lines.empty()) out += fmt::format("\n{}\n  {}\n", title, fmt::join(lines, "\n  "));
  }
  return out + fmt::format("\n{}: {}\n", checks::name(outcome_of(results)), counts(results));
}

std::string markdown(const Results& results) {
  const Identity& identity = results.identity;
  std::string out = "| fault |", line = "|---|";
  for (const Identity::Column& column : identity.columns) {
    out += fmt::format(" {} |", head_of(column));
    line += "---|";
  }
  out += "\n" + line + "\n";
  for (std::size_t row = 0; row < identity.rows.size(); ++row) {
    out += fmt::format("| {} |", identity.rows[row]);
    for (std::size_t column = 0; column < identity.columns.size(); ++column)
      out += fmt::format(" {} |", summary(cells_of(results, row, column)));
    out += "\n";
  }
  return out;
}

std::string json(const Results& results) {
  using Json = nlohmann::ordered_json;
  const Identity& identity = results.identity;
  Json columns = Json::array(), cells = Json::array();
  for (const Identity::Column& column : identity.columns)
    columns.push_back(
        {{"scenario", column.file}, {"title", column.title}, {"estimators", column.estimators}});
  for (const auto& [place, cell] : results.cells) {
    const Response& response = cell.response;
    Json json{{"row", identity.rows[cell.row]},
              {"column", head_of(identity.columns[cell.column])},
              {"run", cell.run},
              {"faults", cell.faults},
              {"response", name(response.kind)},
              {"words", words(response)}};
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
                  {"rows", identity.rows},
                  {"cells", cells}};
  return page.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string html(const Results& results, const std::string& folder) {
  const Identity& identity = results.identity;
  std::vector<std::string> head{"fault"};
  for (const Identity::Column& column : identity.columns) head.push_back(escaped(head_of(column)));
  report::Rows rows;
  for (std::size_t row = 0; row < identity.rows.size(); ++row) {
    rows.push_back({escaped(identity.rows[row])});
    for (std::size_t column = 0; column < identity.columns.size(); ++column) {
      const auto cells = cells_of(results, row, column);
      const auto any = [&](Kind kind) {
        return std::ranges::any_of(cells, [&](const Finished* cell) { return cell->response.kind == kind; });
      };
      const auto [style, sign] = report::look_of(any(Kind::violated)       ? "fail"
                                                 : any(Kind::not_measured) ? "not measured"
                                                                           : "pass");
      rows.back().push_back(cells.empty() ? std::string(no_cell)
                                          : fmt::format("<span class=\"{}\">{}</span> {}", style, sign,
                                                        escaped(summary(cells))));
    }
  }
  std::string body = fmt::format(
      "<h1>Faults and responses</h1>\n<p class=\"sub\">{} &middot; seed {} &middot; against {}</p>\n{}",
      escaped(counts(results)), identity.seed, escaped(target_words(identity)), report::table(head, rows));
  for (const auto& [kind, title] :
       {std::pair(Kind::not_measured, "Not measured"), std::pair(Kind::violated, "Violated")}) {
    const auto lines = told(results, kind, folder);
    if (!lines.empty())
      body += fmt::format("<section><h2>{}</h2>\n<pre style=\"white-space:pre-wrap\">{}</pre></section>\n",
                          title, escaped_lines(lines));
  }
  return report::whole_page("Faults and responses", report::styles, body);
}

}  // namespace canhil::fault_matrix
