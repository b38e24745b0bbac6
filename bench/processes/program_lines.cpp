#include "bench/processes/program_lines.hpp"

#include <fmt/format.h>

#include <csignal>
#include <thread>

#include "bench/processes/command.hpp"
#include "bench/processes/program_protocol.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::processes {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;
namespace protocol = program_protocol;

constexpr std::size_t most_bytes_of_line = 65'536;

double in_seconds(std::chrono::microseconds time) { return static_cast<double>(time.count()) / 1e6; }

}  // namespace

Result<std::unique_ptr<ProgramLines>> ProgramLines::start(const ProgramSettings& settings) {
  // A program that ignores SIGTERM must not outlive a bench that was killed.
  auto dialogue = Dialogue::start(program_path(settings.words.front(), settings.folder), settings.words,
                                  {.folder = settings.folder, .ordinary = true, .signal_at_death = SIGKILL});
  if (!dialogue)
    return failure(fmt::format("{}, expected an executable file{}", dialogue.error().message,
                               settings.folder.empty() ? "" : " (from " + one_line(settings.folder) + ")"));
  return std::make_unique<ProgramLines>(*std::move(dialogue));
}

ProgramLines::~ProgramLines() {
  if (over_) return;
  // A program that ends by itself can write its files and reports.
  constexpr auto patience = ChildProcess::short_patience;
  const Time deadline = steady_clock::now() + patience;
  dialogue_.send(protocol::end_line, deadline);
  dialogue_.close_input();
  ChildProcess* process = dialogue_.process();
  if (process == nullptr) return;
  do {
    received_.clear();
  } while (steady_clock::now() < deadline &&
           dialogue_.receive(received_, deadline) == Dialogue::Outcome::done);
  while (steady_clock::now() < deadline && !process->ended()) std::this_thread::sleep_for(500us);
  if (!process->ended()) kill();
}

void ProgramLines::kill() {
  over_ = true;
  if (dialogue_.process() == nullptr) return dialogue_.close_input();
  dialogue_.process()->send_signal(SIGKILL);
  dialogue_.process()->end(ChildProcess::short_patience);
}

void ProgramLines::post(std::string_view text) {
  unsent_ += text;
  flush();
}

bool ProgramLines::flush() {
  std::string_view left = unsent_;
  if (dialogue_.send_some(left, Time::min()) == Dialogue::Outcome::closed) left = {};
  unsent_.erase(0, unsent_.size() - left.size());
  return unsent_.empty();
}

bool ProgramLines::has_next() { return wait_next(Time::min()); }

bool ProgramLines::wait_next(Time deadline) {
  while (received_.find('\n') == std::string::npos && !closed_) {
    if (received_.size() > most_bytes_of_line) return true;  // next() reports it
    const auto outcome = dialogue_.receive(received_, deadline);
    if (outcome == Dialogue::Outcome::late) return false;
    closed_ = outcome == Dialogue::Outcome::closed;
  }
  return true;
}

Result<void> ProgramLines::send(std::string_view text, std::chrono::microseconds patience) {
  if (dialogue_.send(text, steady_clock::now() + patience) == Dialogue::Outcome::late) return late(patience);
  return {};
}

Result<std::string> ProgramLines::next(Time deadline, std::chrono::microseconds patience) {
  std::size_t end = received_.find('\n');
  while (end == std::string::npos) {
    if (received_.size() > most_bytes_of_line)
      return failure(fmt::format("wrote {} and more than {} bytes without a line end, expected a line",
                                 protocol::shown(received_), most_bytes_of_line));
    const std::size_t searched = received_.size();
    const auto outcome = dialogue_.receive(received_, deadline);
    if (outcome == Dialogue::Outcome::late) return late(patience);
    if (outcome == Dialogue::Outcome::closed) {
      closed_ = true;
      return closed();
    }
    end = received_.find('\n', searched);
  }
  std::string line = received_.substr(0, end);
  received_.erase(0, end + 1);
  if (line.ends_with('\r')) line.pop_back();
  if (const char* text = protocol::error_text(line))
    return failure(fmt::format("reports {}", protocol::shown(text)));
  last_line_ = line;
  return line;
}

std::string ProgramLines::after_last_line() const {
  if (!received_.empty()) return fmt::format("; {} has no line end", protocol::shown(received_));
  return last_line_.empty() ? "; it had written no line"
                            : fmt::format("; its last line was {}", protocol::shown(last_line_));
}

tl::unexpected<Error> ProgramLines::late(std::chrono::microseconds patience) const {
  return failure(fmt::format("did not answer within {} s{}", in_seconds(patience), after_last_line()));
}

tl::unexpected<Error> ProgramLines::closed() {
  constexpr auto patience = 1s;
  const Time deadline = steady_clock::now() + patience;  // its streams are closed shortly before it has ended
  ChildProcess* process = dialogue_.process();
  if (process == nullptr) return failure("closed its connection" + after_last_line());
  while (!process->ended() && steady_clock::now() < deadline) std::this_thread::sleep_for(1ms);
  const auto ended = process->ended();
  return failure((ended ? to_text(*ended) : "closed its standard output") + after_last_line());
}

}  // namespace canhil::processes
