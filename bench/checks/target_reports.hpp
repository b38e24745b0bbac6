// What a target reports about its own state: the states and the error bits of its heartbeats, and whether its
// counters (TargetCounters) continue.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "messages/canhil.hpp"

namespace canhil::checks {

/// A report of the target that is not what the bench commanded.
struct Report {
  enum class Of : std::uint8_t {
    state,    ///< an estimator does not run
    error,    ///< an error bit is set
    identity  ///< algorithm, DBC or version changed
  };
  Of of = Of::state;
  std::int64_t t_us = 0;  ///< time of the first such report, on the bench's time base
  std::string estimator;  ///< "los_rate"
  std::string what;       ///< "idle", "numeric", "algorithm kalman -> ekf"
};

/// The reports of one flight, from the start of the estimators on. The memory does not grow with the flight.
class TargetReports {
 public:
  void hear(const messages::TargetHeartbeat& beat, std::int64_t now_us);
  void hear(const messages::TargetCounters& counters, std::int64_t now_us);
  /// The bench restarts the target: its counters begin again.
  void restart();
  /// To be called at the end of the run.
  void end(std::int64_t now_us) { end_us_ = now_us; }

  [[nodiscard]] std::uint64_t heartbeats() const { return heartbeats_; }
  /// The reports that need an explanation, in order of time; each is listed once.
  [[nodiscard]] const std::vector<Report>& reports() const { return reports_; }
  /// The time [us] of the last TargetCounters, if its period does not explain that none came after it.
  [[nodiscard]] std::optional<std::int64_t> counters_stopped_us() const;
  /// The first count that went down, for example "frames lost 7 -> 0 at 5.4 s"; empty: none did.
  [[nodiscard]] const std::string& went_down() const { return went_down_; }
  /// The heartbeats as text: "60 heartbeats: los_rate idle from 2.1 s, input_lost from 3 s".
  [[nodiscard]] std::string to_text() const;

 private:
  void report(Report::Of of, std::int64_t now_us, messages::Estimator estimator, std::string_view what);

  std::uint64_t heartbeats_ = 0;
  std::vector<Report> reports_;
  std::map<messages::Estimator, messages::TargetHeartbeat> first_;  // since the start of the target
  std::optional<messages::TargetCounters> counters_;
  std::int64_t counters_us_ = 0, end_us_ = 0;
  std::string went_down_;
};

/// The error bits of TargetHeartbeat are the signals with this prefix.
inline constexpr std::string_view error_prefix = "error_";

}  // namespace canhil::checks
