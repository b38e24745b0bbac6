// `hil-bench faults`: a campaign of scenarios, each with each fault.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/campaign/campaign.hpp"
#include "bench/commands/campaign.hpp"
#include "bench/commands/campaign_flight.hpp"
#include "bench/drive/contract.hpp"
#include "bench/scenario/setting.hpp"
#include "dbc/files/command_files.hpp"
#include "dbc/files/text_file.hpp"

namespace canhil::commands {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t most_runs = 100'000;

// The arguments as given on the command line.
struct Arguments {
  std::vector<std::string> scenarios;
  std::string set;
  std::optional<std::uint64_t> seed, runs;
  CampaignFlight flight;
};
struct MergeArguments {
  std::vector<std::string> files;
  CampaignReports reports;
};

// The name of a scenario's file, without folder and extension, or, if that is not unique, the whole path.
std::string name_of(const std::string& file, const std::vector<std::string>& all) {
  const auto stem = [](const std::string& path) { return fs::path(path).stem().string(); };
  const auto same =
      std::ranges::count_if(all, [&](const std::string& other) { return stem(other) == stem(file); });
  return same > 1 ? file : stem(file);
}

// The campaign file that stands for the arguments.
std::string text_of(const Arguments& arguments) {
  std::string text =
      fmt::format("title = {}\nruns = {}\n\n[faults]\n",
                  scenario::toml_string(fmt::format("Faults: {}", fmt::join(arguments.scenarios, ", "))),
                  arguments.runs.value_or(1));
  text += arguments.set.empty() ? fmt::format("seed = {}\n", arguments.seed.value_or(1))
                                : fmt::format("set = {}\n", scenario::toml_string(arguments.set));
  for (const std::string& file : arguments.scenarios)
    text +=
        fmt::format("\n[[variant]]\nname = {}\nscenario = {}\n",
                    scenario::toml_string(name_of(file, arguments.scenarios)), scenario::toml_string(file));
  return text;
}

Result<campaign::Campaign> campaign_of(const Arguments& arguments) {
  if (!arguments.set.empty() && arguments.seed)
    return failure("--seed: has no effect beside --set, expected one of the two");
  for (const std::string& file : arguments.scenarios) {  // its own line says what is wrong in it
    if (auto read = drive::read_scenario(file); !read) return tl::unexpected(read.error());
  }
  if (!arguments.set.empty()) {
    if (auto read = read_text_file(arguments.set, "a set of faults", scenario::most_toml_bytes); !read)
      return tl::unexpected(read.error());
  }
  return campaign::parse_campaign(text_of(arguments), std::string(faults_name), [](const std::string& name) {
    return read_text_file(name, "a file", scenario::most_toml_bytes);
  });
}

ExitCode execute(const Arguments& arguments) {
  if (auto distinct = check_distinct_inputs(arguments.scenarios); !distinct)
    return complain(distinct.error());
  const auto campaign = campaign_of(arguments);
  if (!campaign) return complain(campaign.error());
  return fly(*campaign, arguments.flight, std::string(faults_name));
}

}  // namespace

void add_faults(command_line::Command app, int& code) {
  auto arguments = std::make_shared<Arguments>();
  const auto command = app.add_subcommand(std::string(faults_name), std::string(faults_summary));
  const auto scenarios = command.add_option("SCENARIO", arguments->scenarios, "scenario files (TOML)");
  command.add_option("--set", arguments->set,
                     "file of [[fault]] tables, each a row; those with the same 'together' fly at once "
                     "(default: each kind on each node, at times drawn from the seed)");
  command.add_number("--seed", arguments->seed, "of what is drawn (default: 1)");
  command.add_number("--runs", arguments->runs, "flights a cell, each with another seed (default: 1)", 1,
                     most_runs);
  add_flight(command, arguments->flight);
  command.require_subcommands(0, 1);
  auto merging = std::make_shared<MergeArguments>();
  const auto merge_command = command.add_subcommand("merge", "the matrix of shards put together");
  merge_command.add_option("RESULTS", merging->files, "results of the shards").required();
  add_reports(merge_command, merging->reports);
  merge_command.on_given(
      [&code, merging] { code = static_cast<int>(report_on(merging->files, merging->reports)); });
  command.on_given([&code, arguments, command, scenarios] {
    if (command.subcommand_given()) return;
    if (!scenarios.given()) command_line::throw_required("SCENARIO, or merge");
    code = static_cast<int>(execute(*arguments));
  });
}

}  // namespace canhil::commands
