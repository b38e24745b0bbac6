// Sample groups and answers put together again from frames, whichever messages they are of.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "dbc/wire/frame.hpp"

namespace canhil::conformance {

/// The frames of one sample or of one answer, as they followed one another.
struct Group {
  std::string_view name;
  std::uint8_t counter = 0;  ///< E2E counter of its last frame
  std::vector<Frame> frames;
  std::size_t step = 0;  ///< how many frames that close a step, Sync or StepDone, were before its last one

  /// A value of any of its messages; none: the group has no such signal.
  [[nodiscard]] std::optional<double> value(std::string_view signal) const;
};

/// The messages that make up a group, by id: the order in which they are sent.
std::vector<std::uint32_t> ids_of(std::string_view group);

/// The groups of a stretch of frames in the order in which they end: each with its message of the highest id,
/// or, if that is missing, when one of its messages comes again. Frames of no group are left out.
std::vector<Group> groups_in(std::span<const Frame> frames);

/// Whether a group is one of answers.
bool answers_something(std::string_view group);
/// Whether `answer` answers samples of the group `sample`.
bool answers(std::string_view answer, std::string_view sample);

/// Adds to the time that a frame carries, of the time base or of validity, as many microseconds, modulo what
/// the signal can hold; protects it anew. Frames without a time stay.
void shift_time(Frame& frame, std::int64_t shift_us);

}  // namespace canhil::conformance
