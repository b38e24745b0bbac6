#include "bench/fault_matrix/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/drive/file_identity.hpp"
#include "bench/drive/target_command.hpp"
#include "bench/world/hash.hpp"
#include "dbc/files/output_file.hpp"
#include "dbc/files/text_file.hpp"
#include "dbc/version/version.hpp"
#include "messages/canhil.hpp"

namespace canhil::fault_matrix {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::string_view format = "canhil fault matrix 3";
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

// FNV-1a over the identity of the matrix and a line without its hash. It finds damage, and lines that belong
// to another matrix; it is no protection against someone who computes a new hash.
std::string hash_of(const Identity& identity, const Json& json) {
  return fmt::format("{:016x}", world::fnv1a_64(line_of(json), world::fnv1a_64(identity.line)));
}

std::string line_with_hash(const Identity& identity, const Finished& finished) {
  Json json = json_of(finished);
  json["hash"] = hash_of(identity, json);
  return line_of(json);
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

// The cell of a line. Throws Altered if the line is not as it was written.
struct Altered {};
Finished verified(const Identity& identity, const std::string& line) {
  Json json = Json::parse(line);
  const auto hash = json.find("hash");
  const std::string stated = hash != json.end() && hash->is_string() ? hash->get<std::string>() : "";
  if (json.is_object()) json.erase("hash");
  if (stated != hash_of(identity, json)) throw Altered{};
  Finished finished = finished_of(json);
  const bool known = finished.cell < identity.cells && finished.row < identity.rows.size() &&
                     finished.column < identity.columns.size();
  if (!known) throw Altered{};
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
  std::size_t number = 0;  // of the line
  try {
    std::size_t begin = 0;
    for (std::size_t end = text->find('\n'); end != std::string::npos; end = text->find('\n', begin)) {
      const std::string line = text->substr(begin, end - begin);
      begin = end + 1;
      ++number;
      if (results.identity.line.empty()) {
        results.identity = identity_of_line(line);
        continue;
      }
      Finished finished = verified(results.identity, line);
      results.cells.insert_or_assign(finished.cell, std::move(finished));
    }
  } catch (const Altered&) {
    return failure(
        fmt::format("{}:{}: has another hash than its content, expected a line as it was written: the "
                    "file is damaged",
                    file.string(), number));
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
  auto output = OutputFile::create(file.string());
  if (!output) return tl::unexpected(output.error());
  std::FILE* stream = output->take_stream();
  if (stream == nullptr) return failure(fmt::format("{}: cannot be written", file.string()));
  Writer writer(file, identity, stream);
  bool written = writer.put(identity.line);
  for (const auto& [cell, finished] : results.cells)
    written = written && writer.put(line_with_hash(identity, finished));
  if (!written || output->give_name(file.string()) != 0)
    return failure(fmt::format("{}: cannot be written: {}", file.string(), std::strerror(errno)));
  return std::pair(std::move(writer), std::move(results));
}

Result<void> Writer::add(const Finished& finished) {
  if (put(line_with_hash(identity_, finished))) return {};
  return failure(fmt::format("{}: cannot be written; --resume goes on with it", path_.string()));
}

bool Writer::put(std::string line) {
  line += '\n';
  return std::fwrite(line.data(), 1, line.size(), stream_.get()) == line.size() &&
         std::fflush(stream_.get()) == 0;
}

}  // namespace canhil::fault_matrix
