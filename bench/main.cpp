// hil-bench: plays every node but the target, and judges it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
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
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    const std::string unknown = argc > 1 ? unknown_subcommand(app, argv[1]) : "";
    std::fprintf(stderr, "hil-bench: %s; see hil-bench --help\n",
                 unknown.empty() ? error.what() : unknown.c_str());
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
