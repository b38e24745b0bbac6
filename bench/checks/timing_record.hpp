// The timing of a run, message by message, in bounded memory.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/checks/histogram.hpp"
#include "bench/scenario/checks.hpp"
#include "dbc/ports/port.hpp"
#include "dbc/spool/spool.hpp"
#include "messages/canhil.hpp"

namespace canhil::checks {

/// One arrival of a message of the target.
struct Arrival {
  std::int64_t t_ns = 0;         ///< stamp of the port
  std::int64_t hardware_ns = 0;  ///< the controller's own stamp, on its own clock; 0: none
};

/// The last frame of a sample group that the bench sent.
struct Stimulus {
  std::int64_t valid_us = 0;
  std::uint8_t counter = 0;      ///< E2E counter of the group
  std::int64_t t_ns = 0;         ///< transmit stamp: the stamp of the echo if the bus echoes frames,
                                 ///< otherwise the bench's own
  std::int64_t hardware_ns = 0;  ///< the controller's own stamp of the echo; 0: none
  std::int64_t due_ns = 0;       ///< deadline of the frame, on the clock of t_ns
  bool owed_answer = true;       ///< false: the frames were damaged, incomplete, invalid or late, so the
                                 ///< target need not answer
};

/// A stimulus that a message had to answer.
struct OwedAnswer {
  std::int64_t valid_us = 0;  ///< time of validity of the stimulus
  bool came = false;
};

/// The time [ns] from one stamp to a later stamp. If the controller stamped both events, the time is measured
/// on the controller's clock.
template <class From, class To>
constexpr std::int64_t elapsed_ns(const From& from, const To& to) {
  const bool hardware = from.hardware_ns != 0 && to.hardware_ns != 0;
  return hardware ? to.hardware_ns - from.hardware_ns : to.t_ns - from.t_ns;
}

/// Timing of a message of the target.
struct AnswerTiming {
  Histogram latency;  ///< from the last frame of the stimulus group to the answer, both on the bus
  /// How much the time from one arrival to the next differs from the nominal time (absolute value). The
  /// nominal time is the time between the deadlines of the two stimuli. For a message that answers nothing,
  /// the nominal time is the cycle time.
  Histogram jitter;
  TimeLine latency_line;       ///< latency over the time of arrival
  std::uint64_t count = 0;     ///< arrivals
  std::uint64_t unpaired = 0;  ///< answers to stimuli that the bench did not send
  std::uint64_t repeated = 0;  ///< answers to stimuli that were answered before
  /// How close an answer in `unpaired` came to a stimulus: the smallest difference between the time that an
  /// answer names and the time of validity of a stimulus.
  std::optional<std::int64_t> nearest_us{};
  std::string ambiguous{};          ///< why the causes of answers are not certain; empty: they are certain
  std::uint64_t wrong_counter = 0;  ///< answers that name the time of one cause and the counter of another
  std::uint8_t counter_reported = 0, counter_sent = 0;  ///< in the first answer with a wrong counter
  std::int64_t reply_wire_ns = 0;  ///< sum over the answers in `latency`: time that the answer's frames, up
                                   ///< to this message, occupied the wire
  std::optional<std::int64_t> last_ns{};  ///< last arrival
  std::int64_t longest_silence_ns = 0;    ///< longest wait before an arrival
};

/// Lateness of a message of the bench.
struct TransmitTiming {
  Histogram handed_over;  ///< lateness at the hand-over to the bus
  Histogram echoed;       ///< lateness at the end of the frame on the bus; empty if the bus has no echo
};

/// The time from the queueing of a frame to the end of the frame on the bus. For a frame of the bench, this
/// is the time from the hand-over to the echo. The bench hands over a container with the container's last
/// message; if that message is missing, the time is unknown. For a frame of the target, the time counts from
/// the beginning of the first frame of the same answer. This is a lower bound, because the bench cannot see
/// when the target queued the frame.
struct WireResponse {
  std::uint64_t count = 0;
  std::int64_t max_ns = 0;
};

/// The timing of a message in a window that a check requires. An answer is in the window if the time of
/// validity of its cause is in the window. For a message that answers nothing, the window is the whole run.
struct TimedWindow {
  std::size_t message = 0;  ///< index in TimingRecord::messages
  scenario::Window window{};
  Histogram latency{};
  std::optional<std::int64_t> slowest_us{};  ///< time of validity of the stimulus with the largest latency
  Histogram period{};                        ///< from one arrival to the next
  /// The time from the deadline of a stimulus until the stimulus was on the bus. The host causes this delay.
  Histogram lateness{};
  /// How far the bench itself deviates from the period of the stimuli that the message answers. For two
  /// successive stimuli, this is the absolute difference between two times: the time between them on the bus,
  /// and the time between their deadlines. If the bench sends one stimulus in place of n due stimuli, this
  /// deviation counts n times.
  Histogram stimulus_deviation{};
  std::optional<Arrival> first_arrival{}, last_arrival{};
  std::optional<std::int64_t> first_stimulus_ns{};  ///< stamp of the first stimulus in the window
  std::optional<std::int64_t> last_stimulus_ns{};   ///< stamp of the last stimulus whose time of validity is
                                                    ///< not after the window
};

/// TargetTiming saturates at this value [us]: a reported time of this value is a lower bound.
inline constexpr std::uint16_t most_reported_us = 8191;

/// The time from the hand-over of the last frame of a stimulus to the last frame of its answer, divided into
/// parts. Each value is a sum over the answered stimuli.
struct LatencyBreakdown {
  std::uint64_t stimuli = 0;          ///< answered stimuli
  std::uint64_t echoed = 0;           ///< answered stimuli whose echo was seen
  std::int64_t to_echo_ns = 0;        ///< from the hand-over to the end of the stimulus on the bus
  std::int64_t stimulus_wire_ns = 0;  ///< part of to_echo_ns: the stimulus's own time on the wire
  std::int64_t latency_ns = 0;        ///< from the end of the stimulus to the end of its answer's last frame
  std::int64_t reply_wire_ns = 0;     ///< part of latency_ns: the answer's own time on the wire
  std::uint64_t accounted = 0;  ///< stimuli before the last TargetTiming: the target reported its times for
                                ///< these stimuli
  std::int64_t target_queue_ns = 0;    ///< for `accounted`: from the target's stamp to the start of its work
  std::int64_t target_compute_ns = 0;  ///< for `accounted`: the target's computing time
  bool queue_clipped = false;  ///< some reported mean equals most_reported_us, so the true time is longer
  bool compute_clipped = false;
};

/// The breakdown for the stimuli of one sample group. The target's times stay 0 here, because TargetTiming
/// covers all groups together.
struct GroupBreakdown {
  std::string_view group{};
  LatencyBreakdown breakdown{};
};

/// The slowest answer, and what the target reported for the window of that answer.
struct SlowestAnswer {
  std::string_view message{};
  std::int64_t t_ns = 0;  ///< time of arrival since the bench's first transmission
  std::int64_t latency_ns = 0;
  std::int64_t reply_wire_ns = 0;
  std::uint16_t queue_max_us = 0;
  std::uint16_t compute_max_us = 0;
};

struct TimingRecord {
  TimingRecord() : TimingRecord(canhil::messages::all_messages) {}
  /// `bus`: the messages of the bus.
  explicit TimingRecord(std::span<const MessageInfo> bus)
      : messages(bus), answers(bus.size()), transmit(bus.size()), responses(bus.size()) {}

  std::span<const MessageInfo> messages;
  WireFacts wire{};
  std::vector<AnswerTiming> answers;                ///< by index in `messages`
  std::map<std::size_t, Spool<OwedAnswer>> owed{};  ///< by index in `messages`, of the last message of each
                                                    ///< answer group
  std::vector<TransmitTiming> transmit;             ///< by index in `messages`
  std::vector<WireResponse> responses;              ///< by wire::Carrier::first
  Histogram lateness;                     ///< lateness of all messages of the bench at the hand-over
  TimeLine lateness_line;                 ///< the largest lateness over time
  std::array<std::uint64_t, 5> stamps{};  ///< frames of the target by StampSource
  std::vector<TimedWindow> windows{};     ///< as the checks require
  LatencyBreakdown breakdown{};
  std::vector<GroupBreakdown> breakdown_by_group{};  ///< in the order of their first answers
  SlowestAnswer slowest{};                           ///< among the answers before the last TargetTiming
  std::uint64_t stimuli_with_hardware_stamp = 0;
  std::uint64_t without_hardware_stamp = 0;  ///< stimuli and frames of the target without hardware stamp
};

}  // namespace canhil::checks
