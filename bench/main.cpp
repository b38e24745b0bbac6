// hil-bench: plays every node but the target, and judges it.
#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/commands/bus.hpp"
#include "bench/commands/campaign.hpp"
#include "bench/commands/diverge.hpp"
#include "bench/commands/doctor.hpp"
#include "bench/commands/exit_code.hpp"
#include "bench/commands/report.hpp"
#include "bench/commands/run.hpp"
#include "bench/commands/schedulability.hpp"
#include "bench/scenario/nearest.hpp"
#include "dbc/command_line/command_line.hpp"
#include "messages/canhil.hpp"

namespace {

using canhil::command_line::Command;
using canhil::command_line::Program;
using canhil::commands::ExitCode;

/// What CLI11 makes of a word that is no subcommand says neither which there are nor which one was meant.
std::string unknown_subcommand(const Command& program, std::string_view word) {
  std::vector<std::string> names;
  for (const Command& command : program.subcommands()) names.push_back(command.name());
  if (word.starts_with('-') || std::ranges::find(names, word) != names.end()) return {};
  return fmt::format("subcommand '{}' is unknown, expected {}", word,
                     canhil::scenario::expected_instead(word, names));
}

/// The same of a word that is no option of the command.
std::string unknown_option(const Command& command, std::span<const std::string> words) {
  const std::vector<std::string> names = command.long_options();
  for (const std::string& word : words) {
    const std::string name = word.substr(0, word.find('='));
    if (!name.starts_with("--") || name == "--" || std::ranges::find(names, name) != names.end()) continue;
    const std::string meant = canhil::scenario::nearest(name, names);
    return fmt::format("option '{}' is unknown{}", name, meant.empty() ? "" : ", expected '" + meant + "'");
  }
  return {};
}

/// What was wrong, and where to read what is right.
std::string complaint(const Program& program, std::span<const std::string> words, std::string_view error) {
  std::string path = "hil-bench";
  Command command = program;
  while (!words.empty()) {
    const auto commands = command.subcommands();
    const auto named = std::ranges::find(commands, words.front(), &Command::name);
    if (named == commands.end()) break;
    command = *named;
    path += " " + words.front();
    words = words.subspan(1);
  }
  std::string unknown =
      path == "hil-bench" && !words.empty() ? unknown_subcommand(program, words.front()) : "";
  if (unknown.empty()) unknown = unknown_option(command, words);
  return fmt::format("{}; see {} --help", unknown.empty() ? error : unknown, path);
}

int run(int argc, char** argv) {
  Program program{
      "A hardware-in-the-loop bench over CAN for navigation and guidance estimators.\n"
      "Exit codes: 0 pass, 1 fail, 2 usage or configuration, 3 not measured.",
      fmt::format("hil-bench {} · DBC {:016x}", CANHIL_VERSION, canhil::messages::dbc_hash)};
  program.require_subcommands(1, 1);
  std::signal(SIGXFSZ,
              SIG_IGN);  // a file at its size limit is an error of write(), with a line that names the file
  int code = 0;
  canhil::commands::add_run(program, code);
  canhil::commands::add_report(program, code);
  canhil::commands::add_bus(program, code);
  canhil::commands::add_campaign(program, code);
  canhil::commands::add_diverge(program, code);
  canhil::commands::add_doctor(program, code);
  canhil::commands::add_schedulability(program, code);
  program.refuse_empty();
  const auto parsed = program.parse(argc, argv);
  if (!parsed) {
    const std::vector<std::string> words(argv + 1, argv + argc);
    return static_cast<int>(canhil::commands::complain({complaint(program, words, parsed.error().message)}));
  }
  return parsed->value_or(code);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {  // no memory, for one
    std::fprintf(stderr, "hil-bench: %s\n", error.what());
    return static_cast<int>(ExitCode::usage);
  }
}
