// What a target says of itself beside its answers: the errors of its heartbeat, its counters; and whether it
// says anything.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "bench/scenario/checks.hpp"
#include "messages/canhil.hpp"

namespace canhil::checks {

/// Times are the bench's, of the last Sync.
class Complaints {
 public:
  struct Said {
    std::int64_t t_us = 0;
    std::string_view what;  ///< "input_lost", "degraded"; "bad_crc", as counted
  };

  void hear(const messages::TargetHeartbeat& beat, std::int64_t now_us);
  void hear(const messages::TargetCounters& counters, std::int64_t now_us);
  /// The run is over: a silence at its end is one too.
  void end(std::int64_t now_us);

  /// Errors as they rise, as a target keeps them up to the end; `degraded` with each heartbeat that has it.
  [[nodiscard]] const std::vector<Said>& of_heartbeats() const { return of_heartbeats_; }
  /// Counters as they grow.
  [[nodiscard]] const std::vector<Said>& of_counters() const { return of_counters_; }
  /// Stretches without a heartbeat that are longer than any may be (silence.hpp).
  [[nodiscard]] const std::vector<scenario::Window>& silences() const { return silences_; }

  /// Every `what` there may be.
  static std::vector<std::string_view> names();

 private:
  std::vector<Said> of_heartbeats_, of_counters_;
  std::vector<scenario::Window> silences_;
  std::map<messages::Estimator, messages::TargetHeartbeat> beats_;  // the last of each estimator
  std::optional<messages::TargetCounters> counters_;                // the last
  std::int64_t last_beat_us_ = 0;
};

}  // namespace canhil::checks
