// Takes the times of a run: latency, jitter and the bench's own lateness, as the frames pass.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "bench/checks/observations.hpp"
#include "bench/checks/timing_record.hpp"
#include "dbc/ports/port.hpp"

namespace canhil::run {

class Stopwatch {
 public:
  explicit Stopwatch(checks::TimingRecord& record) : record_(record) {}

  /// The bench handed over a frame at `t_ns`, `late_ns` after its deadline.
  void sent(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns);
  /// The bus echoed a frame of the bench.
  void echoed(const Received& received);
  /// A message of the target came; `index`: its place in all_messages.
  void arrived(std::size_t index, const Received& received);
  /// What it answers; null: nothing that the bench sent.
  void answered(std::size_t index, const checks::Arrival& arrival, const checks::Stimulus* stimulus);

 private:
  // Frames on their way, by the counter that each carries: one that is as old as 16 of its kind is lost.
  struct Pending {
    Frame frame;
    std::int64_t t_ns = 0;
    std::int64_t late_ns = 0;
    bool waiting = false;
  };
  struct Last {
    checks::Arrival arrival;
    std::int64_t due_ns = 0;  // when what it answers was to be sent
  };

  checks::TimingRecord& record_;
  std::array<std::array<Pending, 16>, messages::all_messages.size()> pending_{};
  std::array<std::optional<Last>, messages::all_messages.size()> last_{};
  std::optional<std::int64_t> first_ns_;
};

}  // namespace canhil::run
