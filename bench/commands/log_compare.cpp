// hil-bench log compare: compares the time stamps of two recordings of one bus.
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>

#include "bench/commands/exit_code.hpp"
#include "bench/commands/read_dbc.hpp"
#include "bench/commands/subcommands.hpp"
#include "bench/recordings/compare_stamps.hpp"
#include "bench/report/file.hpp"
#include "dbc/files/command_files.hpp"
#include "dbc/parser/parse.hpp"

namespace canhil::commands {
namespace {

struct Arguments {
  std::string a, b, dbc, json;
};

ExitCode compare(const Arguments& arguments) {
  // Rejects a log that is compared with itself.
  if (auto distinct = check_distinct_inputs({arguments.a, arguments.b}); !distinct)
    return complain(distinct.error());
  CommandFiles files;
  files.reads({{"A", arguments.a}, {"B", arguments.b}, {"--dbc", arguments.dbc}});
  files.writes("--json", arguments.json);
  if (auto fine = files.check(); !fine) return complain(fine.error());
  std::optional<dbc::Database> database;
  if (!arguments.dbc.empty()) {
    auto read = read_dbc(arguments.dbc);
    if (!read) return complain(read.error());
    database = std::move(*read);
  }
  const auto name = [&](const recordings::StampDifference& one) -> std::string {
    if (!database) return {};
    const dbc::Message* message = dbc::find_message(*database, one.id, one.extended);
    return message == nullptr ? "" : message->name;
  };
  const auto compared = recordings::compare_stamps(arguments.a, arguments.b);
  if (!compared) return complain(compared.error());
  if (!arguments.json.empty()) {
    if (auto written = report::write(arguments.json, recordings::to_json(*compared, name)); !written)
      return complain(written.error());
  }
  if (arguments.json != report::to_stdout) {
    if (auto shown = report::show(recordings::to_text(*compared, name)); !shown)
      return complain(shown.error());
  }
  if (compared->all.count == 0) return ExitCode::not_measured;
  return compared->all.only_in_a + compared->all.only_in_b == 0 ? ExitCode::pass : ExitCode::fail;
}

}  // namespace

void add_log_compare(command_line::Command log, int& code) {
  auto arguments = std::make_shared<Arguments>();
  const auto command = log.add_subcommand(
      "compare",
      "how far the stamps of two recordings of one bus are apart: 0 every frame is in both, "
      "1 some are in one alone, 3 none is in both");
  command.add_option("A", arguments->a, "log of any of these formats").required();
  command.add_option("B", arguments->b, "log of the same bus by another adapter").required();
  command.add_option("--dbc", arguments->dbc, "DBC file with the names of the messages");
  command.add_option("--json", arguments->json,
                     "write the figures as JSON to a file; -: to stdout, in place of the text");
  command.on_given([&code, arguments] { code = static_cast<int>(compare(*arguments)); });
}

}  // namespace canhil::commands
