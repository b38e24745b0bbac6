// hil-bench dbc: checks and displays DBC files of this or any other project.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/commands/exit_code.hpp"
#include "bench/commands/read_dbc.hpp"
#include "bench/commands/subcommands.hpp"
#include "bench/drive/contract.hpp"
#include "bench/drive/flight.hpp"
#include "bench/mapping/check.hpp"
#include "bench/mapping/extract.hpp"
#include "bench/report/file.hpp"
#include "dbc/codegen/json.hpp"
#include "dbc/files/command_files.hpp"
#include "dbc/lint/lint.hpp"
#include "dbc/parser/parse.hpp"
#include "dbc/show/show.hpp"
#include "dbc/wireshark/script.hpp"

namespace canhil::commands {
namespace {

// The arguments as given on the command line.
struct LintArguments {
  std::vector<std::string> files;
  std::string sarif, encoding;
  bool json = false;
  bool strict = false;
};

struct ShowArguments {
  std::string file;
  std::string message, encoding;
  bool json = false;
};

struct WiresharkArguments {
  std::string file, encoding, out{report::to_stdout};
};

struct ExtractArguments {
  std::string mapping, log, play;
};

struct CheckArguments {
  std::string file, scenario;
  bool json = false;
};

ExitCode code_of(const Result<void>& written) { return written ? ExitCode::pass : complain(written.error()); }
// For people.
ExitCode shown(const std::string& text) { return code_of(report::show(text)); }
// For programs: JSON, CSV.
ExitCode printed(const std::string& text) { return code_of(report::write_stdout(text)); }

ExitCode write_findings(const LintArguments& arguments, const std::vector<dbc::Linted>& files) {
  if (!arguments.sarif.empty()) {
    const auto written = report::write(arguments.sarif, dbc::to_sarif(files));
    if (!written) return complain(written.error());
    if (arguments.sarif == report::to_stdout) return ExitCode::pass;
  }
  return arguments.json ? printed(dbc::to_json(files)) : shown(dbc::to_text(files));
}

ExitCode lint(const LintArguments& arguments) {
  if (arguments.json && arguments.sarif == report::to_stdout)
    return complain({"--json, --sarif -: both to standard output, expected one of them"});
  CommandFiles names;
  for (const std::string& file : arguments.files) names.reads("FILE", file);
  names.writes("--sarif", arguments.sarif);
  if (const auto fine = names.check(); !fine) return complain(fine.error());
  std::vector<dbc::Linted> files;
  for (const std::string& file : arguments.files) {
    auto linted = dbc::lint(file, arguments.encoding);
    if (!linted) return complain(linted.error());
    files.push_back(std::move(*linted));
  }
  if (const ExitCode code = write_findings(arguments, files); code != ExitCode::pass) return code;
  const auto is_refused = [&](const dbc::Linted& linted) {
    return !linted.loads || (arguments.strict && count(linted, dbc::Severity::warning) > 0);
  };
  return std::ranges::any_of(files, is_refused) ? ExitCode::fail : ExitCode::pass;
}

ExitCode show(const ShowArguments& arguments) {
  const auto database = read_dbc(arguments.file, arguments.encoding);
  if (!database) return complain(database.error());
  if (arguments.message.empty())
    return arguments.json ? printed(dbc::to_json(*database) + "\n") : shown(dbc::message_table(*database));
  const auto message = dbc::named_message(*database, arguments.message);
  if (!message) return complain({fmt::format("{}: {}", arguments.file, message.error().message)});
  return arguments.json ? printed(dbc::to_json(**message) + "\n") : shown(dbc::message_page(**message));
}

ExitCode wireshark(const WiresharkArguments& arguments) {
  CommandFiles files;
  files.reads("FILE", arguments.file);
  files.writes("--out", arguments.out);
  if (const auto fine = files.check(); !fine) return complain(fine.error());
  const auto database = read_dbc(arguments.file, arguments.encoding);
  if (!database) return complain(database.error());
  return code_of(report::write(arguments.out, dbc::wireshark_script(*database, arguments.file)));
}

std::string text_of(const mapping::Mapping& mapping, const std::vector<mapping::Remark>& remarks) {
  const mapping::MappedTarget& target = mapping.targets.front();
  std::string text;
  for (const mapping::Remark& one : remarks) {
    const bool warning = one.grade == mapping::Remark::Grade::warning;
    text += fmt::format("{}: {} {}: {} {}\n", target.file, warning ? "warning" : "note", one.rule,
                        one.subject, one.what);
  }
  text += fmt::format(
      "{}: {} messages played, {} heard, {} quantities reported{}; bus load", target.file,
      std::ranges::count_if(mapping.messages,
                            [&](const MessageInfo& m) { return !is_targets(m) && !mapping.is_of_events(m); }),
      mapping.hears.size(), target.quantities.size(),
      mapping.channels.empty()
          ? ""
          : fmt::format(", {} for events", mapping.channels.size() == 1
                                               ? "1 channel"
                                               : fmt::format("{} channels", mapping.channels.size())));
  std::string_view separator;
  for (const std::int64_t kbitps : {125, 250, 500, 1000}) {
    const double load = mapping::load_of(mapping, {.nominal = kbitps * 1000, .data = 4000 * kbitps});
    text += fmt::format("{} {:.1f} % at {} kbit/s", separator, load * 100, kbitps);
    separator = ",";
  }
  return text + "\n";
}

// The mapping of a scenario, and the values that its flight plays.
Result<mapping::FlownValues> flown_with(const std::string& file, const std::string& mapping,
                                        std::shared_ptr<const mapping::Mapping>& of_scenario) {
  auto scenario = drive::read_scenario(file);
  if (!scenario) return tl::unexpected(scenario.error());
  of_scenario = std::dynamic_pointer_cast<const mapping::Mapping>(scenario->binding);
  const bool is_own = std::ranges::any_of(scenario->binding->files, [&](const scenario::Binding::Files& one) {
    std::error_code unknown;
    return std::filesystem::equivalent(one.mapping, mapping, unknown);
  });
  if (of_scenario == nullptr || !is_own)
    return failure(fmt::format(
        "--scenario '{}': has no target with the mapping {}, expected a scenario of it", file, mapping));
  scenario->faults.clear();
  const auto truth = drive::make_truth(*scenario);
  if (!truth) return failure(fmt::format("{}: {}", file, truth.error().message));
  auto one = drive::make_flight(*scenario, *truth, 0), other = drive::make_flight(*scenario, *truth, 1);
  for (const auto* flight : {&one, &other}) {
    if (!*flight) return failure(fmt::format("{}: {}", file, flight->error().message));
  }
  return mapping::flown_values(*of_scenario, drive::run_of(*scenario, *truth, one->per_run_truth, 0),
                               drive::run_of(*scenario, *truth, other->per_run_truth, 1));
}

ExitCode check(const CheckArguments& arguments) {
  auto mapping = mapping::read_mapping(arguments.file);
  if (!mapping) return complain(mapping.error());
  mapping::FlownValues values;
  if (!arguments.scenario.empty()) {
    auto flown = flown_with(arguments.scenario, arguments.file, *mapping);
    if (!flown) return complain(flown.error());
    values = std::move(*flown);
  }
  const auto remarks = mapping::remarks_on(**mapping, values);
  const bool warned = std::ranges::any_of(
      remarks, [](const mapping::Remark& one) { return one.grade == mapping::Remark::Grade::warning; });
  std::string text = text_of(**mapping, remarks);
  if (arguments.json) {
    auto all = nlohmann::ordered_json::array();
    for (const mapping::Remark& one : remarks)
      all.push_back({{"severity", one.grade == mapping::Remark::Grade::warning ? "warning" : "note"},
                     {"rule", one.rule},
                     {"subject", one.subject},
                     {"what", one.what}});
    text = all.dump(1) + "\n";
  }
  if (const ExitCode code = arguments.json ? printed(text) : shown(text); code != ExitCode::pass) return code;
  return warned ? ExitCode::fail : ExitCode::pass;
}

void add_lint(command_line::Command command, int& code) {
  auto arguments = std::make_shared<LintArguments>();
  const auto own = command.add_subcommand("lint", "what is odd about DBC files, and what follows from it");
  own.add_option("FILE", arguments->files, "DBC files").required();
  own.add_flag("--json", arguments->json, "JSON instead of a line for each finding");
  own.add_option("--sarif", arguments->sarif,
                 "also as SARIF 2.1.0, to a file; -: to stdout, in place of the text");
  own.add_option("--encoding", arguments->encoding, encoding_help);
  own.add_flag("--strict", arguments->strict, "exit code 1 with warnings too");
  own.on_given([&code, arguments] { code = static_cast<int>(lint(*arguments)); });
}

void add_check(command_line::Command command, int& code) {
  auto arguments = std::make_shared<CheckArguments>();
  const auto own =
      command.add_subcommand("check", "what a mapping leaves out, and what its signals cannot carry");
  own.add_option("MAPPING", arguments->file, "mapping (TOML), which names its DBC").required();
  own.add_option("--scenario", arguments->scenario,
                 "a scenario of the mapping: also say which of its values the signals cut off or round away");
  own.add_flag("--json", arguments->json, "JSON instead of a line for each remark");
  own.on_given([&code, arguments] { code = static_cast<int>(check(*arguments)); });
}

ExitCode extract(const ExtractArguments& arguments) {
  const auto mapping = mapping::read_mapping(arguments.mapping);
  if (!mapping) return complain(mapping.error());
  const auto extracted = mapping::extract(**mapping, arguments.play, arguments.log);
  if (!extracted) return complain(extracted.error());
  if (extracted->incomplete > 0)
    say(fmt::format("{}: {} groups of {} were not whole and are left out, {} are there", arguments.log,
                    extracted->incomplete, arguments.play, extracted->rows));
  if (extracted->invalid > 0)
    say(fmt::format("{}: {} groups of {} have a value that says it is invalid and are left out",
                    arguments.log, extracted->invalid, arguments.play));
  return printed(extracted->csv);
}

void add_extract(command_line::Command command, int& code) {
  auto arguments = std::make_shared<ExtractArguments>();
  const auto own = command.add_subcommand(
      "extract", "a log of a bus with another DBC as the CSV of a sensor, which a scenario can send again");
  own.add_option("MAPPING", arguments->mapping, "mapping (TOML), which names the DBC").required();
  own.add_option("LOG", arguments->log, "log of the bus, in any format that is read").required();
  own.add_option("--play", arguments->play, "the play that was recorded: its last message").required();
  own.on_given([&code, arguments] { code = static_cast<int>(extract(*arguments)); });
}

void add_show(command_line::Command command, int& code) {
  auto arguments = std::make_shared<ShowArguments>();
  const auto own = command.add_subcommand("show", "the messages of a DBC, or the layout of one of them");
  own.add_option("FILE", arguments->file, "the DBC").required();
  own.add_option("MESSAGE", arguments->message, "its name or id (291, 0x123)");
  own.add_option("--encoding", arguments->encoding, encoding_help);
  own.add_flag("--json", arguments->json, "JSON instead of text");
  own.on_given([&code, arguments] { code = static_cast<int>(show(*arguments)); });
}

void add_wireshark(command_line::Command command, int& code) {
  auto arguments = std::make_shared<WiresharkArguments>();
  const auto own = command.add_subcommand(
      "wireshark", "a script with which tshark and Wireshark decode the messages of a DBC");
  own.add_option("FILE", arguments->file, "the DBC").required();
  own.add_option("--encoding", arguments->encoding, encoding_help);
  own.add_option("--out", arguments->out, "the script, *.lua (default: stdout)");
  own.on_given([&code, arguments] { code = static_cast<int>(wireshark(*arguments)); });
}

}  // namespace

void add_dbc(command_line::Command app, int& code) {
  const auto command = app.add_subcommand("dbc", "what a DBC file says, and what is odd about it");
  command.require_subcommands(1, 1);
  add_lint(command, code);
  add_show(command, code);
  add_check(command, code);
  add_extract(command, code);
  add_wireshark(command, code);
  command.add_subcommand("rules", "what lint finds, as a table in Markdown").on_given([&code] {
    code = static_cast<int>(shown(dbc::rule_table()));
  });
}

}  // namespace canhil::commands
