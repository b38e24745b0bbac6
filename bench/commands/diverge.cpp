#include "bench/commands/subcommands.hpp"

#include <fmt/format.h>

#include <string>

#include "bench/commands/exit_code.hpp"
#include "bench/observe/divergence.hpp"

namespace canhil::commands {
namespace {

void show(const std::string& log, const std::optional<LogEntry>& entry) {
  if (!entry) return fmt::print("  {}: has no more frames of the target\n", one_line(log));
  fmt::print("  {}: {}\n    {}\n", one_line(log), one_line(format_log_line(*entry)),
             one_line(observe::describe(entry->frame)));
}

ExitCode execute(const std::string& log_a, const std::string& log_b) {
  const auto comparison = observe::compare(log_a, log_b);
  if (!comparison) return complain(comparison.error());
  const auto& first = comparison->first;
  if (comparison->compared == 0 && !(first && first->a && first->b)) {
    std::string empty = log_a;
    if (!first) empty += ", " + log_b;
    if (first && first->a) empty = log_b;
    return complain({empty + ": no frame of the target after a Sync, expected the log of a run"});
  }
  if (!first) {
    fmt::print("same: {} frames of the target\n", comparison->compared);
    return ExitCode::pass;
  }
  fmt::print("differ at t={:.3f} s, frame {} of the target ({} agree)\n", comparison->first->t_s,
             comparison->first->index + 1, comparison->compared);
  show(log_a, comparison->first->a);
  show(log_b, comparison->first->b);
  return ExitCode::fail;
}

}  // namespace

void add_diverge(command_line::Command app, int& code) {
  auto logs = std::make_shared<std::pair<std::string, std::string>>();
  const auto command =
      app.add_subcommand("diverge", "compare two recorded runs: the first frame of the target that differs");
  command.add_option("A", logs->first, "log of a run (hil-bench run --log)").required();
  command.add_option("B", logs->second, "log of another").required();
  command.on_given([&code, logs] { code = static_cast<int>(execute(logs->first, logs->second)); });
}

}  // namespace canhil::commands
