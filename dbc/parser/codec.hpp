// A codec for a DBC that is known only at run time. It finds signals by name, which makes it slow; use
// plan.hpp to decode or encode more than a few frames.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "dbc/parser/database.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::dbc {

/// The bits of a signal, right-aligned, without sign extension. `data` must contain the whole message.
std::uint64_t raw_bits(const Signal& signal, std::span<const std::uint8_t> data);

/// Writes the lowest `signal.length` bits of `raw` into the bits of the signal, and does not change other
/// bits. `data` must contain the whole message.
void put_raw_bits(const Signal& signal, std::uint64_t raw, std::span<std::uint8_t> data);

/// Converts raw bits (right-aligned) to the physical value raw * scale + offset, in the unit of the signal.
double to_physical(const Signal& signal, std::uint64_t raw);

/// Converts a physical value to raw bits. A value outside [minimum, maximum], or outside the range that the
/// signal's bits can represent, becomes the nearest limit. The raw value of an integer signal is rounded half
/// to even. NaN becomes the minimum.
std::uint64_t to_raw(const Signal& signal, double value);

/// The name of a raw value (right-aligned bits); empty: the raw value has no name.
std::string_view value_name(const Signal& signal, std::uint64_t raw);

/// True if the frame contains the signal, i.e. if every multiplexor above the signal has a value that selects
/// the signal.
bool is_present(const Message& message, const Signal& signal, std::span<const std::uint8_t> data);

/// A signal that a frame contains, and the physical value of the signal.
struct DecodedSignal {
  const Signal* signal = nullptr;
  double value = 0;
};

/// The signals that a frame contains, in the order of the DBC. Returns an error if the length of `data` is
/// not that of the message.
Result<std::vector<DecodedSignal>> decode(const Message& message, std::span<const std::uint8_t> data);

/// A physical value for the signal with the name `signal`.
struct NamedValue {
  std::string_view signal;
  double value = 0;
};

/// Encodes physical values. Signals that `values` does not name have the value 0, and unused bits are 0.
/// Multiplexed signals that the multiplexors do not select are not written. Returns an error if the message
/// has no signal with one of the names.
Result<std::vector<std::uint8_t>> encode(const Message& message, std::span<const NamedValue> values);

}  // namespace canhil::dbc
