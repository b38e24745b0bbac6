// Reassembles sample groups and answers from frames, for any message.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "dbc/wire/frame.hpp"

namespace canhil::conformance {

/// The frames of one sample or of one answer, in their order.
struct Group {
  std::string_view name;
  std::uint8_t counter = 0;  ///< E2E counter of its last frame
  std::vector<Frame> frames;
  std::size_t step = 0;  ///< number of steps closed (Sync or StepDone) before its last frame

  /// The value of a signal in any message of the group; none: no message has a signal of this name.
  [[nodiscard]] std::optional<double> value(std::string_view signal) const;
};

/// The ids of the messages of a group in ascending order, which is the order of transmission.
std::vector<std::uint32_t> ids_of(std::string_view group);

/// Splits a sequence of frames into groups, in the order in which the groups end. A group ends with its
/// message of the highest id. If that message is missing, the group ends when another of its messages
/// repeats. Frames without a group are ignored.
std::vector<Group> groups_in(std::span<const Frame> frames);

/// Whether a group carries answers.
bool answers_something(std::string_view group);
/// Whether `answer` answers samples of the group `sample`.
bool answers(std::string_view answer, std::string_view sample);

/// Shifts the time in a frame (time base or time of validity), modulo the signal's range, and renews the CRC.
/// The counter stays the same. Frames without a time are unchanged.
void shift_time(Frame& frame, std::int64_t shift_us);

}  // namespace canhil::conformance
