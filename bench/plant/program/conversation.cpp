#include "bench/plant/program/conversation.hpp"

#include <fmt/format.h>

#include <csignal>
#include <thread>

#include "bench/processes/command.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::plant {
namespace {

using namespace std::chrono_literals;
using processes::Dialogue;
using std::chrono::steady_clock;
namespace protocol = program_protocol;

constexpr std::size_t most_bytes_of_line = 65'536;

double seconds(std::chrono::microseconds time) { return static_cast<double>(time.count()) / 1e6; }

}  // namespace

Result<std::unique_ptr<Conversation>> Conversation::start(const ProgramSettings& settings, const Draw& draw) {
  const auto wrong = [&](const std::string& reason) {
    return failure(fmt::format("program '{}' at its start: {}", one_line(settings.command), reason));
  };
  // A program that ignores SIGTERM must not outlive a bench that was killed.
  auto dialogue = Dialogue::start(processes::program_path(settings.words.front(), settings.folder),
                                  settings.words, {.folder = settings.folder, .signal_at_death = SIGKILL});
  if (!dialogue)
    return wrong(fmt::format("{}, expected an executable file{}", dialogue.error().message,
                             settings.folder.empty() ? "" : " (from " + one_line(settings.folder) + ")"));
  std::unique_ptr<Conversation> made(new Conversation(settings, std::move(*dialogue)));
  if (auto opened = made->open(draw); !opened) {
    made->kill();
    return wrong(opened.error().message);
  }
  return made;
}

Conversation::~Conversation() {
  if (over_) return;
  // A program that ends by itself can write its files and reports.
  constexpr auto patience = processes::ChildProcess::short_patience;
  const Time deadline = steady_clock::now() + patience;
  dialogue_.send(protocol::end_line, deadline);
  dialogue_.close_input();
  do {
    received_.clear();
  } while (steady_clock::now() < deadline &&
           dialogue_.receive(received_, deadline) == Dialogue::Outcome::done);
  while (steady_clock::now() < deadline && !dialogue_.process().ended()) std::this_thread::sleep_for(500us);
  if (!dialogue_.process().ended()) kill();
}

void Conversation::kill() {
  over_ = true;
  dialogue_.process().send_signal(SIGKILL);
  dialogue_.process().end(processes::ChildProcess::short_patience);
}

Result<void> Conversation::open(const Draw& draw) {
  const auto patience = settings_.starts_within;
  const Time deadline = steady_clock::now() + patience;
  if (auto sent = send(protocol::opening(settings_.parameters, draw), patience); !sent) return sent;
  while (true) {
    const auto line = next_line(deadline, patience);
    if (!line) return tl::unexpected(line.error());
    if (protocol::is_state(*line)) {
      if (declared_.outputs.empty()) return failure("declares no output, expected at least one");
      outputs_.resize(declared_.outputs.size());
      return protocol::read_state(*line, declared_.outputs, outputs_);
    }
    if (auto declared = protocol::declare(*line, declared_); !declared) return declared;
  }
}

Result<void> Conversation::step(std::int64_t from_us, std::int64_t to_us, std::span<const double> inputs) {
  auto done = exchange(from_us, to_us, inputs);
  if (done) return done;
  kill();
  return failure(fmt::format("program '{}' at {} s: {}", one_line(settings_.command),
                             seconds(std::chrono::microseconds(to_us)), done.error().message));
}

Result<void> Conversation::exchange(std::int64_t from_us, std::int64_t to_us,
                                    std::span<const double> inputs) {
  if (auto silent = expect_silence(); !silent) return silent;
  const auto patience = settings_.answers_within;
  const Time deadline = steady_clock::now() + patience;
  if (auto sent = send(protocol::step_line(from_us, to_us, inputs), patience); !sent) return sent;
  const auto line = next_line(deadline, patience);
  if (!line) return tl::unexpected(line.error());
  return protocol::read_state(*line, declared_.outputs, outputs_);
}

// A program that writes more lines than it is asked for would answer each step with the state of an earlier
// one.
Result<void> Conversation::expect_silence() {
  if (received_.empty()) dialogue_.receive(received_, Time::min());
  if (received_.empty()) return {};
  const auto line = next_line(Time::min(), 0us);
  if (!line) return tl::unexpected(line.error());
  return failure(
      fmt::format("wrote {} without being asked, expected one line for each step", protocol::shown(*line)));
}

Result<void> Conversation::send(std::string_view text, std::chrono::microseconds patience) {
  if (dialogue_.send(text, steady_clock::now() + patience) == Dialogue::Outcome::late) return late(patience);
  return {};
}

Result<std::string> Conversation::next_line(Time deadline, std::chrono::microseconds patience) {
  std::size_t end = received_.find('\n');
  while (end == std::string::npos) {
    if (received_.size() > most_bytes_of_line)
      return failure(fmt::format("wrote {} and more than {} bytes without a line end, expected a line",
                                 protocol::shown(received_), most_bytes_of_line));
    const std::size_t searched = received_.size();
    const auto outcome = dialogue_.receive(received_, deadline);
    if (outcome == Dialogue::Outcome::late) return late(patience);
    if (outcome == Dialogue::Outcome::closed) return closed();
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

std::string Conversation::after_last_line() const {
  if (!received_.empty()) return fmt::format("; {} has no line end", protocol::shown(received_));
  return last_line_.empty() ? "; it had written no line"
                            : fmt::format("; its last line was {}", protocol::shown(last_line_));
}

tl::unexpected<Error> Conversation::late(std::chrono::microseconds patience) const {
  return failure(fmt::format("did not answer within {} s{}", seconds(patience), after_last_line()));
}

tl::unexpected<Error> Conversation::closed() {
  constexpr auto patience = 1s;
  const Time deadline = steady_clock::now() + patience;  // its streams are closed shortly before it has ended
  while (!dialogue_.process().ended() && steady_clock::now() < deadline) std::this_thread::sleep_for(1ms);
  const auto ended = dialogue_.process().ended();
  return failure((ended ? to_text(*ended) : "closed its standard output") + after_last_line());
}

}  // namespace canhil::plant
