// Makes the scenario of a flight of the matrix, in memory or as a self-contained file.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <sstream>

#include "bench/drive/contract.hpp"
#include "bench/fault_matrix/plan.hpp"
#include "bench/fault_matrix/response.hpp"
#include "bench/scenario/binding.hpp"
#include "dbc/files/text_file.hpp"

namespace canhil::fault_matrix {
namespace {

using scenario::Setting;

std::string seconds_of(std::int64_t t_us) { return fmt::format("{}", static_cast<double>(t_us) / 1e6); }

// By how much a line changes the nesting of brackets; strings and comments are ignored.
int deeper_by(const std::string& line) {
  int depth = 0;
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote != 0) {
      if (c == '\\' && quote == '"') ++i;
      if (c == quote) quote = 0;
    } else if (c == '#') {
      break;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return depth;
}

// The line, in which the path has been made absolute.
std::string with_whole_path(const std::string& line, const std::filesystem::path& folder) {
  static const std::regex names(R"(^(\s*(?:recorded|file|mapping)\s*=\s*")([^"/][^"]*)(".*)$)");
  std::smatch match;
  if (!std::regex_match(line, match, names)) return line;
  std::error_code unknown;
  return match[1].str() +
         std::filesystem::absolute(folder / match[2].str(), unknown).lexically_normal().string() +
         match[3].str();
}

}  // namespace

const Setting* FaultText::find(std::string_view key) const {
  const auto found = std::ranges::find(keys, key, &Setting::key);
  return found == keys.end() ? nullptr : &*found;
}

void FaultText::set(std::string_view key, std::string value) {
  const auto found = std::ranges::find(keys, key, &Setting::key);
  if (found != keys.end())
    found->value = std::move(value);
  else
    keys.push_back({.key = std::string(key), .value = std::move(value), .elements = {}});
}

std::string FaultText::in_line() const {
  std::string text;
  for (const Setting& key : keys)
    text += fmt::format("{} {} = {}", text.empty() ? "{" : ",", key.key, key.value);
  return text + " }";
}

bool operator==(const FaultText& a, const FaultText& b) { return a.in_line() == b.in_line(); }

Result<Column> read_column(const std::string& file) {
  auto text = read_text_file(file, "a scenario file", scenario::most_toml_bytes);
  if (!text) return tl::unexpected(text.error());
  auto read = drive::parse_scenario(*text, file);
  if (!read) return tl::unexpected(read.error());
  if (!read->binding->handshake)
    return failure(fmt::format("{}: has a mapping, expected a scenario of canhil's own contract", file));
  return Column{.file = file, .text = std::move(*text), .scenario = std::move(*read)};
}

Result<scenario::Scenario> scenario_of(const Column& column, std::uint64_t run,
                                       const std::vector<FaultText>& faults, std::int64_t duration_us) {
  std::string all, checks;
  for (const FaultText& fault : faults) all += (all.empty() ? "" : ", ") + fault.in_line();
  for (const std::string_view check : judged_by)
    checks += fmt::format("{}{{ kind = \"{}\" }}", checks.empty() ? "" : ", ", check);
  std::vector<Setting> settings{
      {.key = "check", .value = fmt::format("[{}]", checks), .elements = {}},
      {.key = "seed", .value = std::to_string(column.scenario.seed + run), .elements = {}}};
  if (duration_us > 0)
    settings.push_back({.key = "duration_s", .value = seconds_of(duration_us), .elements = {}});
  if (!faults.empty())
    settings.push_back({.key = "fault", .value = fmt::format("[{}]", all), .elements = {}});
  // Removes the [[fault]] tables from the text, because a setting can only replace a key, not remove it.
  const std::string text = faults.empty() ? without_tables(column.text, {"fault"}) : column.text;
  return drive::parse_scenario(text, column.file, settings);
}

std::string without_tables(const std::string& text, const std::vector<std::string>& names) {
  std::istringstream lines(text);
  std::string left, line;
  bool out = false;
  for (int depth = 0; std::getline(lines, line);) {
    const std::size_t begin = line.find_first_not_of(" \t");
    if (depth == 0 && begin != std::string::npos && line[begin] == '[') {
      out = std::ranges::any_of(names, [&](const std::string& name) {
        static const std::string open = "[[", dot = "[";
        return line.compare(begin, name.size() + 4, open + name + "]]") == 0 ||
               line.compare(begin, name.size() + 2, dot + name + ".") == 0;
      });
    } else {
      depth += deeper_by(line);
    }
    if (!out) left += line + "\n";
  }
  return left;
}

std::string text_of(const Column& column, std::uint64_t run, const std::vector<FaultText>& faults,
                    std::int64_t duration_us, const std::string& check, const std::string& comment) {
  const std::filesystem::path folder = std::filesystem::path(column.file).parent_path();
  std::istringstream lines(without_tables(column.text, {"fault", "check"}));
  std::string text = comment, line;
  for (bool top = true; std::getline(lines, line);) {
    static const std::regex seed(R"(^\s*seed\s*=.*$)"), duration(R"(^\s*duration_s\s*=.*$)");
    top = top &&
          !(line.find_first_not_of(" \t") != std::string::npos && line[line.find_first_not_of(" \t")] == '[');
    if (top && std::regex_match(line, seed))
      line = fmt::format("seed = {}", column.scenario.seed + run);
    else if (top && duration_us > 0 && std::regex_match(line, duration))
      line = fmt::format("duration_s = {}", seconds_of(duration_us));
    text += with_whole_path(line, folder) + "\n";
  }
  while (text.ends_with("\n\n")) text.pop_back();
  for (const FaultText& fault : faults) {
    text += "\n[[fault]]\n";
    for (const Setting& key : fault.keys) text += fmt::format("{} = {}\n", key.key, key.value);
  }
  return text + fmt::format("\n[[check]]\nkind = \"{}\"\n", check);
}

}  // namespace canhil::fault_matrix
