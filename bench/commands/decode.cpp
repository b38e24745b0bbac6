// hil-bench decode: the values of recorded frames.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <csignal>
#include <memory>
#include <string>
#include <vector>

#include "bench/commands/exit_code.hpp"
#include "bench/commands/read_dbc.hpp"
#include "bench/commands/subcommands.hpp"
#include "bench/recordings/decode.hpp"
#include "bench/report/file.hpp"
#include "dbc/files/command_files.hpp"

namespace canhil::commands {
namespace {

// The arguments as given on the command line.
struct Arguments {
  std::string log, dbc, encoding, format = "text", out{report::to_stdout};
  std::vector<std::string> only;
  bool since_1970 = false, j1939 = false;
};

recordings::Format format_of(const std::string& name) {
  return name == "csv"     ? recordings::Format::csv
         : name == "jsonl" ? recordings::Format::json_lines
                           : recordings::Format::text;
}

std::string counted(std::uint64_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

void say_left_out(const recordings::LeftOut& left_out) {
  if (left_out.frames > 0)
    say(fmt::format("{} left out, of no message: {}", counted(left_out.frames, "frame"),
                    fmt::join(left_out.ids, ", ")));
  if (left_out.ambiguous > 0)
    say(fmt::format("{} left out, whose parameter group the DBC has only for several other sources: {}",
                    counted(left_out.ambiguous, "frame"), fmt::join(left_out.ambiguous_ids, ", ")));
  if (left_out.incomplete > 0)
    say(fmt::format("{} of several frames left out, a frame lacks", counted(left_out.incomplete, "message")));
  if (left_out.short_frames > 0)
    say(fmt::format("{} shorter than the message, {} missing", counted(left_out.short_frames, "frame"),
                    counted(left_out.missing, "signal")));
}

ExitCode execute(const Arguments& arguments) {
  const auto database = read_dbc(arguments.dbc, arguments.encoding);
  if (!database) return complain(database.error());
  CommandFiles files;
  files.reads("LOG", arguments.log);
  files.reads("--dbc", arguments.dbc);
  files.writes("--out", arguments.out);
  if (auto fine = files.check(); !fine) return complain(fine.error());
  const recordings::DecodeOptions options{.format = format_of(arguments.format),
                                          .only = arguments.only,
                                          .since_1970 = arguments.since_1970,
                                          .j1939 = arguments.j1939};
  Result<recordings::LeftOut> decoded = recordings::LeftOut{};
  Result<void> written;
  if (arguments.out == report::to_stdout) {
    std::signal(SIGPIPE, SIG_DFL);  // a closed pipe, as with `| head`, ends the program silently
    std::string some;
    decoded = recordings::decode(arguments.log, *database, options, [&](std::string_view part) {
      constexpr std::size_t enough = 1 << 16;
      some += part;
      if (some.size() < enough || !written) return;
      written = report::write_stdout(some);
      some.clear();
    });
    if (written) written = report::write_stdout(some);
  } else {
    written = write_file_unless_failed(arguments.out, [&](const Sink& give) -> Result<void> {
      decoded = recordings::decode(arguments.log, *database, options, give);
      return decoded ? Result<void>() : tl::unexpected(decoded.error());
    });
  }
  if (!decoded) return complain(decoded.error());
  if (!written) return complain(written.error());
  say_left_out(*decoded);
  return ExitCode::pass;
}

}  // namespace

void add_decode(command_line::Command app, int& code) {
  auto arguments = std::make_shared<Arguments>();
  const auto command = app.add_subcommand("decode", "the frames of a log as values, by a DBC file");
  command.add_option("LOG", arguments->log, log_to_read).required();
  command.add_option("--dbc", arguments->dbc, "DBC file of the messages").required();
  command.add_option("--encoding", arguments->encoding, encoding_help);
  command
      .add_option("--format", arguments->format,
                  "text; csv: a column a signal; jsonl: a JSON object a line (default: text)")
      .one_of({"text", "csv", "jsonl"});
  command.add_option("--only", arguments->only, "name of a message; may be given again (default: all)")
      .one_word_each();
  command.add_flag("--since-1970", arguments->since_1970,
                   "times since 1970, UTC (default: since the first frame)");
  command.add_flag(
      "--j1939", arguments->j1939,
      "29-bit ids by their parameter group, from any source (default: those that the DBC marks)");
  command.add_option("--out", arguments->out, "file (default: stdout)");
  command.on_given([&code, arguments] { code = static_cast<int>(execute(*arguments)); });
}

}  // namespace canhil::commands
