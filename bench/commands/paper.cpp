#include "bench/commands/paper.hpp"

#include <fmt/format.h>

#include <chrono>

#include "bench/commands/interrupt.hpp"
#include "bench/commands/progress_line.hpp"
#include "bench/papers/paper.hpp"

namespace canhil::commands {

ExitCode reproduce_paper(const PaperArguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  const ProgressLine line;
  catch_interrupts();
  const auto reproduced = papers::reproduce(
      {.paper = arguments.paper,
       .folder = arguments.folder.empty() ? fmt::format("paper-{}", arguments.paper) : arguments.folder,
       .runs = arguments.runs,
       .rounding = arguments.rounding,
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
  fmt::print("{}\n{:.0f} s; page: {}\n", reproduced->text, s, reproduced->page.string());
  if (reproduced->outcome == papers::Outcome::too_few_runs) {
    fmt::print(stderr, "hil-bench: not judged: the bars are for more runs than these\n");
    return ExitCode::not_measured;
  }
  return reproduced->outcome == papers::Outcome::bars_met ? ExitCode::pass : ExitCode::fail;
}

}  // namespace canhil::commands
