#include "bench/drive/target_process.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "bench/drive/target_command.hpp"

namespace canhil::drive {

Result<ChildProcess> start_target(const std::string& command, const std::string& bus,
                                  const std::vector<std::string>& more, const std::vector<int>& cpus) {
  auto words = target_words(command);
  if (!words) return tl::unexpected(words.error());
  const std::string name = words->front(), program = program_path(name);
  const auto no_program = [&name](const std::string& reason) {
    return failure(
        fmt::format("target '{}': {}; expected an executable file, or --target none", name, reason));
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(program, ignored))
    return no_program(strerror(EISDIR));  // execv would report EACCES
  words->insert(words->end(), {"--bus", bus});
  words->insert(words->end(), more.begin(), more.end());
  auto started = ChildProcess::start(program, std::move(*words), cpus);
  if (!started) return no_program(started.error().message);
  return started;
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
