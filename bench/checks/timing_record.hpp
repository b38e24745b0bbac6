// The timing of a run, message by message, in a memory that does not grow with it.
#pragma once

#include <array>
#include <cstdint>

#include "bench/checks/histogram.hpp"
#include "messages/canhil.hpp"

namespace canhil::checks {

/// Of a message of the target.
struct AnswerTiming {
  Histogram latency;  ///< from the last frame of the stimulus group to the answer, both on the bus
  /// |deviation| of the time between two arrivals from what it should be: between the deadlines of the two
  /// stimuli, or the cycle time of a message that answers nothing.
  Histogram jitter;
  TimeLine latency_line;       ///< over the time of arrival
  std::uint64_t unpaired = 0;  ///< answers to what the bench did not send
};

/// Of a message of the bench: how long after its deadline.
struct TransmitTiming {
  Histogram handed_over;  ///< to the bus
  Histogram echoed;       ///< it had passed the bus; empty where the bus echoes nothing
};

struct TimingRecord {
  std::array<AnswerTiming, messages::all_messages.size()> answers;     ///< by place in all_messages
  std::array<TransmitTiming, messages::all_messages.size()> transmit;  ///< by place in all_messages
  Histogram lateness;                     ///< of all messages of the bench when handed over
  TimeLine lateness_line;                 ///< the same over time
  std::array<std::uint64_t, 5> stamps{};  ///< frames of the target by StampSource
};

}  // namespace canhil::checks
