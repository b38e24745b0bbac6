#include "bench/commands/program.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/commands/exit_code.hpp"
#include "bench/scenario/nearest.hpp"
#include "dbc/logs/remarks.hpp"
#include "dbc/version/version.hpp"
#include "messages/canhil.hpp"

namespace canhil::commands {
namespace {

using command_line::Command;
using command_line::Program;

std::filesystem::path own_file() {
  std::error_code unknown;
  return std::filesystem::read_symlink("/proc/self/exe", unknown);
}

/// The error message for an unknown subcommand; empty if `word` is an option or a known subcommand. This
/// message replaces the message of CLI11, which lists neither the choices nor the likely intent.
std::string unknown_subcommand(const Command& program, std::string_view word) {
  std::vector<std::string> names;
  for (const Command& command : program.subcommands()) names.push_back(command.name());
  if (word.starts_with('-') || std::ranges::find(names, word) != names.end()) return {};
  return fmt::format("subcommand '{}' is unknown, expected {}", word,
                     scenario::expected_instead(word, names));
}

/// The error message for an unknown option of the command; empty if all options are known.
std::string unknown_option(const Command& command, std::span<const std::string> words) {
  const std::vector<std::string> names = command.long_options();
  for (const std::string& word : words) {
    const std::string name = word.substr(0, word.find('='));
    if (!name.starts_with("--") || name == "--" || std::ranges::find(names, name) != names.end()) continue;
    const std::string meant = scenario::nearest(name, names);
    return fmt::format("option '{}' is unknown{}", name, meant.empty() ? "" : ", expected '" + meant + "'");
  }
  return {};
}

/// The error message, with a hint where the user finds help.
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

int run(int argc, char** argv, std::span<const AddCommand> add_commands) {
  Program program{
      "A hardware-in-the-loop bench over CAN for navigation and guidance estimators.\n"
      "Exit codes: 0 pass, 1 fail, 2 usage or configuration, 3 not measured.",
      fmt::format("{} · DBC {:016x}, on the bus {:06x}", version_line(own_file().filename().string()),
                  messages::dbc_hash, messages::exchange_hash24())};
  program.require_subcommands(1, 1);
  int code = 0;
  for (const AddCommand add : add_commands) add(program, code);
  program.refuse_no_values();
  const auto parsed = program.parse(argc, argv);
  if (!parsed) {
    const std::vector<std::string> words(argv + 1, argv + argc);
    return static_cast<int>(complain({complaint(program, words, parsed.error().message)}));
  }
  return parsed->value_or(code);
}

}  // namespace

int guarded(const std::function<int()>& run) {
  // With these signals ignored, a file at its size limit or a closed pipe is reported as an error of write(),
  // and other reports are still written.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  try {
    const LogRemarks remarks;
    const int code = run();
    for (const std::string& line : remarks.lines()) say(line);
    return command_line::finish("hil-bench", code);
  } catch (const std::exception& error) {
    return static_cast<int>(complain({error.what()}));
  }
}

int run_program(int argc, char** argv, std::span<const AddCommand> add_commands) {
  return guarded([&] { return run(argc, argv, add_commands); });
}

std::string own_folder() { return own_file().parent_path().string(); }

std::string data_folder(const std::string& name) {
  std::error_code unknown;
  const std::filesystem::path installed = std::filesystem::path(own_folder()) / "../share/canhil" / name;
  return std::filesystem::is_directory(installed, unknown) ? installed.lexically_normal().string()
                                                           : CANHIL_DATA "/" + name;
}

int become(const std::string& program, std::vector<std::string> words) {
  const std::string path = own_folder() + "/" + program;
  words.insert(words.begin(), "hil-bench");  // the program's name in the help text
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execv(path.c_str(), arguments.data());
  return static_cast<int>(
      complain({fmt::format("{}: {}, expected it beside hil-bench: cmake --build build/default --target {}",
                            path, std::strerror(errno), program)}));
}

}  // namespace canhil::commands
