#include "bench/partners/partner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/processes/program_protocol.hpp"
#include "bench/world/stoppable.hpp"
#include "dbc/logs/candump.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::partners {
namespace {

using std::chrono::steady_clock;
namespace protocol = processes::program_protocol;

constexpr std::string_view client_name = "control";
constexpr std::int64_t look_period_us = 50'000;         // how often a client is looked for
constexpr std::size_t most_lines = 100'000;             // of the answer to a step
constexpr std::size_t most_bytes_heard = 4U << 20;      // a partner that is late loses older messages
constexpr std::chrono::milliseconds between_looks{50};  // at a stop of the run
constexpr std::chrono::seconds awaits_client{60}, client_declares_within{10};

// A frame as candump writes it: 123#0011, 12345678##1AABB.
std::string to_text(const Frame& frame) {
  const std::string line = format_log_line({.t_ns = 0, .interface = "-", .frame = frame});
  return std::string(protocol::words_of_line(line).at(2));
}
Result<Frame> frame_of(std::string_view text) {
  const auto entry = parse_log_line(fmt::format("(0.000000) - {}", text), "frame");
  if (!entry || entry->remote || entry->frame.error)
    return failure(fmt::format("'{}' is no frame, expected 123#0011 or 12345678##1AABB", one_line(text)));
  return entry->frame;
}

}  // namespace

Partner::~Partner() = default;

Result<std::unique_ptr<Partner>> Partner::start(const std::string& name,
                                                const processes::ProgramSettings& program,
                                                const Stage& stage) {
  const auto wrong = [&](const std::string& why) {
    return failure(
        fmt::format("node '{}': program '{}' at its start: {}", name, one_line(program.command), why));
  };
  std::unique_ptr<Partner> made(new Partner(name, stage, nullptr));
  made->command_ = program.command;
  auto lines = Lines::start(program);
  if (!lines) return wrong(lines.error().message);
  auto opened = made->open(*std::move(lines), program.parameters, program.starts_within);
  if (opened) opened = made->declarations(true);
  if (!opened) return wrong(opened.error().message);
  made->patience_ = program.answers_within;
  return made;
}

Result<std::unique_ptr<Partner>> Partner::client(ControlSocket& socket, const Stage& stage, bool awaits) {
  std::unique_ptr<Partner> made(new Partner(std::string(client_name), stage, &socket));
  if (!awaits) return made;
  const auto deadline = steady_clock::now() + awaits_client;
  while (made->lines_ == nullptr && steady_clock::now() < deadline && !world::Stoppable::stopped()) {
    if (auto lines = socket.accept(between_looks)) {
      auto opened = made->open(std::move(lines), {}, client_declares_within);
      if (opened) opened = made->declarations(true);
      if (!opened)
        return failure(fmt::format("--control '{}': the client {}", socket.path(), opened.error().message));
    }
  }
  if (world::Stoppable::stopped()) return failure("interrupted");
  if (made->lines_ == nullptr)
    return failure(
        fmt::format("--control '{}': no client connected within {} s", socket.path(), awaits_client.count()));
  return made;
}

Result<void> Partner::open(std::unique_ptr<Lines> lines,
                           std::span<const processes::ProgramSettings::Parameter> parameters,
                           std::chrono::microseconds patience) {
  lines_ = std::move(lines);
  is_ready_ = is_asked_ = false;
  since_ = steady_clock::now();
  period_us_ = usual_period_us;
  asked_us_ = now_us_;
  messages_ = BusMessages(*stage_.scenario.binding);
  inputs_.clear();
  hears_.clear();
  hears_all_ = false;
  patience_ = patience;
  return lines_->send(
      protocol::opening(
          parameters, {.role = "node",
                       .name = name_,
                       .seed = stage_.scenario.seed,
                       .run_index = stage_.run_index,
                       .further = fmt::format("clock {}\nends {}\n", stage_.virtual_time ? "virtual" : "real",
                                              stage_.end_us)}),
      patience);
}

// Reads what the partner declares; `waits`: until it is ready.
Result<void> Partner::declarations(bool waits) {
  const auto deadline = since_ + patience_;
  while (!is_ready_) {
    if (!waits && !lines_->has_next() && steady_clock::now() < deadline) return {};
    const auto line = lines_->next(deadline, patience_);
    if (!line) return tl::unexpected(line.error());
    if (auto declared = declare(*line); !declared) return declared;
  }
  return {};
}

Result<void> Partner::declare(std::string_view line) {
  const auto wrong = [&](std::string_view expected) {
    return failure(fmt::format("wrote {}, expected {}", protocol::shown(line), expected));
  };
  const auto words = protocol::words_of_line(line);
  const std::string_view what = words.empty() ? std::string_view{} : words[0];
  if (what == "ready" && words.size() == 1) {
    is_ready_ = true;
    return {};
  }
  constexpr std::string_view known = "'period SECONDS', 'input NAME', 'hear MESSAGE' or 'ready'";
  if (words.size() < 2) return wrong(known);
  if (what == "period") {
    const auto period_s = protocol::number_of(words[1]);
    if (!period_s || !(*period_s >= 1e-4 && *period_s <= 3600)) return wrong("a period of 0.0001 to 3600 s");
    period_us_ = std::llround(*period_s * 1e6);
  } else if (what == "input") {
    const world::TruthValue* value = world::find_truth_value(words[1]);
    if (value == nullptr) return wrong("a true value (docs/quantities.md)");
    if (const std::string why = scenario::why_no_truth(stage_.scenario, *value); !why.empty())
      return failure(fmt::format("wrote {}, but the run has {}", protocol::shown(line), why));
    inputs_.push_back(value);
  } else if (what == "hear" && words[1] == "*") {
    hears_all_ = true;
  } else if (what == "hear") {
    const dbc::Message* message = messages_.find(words[1]);
    if (message == nullptr) return wrong(messages_.instead_of(words[1]) + ", or *");
    hears_.push_back(message);
  } else {
    return wrong(known);
  }
  return {};
}

bool Partner::hear(const Frame& frame, std::int64_t now_us) {
  if (!is_ready_ || frame.error) return false;
  if (!stage_.virtual_time && heard_.size() > most_bytes_heard)
    heard_.erase(0, heard_.find('\n', most_bytes_heard / 2) + 1);
  if (hears_all_) heard_ += fmt::format("frame {} {}\n", now_us, to_text(frame));
  if (hears_.empty()) return false;
  const dbc::Message* message = messages_.of(frame);
  if (message == nullptr || std::ranges::find(hears_, message) == hears_.end()) return false;
  if (const auto text = BusMessages::text(*message, frame))
    heard_ += fmt::format("heard {} {}\n", now_us, *text);
  return false;
}

void Partner::transmit(nodes::Transmission& out) {
  if (queued_.empty()) {
    now_us_ = due_us_;
    look_for_client();
    if (lines_ != nullptr) {
      auto done = is_ready_ ? answers(false) : declarations(stage_.virtual_time);
      if (done && is_ready_) {
        if (is_asked_ || !lines_->flush())
          stage_.interventions.missed(name_);
        else
          done = ask();
      }
      if (done && stage_.virtual_time) done = answers(true);
      if (!done) over(done.error().message);
    }
    due_us_ += lines_ != nullptr && is_ready_ ? period_us_ : look_period_us;
    if (due_us_ > stage_.end_us) due_us_ = nodes::never_us;
  }
  for (std::size_t i = 0; i < nodes::Transmission::most && !queued_.empty(); ++i) {
    out.put(queued_.front());
    queued_.pop_front();
  }
}

void Partner::look_for_client() {
  if (lines_ != nullptr || socket_ == nullptr) return;
  auto lines = socket_->accept(std::chrono::milliseconds(0));
  if (lines == nullptr) return;
  if (auto opened = open(std::move(lines), {}, client_declares_within); !opened) over(opened.error().message);
}

Result<void> Partner::ask() {
  std::vector<double> values;
  for (const world::TruthValue* one : inputs_)
    values.push_back(one->at(stage_.truths, now_us_).value_or(std::numeric_limits<double>::quiet_NaN()));
  is_asked_ = true;
  since_ = steady_clock::now();
  const std::string lines =
      std::exchange(heard_, {}) + protocol::step_line(std::exchange(asked_us_, now_us_), now_us_, values);
  if (stage_.virtual_time) return lines_->send(lines, patience_);
  lines_->post(lines);
  return {};
}

// Takes the lines that have come; `waits`: until the answer to the last step is complete.
Result<void> Partner::answers(bool waits) {
  for (std::size_t lines = 0; !world::Stoppable::stopped(); ++lines) {
    // A person may be at the other end of a socket.
    const bool is_late = socket_ == nullptr && is_asked_ && steady_clock::now() >= since_ + patience_;
    if (!lines_->has_next() && !is_late) {
      if (!waits || !is_asked_) return {};
      lines_->wait_next(steady_clock::now() + between_looks);
      continue;
    }
    const auto line = lines_->next(Lines::Time::min(), patience_);
    if (!line) return tl::unexpected(line.error());
    if (lines == most_lines) return failure(fmt::format("wrote more than {} lines for a step", most_lines));
    const auto done = answer(*line);
    if (!done) return tl::unexpected(done.error());
    if (*done) is_asked_ = false;
    if (*done && waits) return {};
  }
  return {};
}

// Does what a line says; returns whether it ends the answer to a step.
Result<bool> Partner::answer(std::string_view line) {
  const auto words = protocol::words_of_line(line);
  const std::string_view what = words.empty() ? std::string_view{} : words[0];
  if (what == "done" && words.size() == 1) return true;
  const auto wrong = [&](std::string_view expected) {
    return failure(fmt::format("wrote {}, expected {}", protocol::shown(line), expected));
  };
  constexpr std::string_view known =
      "'send', 'frame', 'begin', 'end', 'set', 'release', 'stop' with their values, or 'done'";
  if (words.size() < 2) return wrong(known);
  // A name of a fault, or a reason, may have blanks.
  const std::string_view rest = line.substr(static_cast<std::size_t>(words[1].data() - line.data()));
  Interventions& change = stage_.interventions;
  Result<void> done{};
  const auto put = [&](const Result<Frame>& frame) {
    if (frame) queued_.push_back(*frame);
    done = frame ? Result<void>{} : tl::unexpected(frame.error());
  };
  if (what == "send") {
    std::vector<std::pair<std::string_view, double>> values;
    for (std::size_t i = 2; i < words.size(); ++i) {
      const std::size_t equals = words[i].find('=');
      const auto value =
          equals == std::string_view::npos ? std::nullopt : protocol::number_of(words[i].substr(equals + 1));
      if (!value || std::isnan(*value)) return wrong("SIGNAL=NUMBER for each value");
      values.emplace_back(words[i].substr(0, equals), *value);
    }
    put(messages_.frame(words[1], values));
  } else if (what == "frame") {
    auto frame = frame_of(words[1]);
    if (frame && frame->fd && !stage_.fd)
      frame = failure(fmt::format("'{}' is of CAN FD, and the bus is not", one_line(words[1])));
    put(frame);
  } else if (what == "begin" || what == "end") {
    done = change.fault(name_, rest, what == "begin", now_us_);
  } else if (what == "set") {
    const auto value = words.size() == 3 ? protocol::number_of(words[2]) : std::nullopt;
    if (!value || !std::isfinite(*value)) return wrong("'set SENSOR.VALUE NUMBER'");
    done = change.set(name_, words[1], *value, now_us_);
  } else if (what == "release") {
    done = change.release(name_, words[1], now_us_);
  } else if (what == "stop") {
    change.stop(name_, rest, now_us_);
  } else {
    return wrong(known);
  }
  if (!done) return tl::unexpected(done.error());
  return false;
}

// A program of the scenario that fails ends the run; a client may come again.
void Partner::over(const std::string& why) {
  if (socket_ == nullptr) {
    stage_.interventions.stop(name_, fmt::format("program '{}': {}", one_line(command_), why), now_us_);
  } else if (!lines_->is_closed()) {
    lines_->post(fmt::format("error {}\n", one_line(why)));
    // What it wanted was not done, so the run is not the one that was meant.
    stage_.interventions.stop(name_, why, now_us_);
  }
  lines_->kill();  // it is not waited for
  lines_.reset();
  is_ready_ = is_asked_ = false;
  heard_.clear();
}

}  // namespace canhil::partners
