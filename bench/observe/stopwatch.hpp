// Measures the times of a run: latency, jitter and the bench's own lateness.
#pragma once

#include <bitset>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "bench/checks/timing_record.hpp"
#include "dbc/ports/fd_groups.hpp"
#include "dbc/wire/carriers.hpp"
#include "dbc/wire/message_places.hpp"

namespace canhil::observe {

/// Remembers the last `remembered` stimuli of each group. An answer to an older stimulus counts as an answer
/// without a cause.
class Stopwatch {
 public:
  static constexpr std::size_t remembered = 1024;

  /// The record defines the windows and the bit rates.
  explicit Stopwatch(checks::TimingRecord& record)
      : record_(record),
        places_(record.messages),
        carriers_(wire::carriers_of(record.messages, record.wire.fd)),
        pending_(record.messages.size()),
        newest_(record.messages.size()),
        wire_ns_(record.messages.size()),
        last_(record.messages.size()) {}

  /// The bench handed over a frame at `t_ns`. The hand-over was `late_ns` after the deadline of the frame.
  void sent(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns);
  /// The frame that was passed to the last call of sent() completed a sample group that the target answers.
  void stimulus(std::string_view name, const checks::Stimulus& stimulus);
  /// The bus echoed a frame of the bench; `group`, `valid_us`: the sample group that this frame completes, if
  /// any, and the time of validity of the group.
  void echoed(const Received& received, std::string_view group, std::int64_t valid_us);
  /// A message of the target arrived; `index`: its index in the record's messages.
  void arrived(std::size_t index, const Received& received);
  /// The newest arrivals of these messages are the answer to a stimulus. `counter`: the counter of the cause,
  /// if the answer carries it.
  void answered(std::span<const std::size_t> indices, std::string_view group, std::int64_t cause_us,
                std::optional<std::uint8_t> counter = std::nullopt);
  /// The target reported its times for the interval since its previous report.
  void on_target_timing(const messages::TargetTiming& timing);
  /// The run is over.
  void finish();

 private:
  // The frames of a message that were handed over but not yet echoed, the oldest first. If there are more
  // than `on_their_way` such frames, the oldest frame counts as lost.
  struct Pending {
    Frame frame;
    std::int64_t t_ns = 0;
    std::int64_t late_ns = 0;
  };
  static constexpr std::size_t on_their_way = 15;
  struct Sent {
    checks::Stimulus stimulus;
    std::optional<std::int64_t> to_echo_ns{};
    std::int64_t wire_ns = 0;
    bool answered = false;
    std::bitset<MessagePlaces::most> answered_by{};  // index of the last message of each answer
    std::int64_t latency_ns = 0;                     // latency of the latest answer so far
    std::map<std::size_t, std::int64_t> latest{};    // the same for each message that has a window
    std::int64_t reply_wire_ns = 0;                  // sum over all answers so far
  };
  struct Group {
    std::deque<Sent> sent{};
    std::optional<checks::Stimulus> before{};  // the stimulus that was removed last
    std::vector<std::size_t> answered_by{};    // indices of the messages that close an answer to it
  };
  struct Last {
    checks::Arrival arrival;
    std::int64_t due_ns = 0;  // deadline of its cause
  };
  // Data since the target's last TargetTiming.
  struct PendingWindow {
    std::uint64_t stimuli = 0;
    checks::SlowestAnswer slowest{};
  };

  Sent* find(std::string_view name, std::int64_t valid_us, std::optional<std::uint8_t> counter = {});
  void without_cause(std::span<const std::size_t> indices, std::string_view group, std::int64_t cause_us);
  void forget_oldest(std::string_view name, Group& group);
  void answered(std::size_t index, std::string_view group, Sent& sent, std::int64_t wire_ns,
                std::int64_t cause_us);
  checks::LatencyBreakdown& split_of(std::string_view group);
  void split(std::size_t index, std::string_view group, Sent& sent, std::int64_t wire_ns,
             std::int64_t latency_ns);
  std::optional<Frame> closed_by(const Frame& message, FdPacker& packer) const;
  [[nodiscard]] std::int64_t on_wire_ns(const Frame& frame) const;
  [[nodiscard]] std::int64_t no_intermission_ns() const;

  [[nodiscard]] std::size_t of_bench(const Frame& frame) const;
  [[nodiscard]] bool answers(std::size_t index, std::string_view group) const;

  checks::TimingRecord& record_;
  MessagePlaces places_;
  std::vector<wire::Carrier> carriers_;
  FdPacker echoes_, arrivals_;  // pack the containers again
  std::vector<std::vector<Pending>> pending_;
  std::map<std::string_view, Group> groups_;
  std::vector<checks::Arrival> newest_;
  std::vector<std::int64_t> wire_ns_;  // time on the wire of received frames, by Carrier::first
  std::vector<std::optional<Last>> last_;
  std::optional<std::int64_t> first_ns_;
  PendingWindow pending_window_;
};

}  // namespace canhil::observe
