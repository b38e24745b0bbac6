// A codec for a DBC known only at run time: a thin layer over plan.hpp that finds signals by name. It is
// slow; for more than a few frames use plan.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "dbc/parser/database.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::dbc {

/// The signal's bits, right-aligned, not sign-extended. The data must hold the whole message.
std::uint64_t raw_bits(const Signal& signal, std::span<const std::uint8_t> data);

/// Writes the lowest `signal.length` bits of raw; leaves other bits alone. The data must hold the whole
/// message.
void put_raw_bits(const Signal& signal, std::uint64_t raw, std::span<std::uint8_t> data);

/// Raw bits (right-aligned) to the physical value raw * scale + offset, in the signal's unit.
double to_physical(const Signal& signal, std::uint64_t raw);

/// Physical value to raw bits: rounded half to even, saturated to [minimum, maximum] and to what the bits can
/// hold; NaN becomes the minimum.
std::uint64_t to_raw(const Signal& signal, double value);

/// The name of a raw value (right-aligned bits); empty: it has none.
std::string_view value_name(const Signal& signal, std::uint64_t raw);

/// True if the frame holds the signal: every multiplexor above it has one of the values that select it.
bool is_present(const Message& message, const Signal& signal, std::span<const std::uint8_t> data);

/// A signal that a frame holds, and its physical value.
struct DecodedSignal {
  const Signal* signal = nullptr;
  double value = 0;
};

/// The signals that a frame holds, in the order of the DBC. Error if data and message differ in length.
Result<std::vector<DecodedSignal>> decode(const Message& message, std::span<const std::uint8_t> data);

/// A physical value for the signal of that name.
struct NamedValue {
  std::string_view signal;
  double value = 0;
};

/// Encodes physical values. Signals that are not named get the value 0; unused bits are 0; multiplexed
/// signals that the multiplexors do not select are not written. Error for an unknown signal name.
Result<std::vector<std::uint8_t>> encode(const Message& message, std::span<const NamedValue> values);

}  // namespace canhil::dbc
