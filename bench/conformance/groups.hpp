// Collects frames into sample groups and answers. Works for all messages of the DBC.
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
  std::uint8_t counter = 0;  ///< E2E counter of the group's last frame
  std::vector<Frame> frames;
  std::size_t step = 0;  ///< number of Sync or StepDone frames before the group's last frame

  /// Returns the value of the named signal, whichever message of the group contains it; nullopt: no message
  /// of the group has a signal of this name.
  [[nodiscard]] std::optional<double> value(std::string_view signal) const;
};

/// The ids of the messages of a group in ascending order, which is the order of transmission.
std::vector<std::uint32_t> ids_of(std::string_view group);

/// Splits a sequence of frames into groups, in the order in which the groups end. A group ends with the
/// message that has the highest id in the group. If that message is missing, the group ends before the first
/// frame whose id the group already contains. Frames that belong to no group are ignored.
std::vector<Group> groups_in(std::span<const Frame> frames);

/// Whether the messages of `group` carry answers of the target.
bool answers_something(std::string_view group);
/// Whether the group named `answer` carries the answers to samples of the group named `sample`.
bool answers(std::string_view answer, std::string_view sample);

/// Adds `shift_us` to the time that a frame carries (time base or time of validity), modulo the range of the
/// signal, and renews the CRC. The counter stays the same. A frame that carries no time stays unchanged.
void shift_time(Frame& frame, std::int64_t shift_us);

}  // namespace canhil::conformance
