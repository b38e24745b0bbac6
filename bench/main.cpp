// hil-bench: plays every node but the target, and judges it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
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
#include "dbc/realtime/command_line.hpp"
#include "messages/canhil.hpp"

namespace {

using canhil::commands::ExitCode;

/// What CLI11 makes of a word that is no subcommand says neither which there are nor which one was meant.
std::string unknown_subcommand(const CLI::App& app, std::string_view word) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  if (word.starts_with('-') || std::ranges::find(names, word) != names.end()) return {};
  return fmt::format("subcommand '{}' is unknown, expected {}", word,
                     canhil::scenario::expected_instead(word, names));
}

/// The same of a word that is no option of the command.
std::string unknown_option(const CLI::App& command, std::span<const std::string> words) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  for (const std::string& word : words) {
    const std::string name = word.substr(0, word.find('='));
    if (!name.starts_with("--") || name == "--" || std::ranges::find(names, name) != names.end()) continue;
    const std::string meant = canhil::scenario::nearest(name, names);
    return fmt::format("option '{}' is unknown{}", name, meant.empty() ? "" : ", expected '" + meant + "'");
  }
  return {};
}

/// What was wrong, and where to read what is right.
std::string complaint(const CLI::App& app, std::span<const std::string> words, std::string_view error) {
  std::string path = "hil-bench";
  const CLI::App* command = &app;
  while (!words.empty()) {
    const auto commands = command->get_subcommands(nullptr);
    const auto named = std::ranges::find(commands, words.front(), &CLI::App::get_name);
    if (named == commands.end()) break;
    command = *named;
    path += " " + words.front();
    words = words.subspan(1);
  }
  std::string unknown = command == &app && !words.empty() ? unknown_subcommand(app, words.front()) : "";
  if (unknown.empty()) unknown = unknown_option(*command, words);
  return fmt::format("{}; see {} --help", unknown.empty() ? error : unknown, path);
}

int run(int argc, char** argv) {
  CLI::App app{
      "A hardware-in-the-loop bench over CAN for navigation and guidance estimators.\n"
      "Exit codes: 0 pass, 1 fail, 2 usage or configuration, 3 not measured."};
  app.require_subcommand(1);
  app.set_version_flag("--version", [] {
    return fmt::format("hil-bench {} · DBC {:016x}", CANHIL_VERSION, canhil::messages::dbc_hash);
  });
  std::signal(SIGXFSZ,
              SIG_IGN);  // a file at its size limit is an error of write(), with a line that names the file
  int code = 0;
  canhil::commands::add_run(app, code);
  canhil::commands::add_report(app, code);
  canhil::commands::add_bus(app, code);
  canhil::commands::add_campaign(app, code);
  canhil::commands::add_diverge(app, code);
  canhil::commands::add_doctor(app, code);
  canhil::commands::add_schedulability(app, code);
  canhil::realtime::refuse_empty(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    const std::vector<std::string> words(argv + 1, argv + argc);
    std::fprintf(stderr, "hil-bench: %s\n", complaint(app, words, error.what()).c_str());
    return static_cast<int>(ExitCode::usage);
  }
  return code;
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
