// hil-bench-paper: the program for `hil-bench campaign --paper NAME`. Flies the campaigns of a paper, prints
// the tables, and writes the page.
#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "bench/campaign/campaign.hpp"
#include "bench/commands/exit_code.hpp"
#include "bench/commands/interrupt.hpp"
#include "bench/commands/program.hpp"
#include "bench/commands/progress_line.hpp"
#include "bench/papers/names.hpp"
#include "bench/papers/paper.hpp"
#include "dbc/command_line/command_line.hpp"
#include "dbc/text/escape.hpp"
#include "dbc/version/version.hpp"

namespace canhil::commands {
namespace {

// The arguments as given on the command line.
struct Arguments {
  std::string paper;
  std::string folder;  // empty: paper-NAME in the current folder
  std::optional<std::uint64_t> runs;
  bool unrounded = false;
  std::string exact;
};

ExitCode reproduce(const Arguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  const ProgressLine line;
  catch_interrupts();
  const auto reproduced = papers::reproduce(
      {.paper = arguments.paper,
       .folder = arguments.folder.empty() ? fmt::format("paper-{}", arguments.paper) : arguments.folder,
       .runs = arguments.runs,
       .rounding = arguments.unrounded ? Rounding::none : Rounding::as_on_the_bus,
       .exact = arguments.exact,
       .progress =
           [&](std::string_view campaign, std::size_t done, std::size_t total) {
             line.show([&] { return fmt::format("{}: {} / {} runs", campaign, done, total); });
           }},
      interrupted);
  line.clear();
  if (!reproduced) return complain(reproduced.error());
  if (reproduced->outcome == papers::Outcome::interrupted) {
    fmt::print(stderr, "hil-bench: interrupted; the same command goes on\n");
    return ExitCode::not_measured;
  }
  const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  fmt::print("{}\n{:.0f} s; page: {}\n", for_terminal(reproduced->text), s,
             one_line(reproduced->page.string()));
  if (reproduced->outcome == papers::Outcome::too_few_runs) {
    fmt::print(stderr, "hil-bench: not judged: the limits are for more runs than these\n");
    return ExitCode::not_measured;
  }
  return reproduced->outcome == papers::Outcome::bars_met ? ExitCode::pass : ExitCode::fail;
}

int run(int argc, char** argv) {
  Arguments arguments;
  command_line::Program program{"Flies what a paper claims and writes one page on it.",
                                version_line("hil-bench-paper")};
  program.add_option("PAPER", arguments.paper, papers::names()).required();
  program.add_option("--out", arguments.folder,
                     "folder of the page and the results (default: paper-NAME here)");
  program.add_number("--runs", arguments.runs, "another number of runs than the campaigns'", 1,
                     campaign::most_runs);
  program.add_flag("--unrounded", arguments.unrounded, "frames that round nothing");
  program.add_option("--exact", arguments.exact, "results without the bus's rounding, to compare");
  program.refuse_no_values();
  const auto parsed = program.parse(argc, argv);
  if (!parsed) return static_cast<int>(complain(parsed.error()));
  return *parsed ? **parsed : static_cast<int>(reproduce(arguments));
}

}  // namespace
}  // namespace canhil::commands

int main(int argc, char** argv) {
  return canhil::commands::guarded([&] { return canhil::commands::run(argc, argv); });
}
