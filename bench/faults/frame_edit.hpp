// Reads and writes a signal in a frame of canhil's DBC. After writing, the counter and the CRC of the frame
// are valid.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "dbc/wire/frame.hpp"
#include "dbc/wire/message_info.hpp"

namespace canhil::faults {

/// The value of a signal in its unit; nullopt if the frame has no such signal.
std::optional<double> value_of(const Frame& frame, std::string_view signal);

/// Writes a signal. Unless the frame is unrounded, the value is rounded to the step of the signal and limited
/// to its range. All other signals stay unchanged.
void set(Frame& frame, std::string_view signal, double value);

/// Whether a signal is the validity flag of a sensor's sample.
bool is_validity(const MessageInfo& info, std::string_view name);

/// Whether a signal is the time of validity or the interval of a sample.
bool is_time(std::string_view signal);

/// Writes the counter and the CRC of a frame; does nothing if the message has no counter and CRC.
void set_counter(Frame& frame, const MessageInfo& message, std::uint8_t counter);

}  // namespace canhil::faults
