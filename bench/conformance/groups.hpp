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

  /// A signal of any of its messages; none: the group has no such signal.
  [[nodiscard]] std::optional<double> value(std::string_view signal) const;
};

/// The messages of a group, ordered by id: the order of transmission.
std::vector<std::uint32_t> ids_of(std::string_view group);

/// Splits a sequence of frames into groups, in the order in which the groups end. A group ends with its
/// message of the highest id or, if that is missing, when one of its messages repeats. Frames without a group
/// are ignored.
std::vector<Group> groups_in(std::span<const Frame> frames);

/// Whether a group carries answers.
bool answers_something(std::string_view group);
/// Whether `answer` answers samples of the group `sample`.
bool answers(std::string_view answer, std::string_view sample);

/// Shifts the time in a frame (time base or time of validity), modulo the signal's range, and renews counter
/// and CRC. Frames without a time are unchanged.
void shift_time(Frame& frame, std::int64_t shift_us);

}  // namespace canhil::conformance
