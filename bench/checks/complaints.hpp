// Errors that a target shows outside its answers: error bits in its heartbeat, increases of its counters, and
// intervals without a heartbeat.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "bench/scenario/checks.hpp"
#include "messages/canhil.hpp"

namespace canhil::checks {

/// All times in this class are on the bench's time base: an event gets the time of the last Sync before it.
class Complaints {
 public:
  struct Said {
    std::int64_t t_us = 0;
    std::string_view what;  ///< "input_lost", "degraded"; "bad_crc" for a counter
  };

  void hear(const messages::TargetHeartbeat& beat, std::int64_t now_us);
  void hear(const messages::TargetCounters& counters, std::int64_t now_us);
  /// To be called at the end of the run: records a silence up to `now_us`, if there is one.
  void end(std::int64_t now_us);

  /// For each error bit, one entry at the time when the bit becomes 1; a target then keeps this bit at 1
  /// until the end of the run. For the flag `degraded`, one entry for each heartbeat in which the flag is
  /// set.
  [[nodiscard]] const std::vector<Said>& of_heartbeats() const { return of_heartbeats_; }
  /// An entry for each increase of a counter.
  [[nodiscard]] const std::vector<Said>& of_counters() const { return of_counters_; }
  /// Intervals without a heartbeat that are longer than the limit (silence.hpp).
  [[nodiscard]] const std::vector<scenario::Window>& silences() const { return silences_; }

  /// All possible values of Said::what.
  static std::vector<std::string_view> names();

 private:
  std::vector<Said> of_heartbeats_, of_counters_;
  std::vector<scenario::Window> silences_;
  std::map<messages::Estimator, messages::TargetHeartbeat> beats_;  // the last heartbeat of each estimator
  std::optional<messages::TargetCounters> counters_;                // the last counters
  std::int64_t last_beat_us_ = 0;
};

}  // namespace canhil::checks
