#include "bench/live/screen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "dbc/text/escape.hpp"
namespace canhil::live {
namespace {

using Look = ScreenLine::Look;

Look look_of(const std::optional<checks::Outcome>& outcome) {
  if (!outcome) return Look::plain;
  return *outcome == checks::Outcome::pass   ? Look::good
         : *outcome == checks::Outcome::fail ? Look::bad
                                             : Look::open;
}

// Formats any value so that it fits into its column.
std::string number(std::optional<double> value) {
  return !value || !std::isfinite(*value) ? "-"
         : std::abs(*value) >= 1e6        ? fmt::format("{:.2e}", *value)
                                          : fmt::format("{:.3f}", *value);
}

std::string bar(double share, std::size_t columns) {
  const std::size_t width = std::clamp<std::size_t>(columns / 3, 8, 40);
  const auto done = static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(width));
  return '[' + std::string(done, '=') + std::string(width - done, ' ') + ']';
}

std::string state(const Snapshot& snapshot, const std::optional<checks::Outcome>& outcome, bool paused) {
  const std::string state = !snapshot.ended.empty() ? "not flown"
                            : outcome               ? std::string(checks::name(*outcome))
                                                    : "running";
  return paused ? state + ", paused" : state;
}

class Screen {
 public:
  explicit Screen(std::size_t columns) : columns_(columns) {}
  void add(std::string text, Look look = Look::plain) { lines_.push_back({std::move(text), look}); }
  void heading(std::string text) {
    add("");
    add(std::move(text), Look::heading);
  }
  std::vector<ScreenLine> first(std::size_t rows) && {
    if (lines_.size() > rows) lines_.resize(rows);
    for (ScreenLine& line : lines_) line.text = shortened(line.text);
    return std::move(lines_);
  }

 private:
  // Shortens a text to the width of the screen. Never splits a UTF-8 character.
  [[nodiscard]] std::string shortened(const std::string& own) const {
    std::string text = one_line(own);
    std::size_t shown = 0, end = 0;
    for (; end < text.size(); ++end) {
      const char byte = text[end];
      const bool begins = static_cast<signed char>(byte) >= -64;  // otherwise `byte` continues a character
      if (begins && shown++ == columns_) break;
    }
    text.resize(end);
    return text;
  }
  std::size_t columns_;
  std::vector<ScreenLine> lines_;
};

void add_checks(Screen& screen, const Flight& flight) {
  const auto count = [&](std::optional<checks::Outcome> outcome) {
    return std::ranges::count(flight.checks, outcome, &CheckLine::outcome);
  };
  screen.heading(fmt::format("checks: {} passed, {} failed, {} open", count(checks::Outcome::pass),
                             count(checks::Outcome::fail), count(std::nullopt)));
  for (const CheckLine& check : flight.checks) {
    if (check.outcome)
      screen.add(fmt::format("{:<12} {}: {}", checks::name(*check.outcome), check.name, check.measured),
                 look_of(check.outcome));
  }
}

void add(Screen& screen, const Flight& flight) {
  if (!flight.series.empty()) {
    screen.heading(fmt::format("{:<34}{:>12}{:>12}  {}", "now", "value", "3 sigma", "unit"));
    for (const report::Series& series : flight.series) {
      const report::Series::Point& last = series.points.back();
      const auto sigma = last.sigma ? std::optional(3 * *last.sigma) : std::nullopt;
      screen.add(fmt::format("{:<34.34}{:>12}{:>12}  {}", series.quantity, number(last.high), number(sigma),
                             series.unit));
    }
  }
  for (const FaultLine& fault : flight.faults) {
    const bool at_work = !fault.begins_in_run && flight.t_s >= fault.from_s && flight.t_s <= fault.to_s;
    if (!flight.outcome && at_work)
      screen.add(fmt::format("fault at work: {} ({})", fault.name, fault.stage), Look::open);
  }
  add_checks(screen, flight);
  if (flight.timing.empty()) return;
  screen.heading(fmt::format("{:<24}{:>8}{:>10}{:>10}{:>10}{:>12}{:>10}", "latency and jitter [ms]",
                             "answers", "p50", "p99", "max", "jitter p99", "max"));
  for (const TimingLine& line : flight.timing)
    screen.add(fmt::format("{:<24.24}{:>8}{:>10}{:>10}{:>10}{:>12}{:>10}", line.message, line.count,
                           number(line.p50_us / 1e3), number(line.p99_us / 1e3), number(line.max_us / 1e3),
                           number(line.jitter_p99_us / 1e3), number(line.jitter_max_us / 1e3)));
}

void add(Screen& screen, const Batch& batch) {
  screen.add(fmt::format("{}: {}", batch.failed_means, batch.failed),
             batch.failed > 0 ? Look::bad : Look::good);
  screen.heading("latest results");
  for (const Batch::Line& line : batch.latest)
    screen.add(fmt::format("{}: {}", line.name, line.result), line.failed ? Look::bad : Look::plain);
}

}  // namespace

std::vector<ScreenLine> screen_of(const Snapshot& snapshot, std::size_t rows, std::size_t columns,
                                  bool paused) {
  if (rows == 0) return {};
  Screen screen(columns);
  if (const auto& flight = snapshot.flight) {
    screen.add(fmt::format("{}: {}", state(snapshot, flight->outcome, paused), flight->title),
               flight->outcome ? look_of(flight->outcome) : Look::heading);
    screen.add(fmt::format("{} {:.1f} / {:g} s   bus load {:.1f} %   {} frames, {} missed here",
                           bar(flight->t_s / flight->duration_s, columns), flight->t_s, flight->duration_s,
                           100 * flight->load_now, snapshot.frames, snapshot.dropped));
    if (!flight->reason.empty()) screen.add(flight->reason, look_of(flight->outcome));
    add(screen, *flight);
  } else if (const auto& batch = snapshot.batch) {
    screen.add(fmt::format("{}: {}", state(snapshot, batch->outcome, paused), batch->title), Look::heading);
    const double share =
        batch->total == 0 ? 0 : static_cast<double>(batch->done) / static_cast<double>(batch->total);
    screen.add(fmt::format("{} {} / {} {}", bar(share, columns), batch->done, batch->total, batch->of));
    add(screen, *batch);
  }
  if (!snapshot.ended.empty()) screen.add(snapshot.ended, Look::bad);
  std::vector<ScreenLine> lines = std::move(screen).first(rows > 4 ? rows - 1 : rows);
  if (rows > 4) {  // the last line lists the keys
    lines.resize(rows - 1);
    lines.push_back({std::string("space: pause   Ctrl-C: end the run").substr(0, columns), Look::plain});
  }
  return lines;
}

}  // namespace canhil::live
