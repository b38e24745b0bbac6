// A number in a frame of the contract: read, and written so that counter and CRC are right.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "dbc/wire/frame.hpp"
#include "dbc/wire/message_info.hpp"

namespace canhil::faults {

/// In the signal's unit; none: the frame has no such signal.
std::optional<double> value_of(const Frame& frame, std::string_view signal);

/// Writes a signal, rounded to its step and clamped to its range unless the frame rounds nothing; all others
/// stay as they are.
void set(Frame& frame, std::string_view signal, double value);

/// Whether a signal is the flag by which a sensor vouches for its sample.
bool is_validity(const MessageInfo& message, std::string_view signal);

/// Whether a signal says when a sample is valid, or over how long.
bool is_time(std::string_view signal);

/// Writes the counter of a message that has one, and its CRC.
void set_counter(Frame& frame, const MessageInfo& message, std::uint8_t counter);

}  // namespace canhil::faults
