#include "bench/drive/target_process.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <utility>

#include "bench/drive/target_command.hpp"
#include "bench/processes/command.hpp"

namespace canhil::drive {

Result<ChildProcess> start_target(const std::string& command, const std::string& bus,
                                  const std::vector<std::string>& more, const std::vector<int>& cpus) {
  auto words = target_words(command);
  if (!words) return tl::unexpected(words.error());
  const std::string name = words->front(), program = processes::program_path(name);
  const auto no_program = [&name](const std::string& reason) {
    return failure(
        fmt::format("target '{}': {}; expected an executable file, or --target none", name, reason));
  };
  words->insert(words->end(), {"--bus", bus});
  words->insert(words->end(), more.begin(), more.end());
  auto started = ChildProcess::start(program, std::move(*words), {.cpus = cpus});
  if (!started) return no_program(started.error().message);
  return started;
}

Result<void> TargetPrograms::start(const std::vector<std::string>& commands, const std::string& bus,
                                   const std::vector<std::string>& more, const std::vector<int>& cpus) {
  commands_ = commands;
  for (const std::string& command : commands_) {
    auto started = start_target(command, bus, more, cpus);
    if (!started) return tl::unexpected(started.error());
    running_.push_back(std::move(*started));
  }
  return {};
}

void TargetPrograms::kill() {
  send_signal(SIGKILL);
  running_.clear();
}

std::vector<pid_t> TargetPrograms::ids() const {
  std::vector<pid_t> ids;
  for (const ChildProcess& one : running_) ids.push_back(one.id());
  return ids;
}

std::optional<std::string> TargetPrograms::ended() {
  for (std::size_t i = 0; i < running_.size(); ++i) {
    const auto end = running_[i].ended();
    if (!end) continue;
    return running_.size() == 1 ? "target: " + to_text(*end)
                                : fmt::format("target '{}': {}", commands_[i], to_text(*end));
  }
  return std::nullopt;
}

bool TargetPrograms::stopped() const { return std::ranges::any_of(running_, &ChildProcess::stopped); }

void TargetPrograms::send_signal(int signal) {
  for (ChildProcess& one : running_) one.send_signal(signal);
}

TargetPrograms::End TargetPrograms::end(std::chrono::milliseconds patience) {
  std::optional<ProcessEnd> first, wrong;
  bool any_killed = false;
  for (ChildProcess& one : running_) {
    const ProcessEnd end = one.end(patience);
    any_killed = any_killed || end.killed;
    if (!first) first = end;
    if (!wrong && !wrong_end(end).empty()) wrong = end;
  }
  return {.of = wrong.value_or(first.value_or(ProcessEnd{})), .any_killed = any_killed};
}

Ending with_process_end(Ending ending, const std::optional<std::string>& ended_before,
                        const ProcessEnd& end) {
  if (ending.kind == Ending::Kind::target_ended) return ending;  // its detail says how
  std::string wrong = wrong_end(end);
  if (ended_before)
    wrong = fmt::format("{} before the bench stopped it", *ended_before);
  else if (!wrong.empty())
    wrong = "target: " + wrong;
  if (wrong.empty()) return ending;
  if (ending.kind == Ending::Kind::completed) ending.kind = Ending::Kind::wrong_end;
  if (ending.kind == Ending::Kind::target_fault) ending.kind = Ending::Kind::target_ended;
  ending.detail = ending.detail.empty() ? wrong : fmt::format("{}; {}", ending.detail, wrong);
  return ending;
}

std::string wrong_end(const ProcessEnd& end) {
  constexpr int status_of_sigterm = 128 + SIGTERM;
  if (end.exited_with_0() || end.killed || end.signal == SIGTERM || end.status == status_of_sigterm)
    return "";
  return fmt::format("{} when the bench stopped it, expected 0 or the end by SIGTERM", to_text(end));
}

}  // namespace canhil::drive
