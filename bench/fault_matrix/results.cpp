#include "bench/fault_matrix/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/drive/file_identity.hpp"
#include "bench/drive/target_command.hpp"
#include "dbc/files/text_file.hpp"
#include "dbc/version/version.hpp"
#include "messages/canhil.hpp"

namespace canhil::fault_matrix {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::string_view format = "canhil fault matrix 2";
constexpr std::size_t most_bytes = std::size_t{1} << 28U;

// File names may contain bytes that are not UTF-8; such bytes are replaced.
std::string line_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json json_of(const Finished& finished) {
  Json json{{"cell", finished.cell}, {"row", finished.row},       {"column", finished.column},
            {"run", finished.run},   {"faults", finished.faults}, {"response", name(finished.response.kind)}};
  const Response& response = finished.response;
  if (response.detected_s) json["detected_s"] = *response.detected_s;
  if (!response.by.empty()) json["by"] = response.by;
  if (response.recovered_s) json["recovered_s"] = *response.recovered_s;
  if (!response.why.empty()) json["why"] = response.why;
  if (!response.check.empty()) json["check"] = response.check;
  if (!finished.replay.empty()) json["replay"] = finished.replay;
  if (!finished.least.empty()) json["least"] = finished.least;
  return json;
}

Finished finished_of(const Json& json) {
  Finished finished{.cell = json.at("cell"),
                    .row = json.at("row"),
                    .column = json.at("column"),
                    .run = json.at("run"),
                    .faults = json.at("faults")};
  Response& response = finished.response;
  response.kind = kind_named(json.at("response").get<std::string>()).value();
  if (json.contains("detected_s")) response.detected_s = json["detected_s"].get<double>();
  if (json.contains("recovered_s")) response.recovered_s = json["recovered_s"].get<double>();
  response.by = json.value("by", "");
  response.why = json.value("why", "");
  response.check = json.value("check", "");
  finished.replay = json.value("replay", "");
  finished.least = json.value("least", std::vector<std::string>());
  return finished;
}

Identity identity_of_line(const std::string& line) {
  const Json json = Json::parse(line);
  if (json.at("format") != format) throw std::invalid_argument("another format");
  Identity identity{.line = line,
                    .seed = json.at("seed"),
                    .runs = json.at("runs"),
                    .target = json.at("target").at("command"),
                    .cells = json.at("cells")};
  for (const Json& column : json.at("columns"))
    identity.columns.push_back(
        {.file = column.at("scenario"), .title = column.at("title"), .estimators = column.at("estimators")});
  for (const Json& row : json.at("rows"))
    identity.rows.push_back({.fault = row.at("fault"), .node = row.at("node")});
  return identity;
}

}  // namespace

Identity identity_of(const Plan& plan, const std::string& target) {
  Json columns = Json::array();
  for (const Column& column : plan.columns) {
    std::string estimators;
    for (const auto& setup : column.scenario.targets)
      estimators += (estimators.empty() ? "" : ", ") + setup.estimator;
    columns.push_back({{"scenario", column.file},
                       {"title", column.scenario.title},
                       {"estimators", estimators},
                       {"hash", fmt::format("{:016x}", column.scenario.hash)}});
  }
  Json rows = Json::array();
  for (const Row& row : plan.rows) rows.push_back({{"fault", row.fault}, {"node", row.node}});
  Json files = Json::array();
  if (!target.empty()) {
    for (const std::string& path : drive::files_of_target(target)) {
      if (const auto file = drive::identify_file(path)) files.push_back(file->sha256);
    }
  }
  return identity_of_line(line_of({{"format", format},
                                   {"program", revision()},
                                   {"dbc", fmt::format("{:016x}", messages::dbc_hash)},
                                   {"target", {{"command", target}, {"files", files}}},
                                   {"seed", plan.seed},
                                   {"runs", plan.runs},
                                   {"set", fmt::format("{:016x}", plan.set_hash)},
                                   {"columns", columns},
                                   {"rows", rows},
                                   {"cells", plan.cells.size()}}));
}

Result<Results> read_results(const fs::path& file) {
  const auto text = read_text_file(file, "results of a fault matrix", most_bytes);
  if (!text) return tl::unexpected(text.error());
  Results results;
  try {
    std::size_t begin = 0;
    for (std::size_t end = text->find('\n'); end != std::string::npos; end = text->find('\n', begin)) {
      const std::string line = text->substr(begin, end - begin);
      begin = end + 1;
      if (results.identity.line.empty()) {
        results.identity = identity_of_line(line);
        continue;
      }
      Finished finished = finished_of(Json::parse(line));
      results.cells.insert_or_assign(finished.cell, std::move(finished));
    }
  } catch (const std::exception&) {
    results.identity.line.clear();
  }
  if (results.identity.line.empty())
    return failure(fmt::format("{}: holds no results of a fault matrix, expected what hil-bench faults made",
                               file.string()));
  return results;
}

Result<Results> merged(std::span<const fs::path> files) {
  Results all;
  for (const fs::path& file : files) {
    auto one = read_results(file);
    if (!one) return one;
    if (!all.identity.line.empty() && one->identity.line != all.identity.line)
      return failure(fmt::format("{}: is of another matrix than {}, expected shards of one", file.string(),
                                 files.front().string()));
    all.identity = std::move(one->identity);
    all.cells.merge(one->cells);
  }
  if (all.cells.size() < all.identity.cells)
    return failure(fmt::format("{}: {} of {} cells are in no file, expected all shards, each to its end",
                               files.front().string(), all.identity.cells - all.cells.size(),
                               all.identity.cells));
  return all;
}

Result<std::pair<Writer, Results>> Writer::open(const fs::path& file, const Identity& identity, bool resume) {
  std::error_code unknown;
  const bool there = fs::exists(file, unknown);
  if (there && !resume)
    return failure(fmt::format("{}: exists already, expected --resume or another --out", file.string()));
  Results results{.identity = identity};
  if (there) {
    auto before = read_results(file);
    if (!before) return tl::unexpected(before.error());
    if (before->identity.line != identity.line)
      return failure(
          fmt::format("{}: is of another matrix, program or target, expected another --out", file.string()));
    results.cells = std::move(before->cells);
  }
  // Rewrites the file, because its last line may be truncated.
  Writer writer;
  writer.path_ = file;
  const fs::path anew = file.string() + ".new";
  writer.file_.open(anew, std::ios::trunc | std::ios::binary);
  writer.file_ << identity.line << '\n';
  for (const auto& [cell, finished] : results.cells) writer.file_ << line_of(json_of(finished)) << '\n';
  writer.file_.flush();
  if (writer.file_) fs::rename(anew, file, unknown);
  if (!writer.file_ || unknown) return failure(fmt::format("{}: cannot be written", file.string()));
  return std::pair(std::move(writer), std::move(results));
}

Result<void> Writer::add(const Finished& finished) {
  file_ << line_of(json_of(finished)) << '\n';
  file_.flush();
  if (!file_) return failure(fmt::format("{}: cannot be written; --resume goes on with it", path_.string()));
  return {};
}

}  // namespace canhil::fault_matrix
