#include "bench/drive/rig_commands.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <string_view>
#include <thread>
#include <utility>

#include "bench/process/child_process.hpp"
#include "bench/scenario/scenario.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::drive {
namespace {

constexpr std::chrono::milliseconds between_looks{5};

// Runs a shell command. If `stop` becomes true, ends it.
Result<void> run_command(std::string_view key, const std::string& command, const std::atomic<bool>& stop) {
  const auto wrong = [&](const std::string& how) {
    return failure(fmt::format("key 'target.{}': '{}' {}, expected 0", key, command, how));
  };
  auto started = process::ChildProcess::start("/bin/sh", {"sh", "-c", command});
  if (!started) return wrong("cannot be started: " + started.error().message);
  while (!started->ended()) {
    if (stop) {
      started->end(process::ChildProcess::short_patience);
      return failure(fmt::format("interrupted while 'target.{}' ran", key));
    }
    std::this_thread::sleep_for(between_looks);
  }
  const process::ProcessEnd end = *started->ended();
  started->leave();  // what the command started in the background goes on, for example a simulator
  return end.exited_with_0() ? Result<void>() : wrong(to_text(end));
}

}  // namespace

Result<void> RigCommands::begin(const std::atomic<bool>& stop) {
  for (const Commands& one : of_targets_) {
    ++begun_;
    if (one.before.empty()) continue;
    if (auto done = run_command("before", one.before, stop); !done) return done;
  }
  return {};
}

void RigCommands::finish() {
  static const std::atomic<bool> never = false;
  const std::size_t begun = std::exchange(begun_, 0);
  for (std::size_t i = 0; i < begun; ++i) {
    if (of_targets_[i].after.empty()) continue;
    if (const auto done = run_command("after", of_targets_[i].after, never); !done)
      fmt::print(stderr, "hil-bench: {}\n", one_line(done.error().message));
  }
}

RigCommands rig_commands_of(const scenario::Scenario& scenario) {
  std::vector<RigCommands::Commands> of_targets;
  for (const scenario::TargetSetup& target : scenario.targets) {
    if (target.own_start) of_targets.push_back({target.own_start->before, target.own_start->after});
  }
  return RigCommands(std::move(of_targets));
}

}  // namespace canhil::drive
