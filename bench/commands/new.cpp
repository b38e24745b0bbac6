// `hil-bench new`: writes a mapping or a scenario to begin with.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/commands/exit_code.hpp"
#include "bench/commands/program.hpp"
#include "bench/commands/read_dbc.hpp"
#include "bench/commands/subcommands.hpp"
#include "bench/drive/contract.hpp"
#include "bench/mapping/draft.hpp"
#include "bench/report/file.hpp"
#include "dbc/files/text_file.hpp"

namespace canhil::commands {
namespace {

namespace fs = std::filesystem;

// The arguments as given on the command line.
struct Arguments {
  std::string file, dbc, device, encoding, mapping, estimator;
};

// A file as another file names it: relative to its folder.
std::string beside(const std::string& file, const std::string& other) {
  std::error_code error;
  const fs::path folder = fs::absolute(other, error).parent_path();
  const fs::path named = fs::relative(file, folder, error);
  return error || named.empty() ? fs::absolute(file, error).string() : named.string();
}

ExitCode write(const std::string& file, const mapping::Draft& draft, std::string_view next) {
  if (auto written = report::write_file(file, draft.text); !written) return complain(written.error());
  fmt::print("{}: written; next: {}\n", one_line(file), one_line(next));
  if (draft.error) say(fmt::format("to mend first: {}", draft.error->message));
  return ExitCode::pass;
}

Result<void> check_new(const std::string& file) {
  std::error_code error;
  if (fs::exists(fs::symlink_status(file, error)))
    return failure(fmt::format("{}: exists already, expected a new file", file));
  return check_writable(file);
}

ExitCode new_mapping(const Arguments& arguments) {
  if (auto fine = check_new(arguments.file); !fine) return complain(fine.error());
  const auto database = read_dbc(arguments.dbc, arguments.encoding);
  if (!database) return complain(database.error());
  std::vector<std::string> nodes;
  for (const dbc::Node& node : database->nodes) nodes.push_back(node.name);
  if (std::ranges::find(nodes, arguments.device) == nodes.end())
    return complain(
        {fmt::format("--device '{}': {} has no such node, expected {}", arguments.device, arguments.dbc,
                     nodes.empty() ? "a DBC with nodes" : fmt::format("one of {}", fmt::join(nodes, ", ")))});
  const auto blocks =
      mapping::draft_of_mapping(*database, arguments.device, beside(arguments.dbc, arguments.file));
  const auto draft = mapping::joined(blocks, [&](const std::string& text) -> std::optional<Error> {
    const auto read = mapping::read_mapping(arguments.file, [&](const std::string& file) {
      return file == arguments.file ? Result<std::string>(text) : mapping::read_from_disk(file);
    });
    return read ? std::nullopt : std::optional(read.error());
  });
  return write(arguments.file, draft, fmt::format("hil-bench dbc check {}", arguments.file));
}

// The project's short flight of an estimator, as a scenario of the user's own.
ExitCode new_for_estimator(const Arguments& arguments) {
  std::vector<std::string> estimators;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(data_folder("flights"), error)) {
    if (!entry.path().filename().string().ends_with("_quick.toml")) continue;
    const auto text = read_text_file(entry.path(), "a scenario file", scenario::most_toml_bytes);
    if (!text) return complain(text.error());
    const auto scenario = drive::parse_scenario(*text, entry.path().string());
    if (!scenario) return complain(scenario.error());
    estimators.push_back(scenario->targets.front().estimator);
    if (estimators.back() == arguments.estimator)
      return write(arguments.file, {.text = *text},
                   fmt::format("hil-bench run {} --bus in-process", arguments.file));
  }
  if (error)
    return complain({fmt::format("{}: cannot be read: {}", data_folder("flights"), error.message())});
  std::ranges::sort(estimators);
  return complain({fmt::format("--estimator '{}': expected one of {}", arguments.estimator,
                               fmt::join(estimators, ", "))});
}

ExitCode new_scenario(const Arguments& arguments) {
  if (auto fine = check_new(arguments.file); !fine) return complain(fine.error());
  if (!arguments.estimator.empty()) return new_for_estimator(arguments);
  const auto mapping = mapping::read_mapping(arguments.mapping);
  if (!mapping) return complain(mapping.error());
  const auto blocks = mapping::draft_of_scenario(**mapping, beside(arguments.mapping, arguments.file));
  const auto draft = mapping::joined(blocks, [&](const std::string& text) -> std::optional<Error> {
    const auto read = drive::parse_scenario(text, arguments.file);
    return read ? std::nullopt : std::optional(read.error());
  });
  return write(arguments.file, draft, fmt::format("hil-bench run {} --target PROGRAM", arguments.file));
}

}  // namespace

void add_new(command_line::Command app, int& code) {
  const auto command =
      app.add_subcommand("new", "write a mapping or a scenario to begin with; no file is replaced");
  command.require_subcommands(1, 1);
  auto mapping = std::make_shared<Arguments>();
  const auto of_dbc =
      command.add_subcommand("mapping", "a mapping: what the names and units of a DBC's signals tell");
  of_dbc.add_option("FILE", mapping->file, "the new mapping, such as mine.mapping.toml").required();
  of_dbc.add_option("--dbc", mapping->dbc, "DBC file of the device's bus").required();
  of_dbc.add_option("--device", mapping->device, "the node of the DBC that is the device under test")
      .required();
  of_dbc.add_option("--encoding", mapping->encoding, encoding_help);
  of_dbc.on_given([&code, mapping] { code = static_cast<int>(new_mapping(*mapping)); });
  auto scenario = std::make_shared<Arguments>();
  const auto of_mapping =
      command.add_subcommand("scenario", "a scenario: for a mapping, or for an estimator of canhil");
  of_mapping.add_option("FILE", scenario->file, "the new scenario").required();
  const auto by_mapping =
      of_mapping.add_option("--mapping", scenario->mapping, "mapping of the device (TOML)");
  of_mapping
      .add_option("--estimator", scenario->estimator,
                  "estimator of canhil, in place of a mapping: the short flight of it")
      .excludes(by_mapping);
  of_mapping.on_given([&code, scenario] {
    if (scenario->mapping.empty() && scenario->estimator.empty())
      command_line::throw_required("--mapping or --estimator");
    code = static_cast<int>(new_scenario(*scenario));
  });
}

}  // namespace canhil::commands
