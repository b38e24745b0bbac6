#include "bench/processes/conversation.hpp"

#include <fmt/format.h>

#include "dbc/text/escape.hpp"

namespace canhil::processes {
namespace {

using std::chrono::steady_clock;
namespace protocol = program_protocol;

}  // namespace

Result<std::unique_ptr<Conversation>> Conversation::start(const ProgramSettings& settings,
                                                          const program_protocol::Opening& opening) {
  const auto wrong = [&](const std::string& reason) {
    return failure(fmt::format("program '{}' at its start: {}", one_line(settings.command), reason));
  };
  auto lines = ProgramLines::start(settings);
  if (!lines) return wrong(lines.error().message);
  std::unique_ptr<Conversation> made(new Conversation(settings, *std::move(lines)));
  if (auto opened = made->open(opening); !opened) {
    made->lines_->kill();
    return wrong(opened.error().message);
  }
  return made;
}

Result<void> Conversation::open(const program_protocol::Opening& opening) {
  const auto patience = settings_.starts_within;
  const auto deadline = steady_clock::now() + patience;
  if (auto sent = lines_->send(protocol::opening(settings_.parameters, opening), patience); !sent)
    return sent;
  while (true) {
    const auto line = lines_->next(deadline, patience);
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
  ask(from_us, to_us, inputs);
  return answer();
}

void Conversation::ask(std::int64_t from_us, std::int64_t to_us, std::span<const double> inputs) {
  from_us_ = from_us;
  to_us_ = to_us;
  asked_ = asked(inputs);
}

Result<void> Conversation::asked(std::span<const double> inputs) {
  if (auto silent = expect_silence(); !silent) return silent;
  deadline_ = steady_clock::now() + settings_.answers_within;
  return lines_->send(protocol::step_line(from_us_, to_us_, inputs), settings_.answers_within);
}

Result<void> Conversation::answer() {
  auto done = asked_ ? answered() : asked_;
  if (done) return done;
  lines_->kill();
  return failure(fmt::format("program '{}' at {} s: {}", one_line(settings_.command),
                             static_cast<double>(to_us_) / 1e6, done.error().message));
}

Result<void> Conversation::answered() {
  const auto line = lines_->next(deadline_, settings_.answers_within);
  if (!line) return tl::unexpected(line.error());
  return protocol::read_state(*line, declared_.outputs, outputs_);
}

// A program that writes more lines than it is asked for would answer each step with the state of an earlier
// one.
Result<void> Conversation::expect_silence() {
  if (!lines_->has_next()) return {};
  const auto line = lines_->next(ProgramLines::Time::min(), std::chrono::microseconds(0));
  if (!line) return tl::unexpected(line.error());
  return failure(
      fmt::format("wrote {} without being asked, expected one line for each step", protocol::shown(*line)));
}

}  // namespace canhil::processes
