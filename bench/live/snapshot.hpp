// What the live view shows at one time: the same numbers for the page and for a terminal.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "bench/checks/bus_load.hpp"
#include "bench/checks/verdict.hpp"
#include "bench/report/series.hpp"

namespace canhil::live {

struct CheckLine {
  std::string name;
  std::optional<checks::Outcome> outcome{};  ///< none: not judged yet
  std::string measured{}, expected{};
};

/// The times of one message of the target [us].
struct TimingLine {
  std::string message;
  std::uint64_t count = 0;  ///< answers with a latency
  double p50_us = 0, p99_us = 0, max_us = 0;
  std::uint64_t jitter_count = 0;
  double jitter_p99_us = 0, jitter_max_us = 0;
  double stretch_s = 0;  ///< length of each stretch in `slowest_us`
  /// The largest latency in each stretch of the flight; NaN: no answer in the stretch. Empty unless the
  /// message is the last message of its answer.
  std::vector<double> slowest_us{};
};

struct FaultLine {
  std::string name, kind, stage;
  double from_s = 0, to_s = 0;
  bool begins_in_run = false;  ///< by a condition or a command: its times are known only after the run
};

/// The state of a flight so far.
struct Flight {
  std::string title{}, scenario{}, bus{}, clock{};
  double t_s = 0, duration_s = 0;
  std::optional<checks::Outcome> outcome{};  ///< none: the flight is still running
  std::string reason{};
  std::vector<CheckLine> checks{};
  std::vector<report::Series> series{};
  std::string no_timing{};  ///< why no times are shown; empty: times are shown
  std::vector<TimingLine> timing{};
  std::string bit_rate{};
  double load_now = 0;  ///< bus load in the last full second, from 0 to 1
  checks::Load load{};
  checks::LoadLine load_line{};
  std::vector<FaultLine> faults{};
  std::string no_tracks{};  ///< why quantities and times are not shown before the end; empty: they are shown
};

/// The state of a campaign or a fault matrix so far.
struct Batch {
  struct Line {
    std::string name, result;
    bool failed = false;
  };
  std::string title, of;  ///< `of`: what is counted, "runs" or "flights"
  std::uint64_t done = 0, total = 0, failed = 0;
  std::string failed_means{};  ///< meaning of `failed`: "ended early" or "violations"
  double rate_per_s = 0;
  std::optional<checks::Outcome> outcome{};  ///< none: the batch is still running
  std::string reason{};
  std::deque<Line> latest{};  ///< newest first
  static constexpr std::size_t most_latest = 40;
  void add(Line line) {
    if (latest.size() == most_latest) latest.pop_back();
    latest.push_front(std::move(line));
  }
};

struct Snapshot {
  std::optional<Flight> flight{};
  std::optional<Batch> batch{};
  std::string ended{};  ///< why nothing was flown; empty: a flight runs or has run
  std::uint64_t frames = 0;
  std::uint64_t dropped = 0;  ///< frames that the view missed because it was too slow

  [[nodiscard]] bool over() const {
    return !ended.empty() || (flight && flight->outcome) || (batch && batch->outcome);
  }
};

}  // namespace canhil::live
