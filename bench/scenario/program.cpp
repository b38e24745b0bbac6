#include "bench/scenario/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <utility>

#include "bench/processes/command.hpp"
#include "bench/scenario/commands.hpp"
#include "bench/scenario/node_program.hpp"
#include "bench/scenario/section.hpp"
#include "bench/world/hash.hpp"
#include "dbc/files/text_file.hpp"

namespace canhil::scenario {
namespace {

std::vector<processes::ProgramSettings::Parameter> read_parameters(Section& section) {
  std::vector<processes::ProgramSettings::Parameter> parameters;
  auto table = section.optional_table(
      {"parameters",
       "Parameters of the program, NAME = number or text; it reads them before its first step."});
  if (!table) return parameters;
  for (const std::string& name : table->keys()) {
    constexpr std::string_view expected = "a name without blanks";
    if (name.empty() || name.find_first_of(" \t\r\n") != std::string::npos)
      table->reject(name, "is not a name", expected);
    if (table->holds_text(name))
      parameters.emplace_back(name, table->text(name));
    else
      parameters.emplace_back(name, table->plain_number(name, Limits{}));
  }
  table->finish();
  return parameters;
}

// The files that the command names belong to the scenario: a run with a changed program is another run.
void add_files(Section& section, const std::vector<std::string>& words) {
  constexpr std::size_t most_bytes = 256 * mebibyte;
  for (const std::string& word : words) {
    std::error_code ignored;
    const std::string path = section.beside(word);
    if (!std::filesystem::is_regular_file(path, ignored)) continue;
    const auto content = read_text_file(path, "a file of the program", most_bytes);
    if (!content) continue;
    section.files().push_back(path);
    std::uint64_t& hash = section.files_hash();
    hash = world::fnv1a_64(*content, hash == 0 ? world::fnv1a_64("") : hash);
  }
}

std::chrono::microseconds read_patience(Section& section, const Key& key, double usual_s) {
  constexpr double hour_s = 3600;
  return std::chrono::microseconds(section.time_us(key, Limits::above(0, hour_s), usual_s));
}

}  // namespace

std::optional<processes::ProgramSettings> read_program(Section& section) {
  processes::ProgramSettings own;
  own.command = section.text({"command",
                              "The program and its arguments, as in a shell without variables and patterns. "
                              "It runs in the folder of the scenario file. A plant or a sensor is also "
                              "started when the scenario is read, to ask for its inputs and outputs."});
  own.folder = section.beside("");
  own.starts_within = read_patience(
      section, {"starts_within_s", "Wall time in which the program must report its inputs and outputs."}, 30);
  own.answers_within = read_patience(
      section, {"answers_within_s", "Wall time in which the program must answer each step."}, 5);
  own.parameters = read_parameters(section);
  if (own.command.empty() || section.error()) return std::nullopt;
  auto words = processes::words_of(own.command);
  if (!words) {
    section.reject("command", words.error());
    return std::nullopt;
  }
  own.words = *std::move(words);
  add_files(section, own.words);
  if (!may_execute(section, "command", fmt::format("is a program ('{}')", own.command))) return std::nullopt;
  return own;
}

std::vector<NodeProgram> read_node_programs(Section& root) {
  std::vector<NodeProgram> programs;
  if (!root.has("node")) {
    root.optional("node");
    return programs;
  }
  for (Section& section : root.tables("node")) {
    NodeProgram node;
    node.name = section.text({"name", "Name of the node, for reports."});
    if (node.name == "control")
      section.reject("name", "is that of a program at the socket of --control", "another name");
    if (std::ranges::find(programs, node.name, &NodeProgram::name) != programs.end())
      section.reject("name", fmt::format("'{}' is the name of another node", node.name), "a name of its own");
    if (auto program = read_program(section)) node.program = *std::move(program);
    section.finish();
    programs.push_back(std::move(node));
  }
  return programs;
}

}  // namespace canhil::scenario
