// The codec for a DBC known only at run time, by names and a value at a time: a thin layer over plan.hpp,
// which is what to use for more than a few frames.
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

/// True if the frame holds the signal: every multiplexor above it has one of the values it asks for.
bool is_present(const Message& message, const Signal& signal, std::span<const std::uint8_t> data);

struct DecodedSignal {
  const Signal* signal = nullptr;
  double value = 0;
};

/// The signals that a frame holds, in the order of the DBC. Error if the data is not as long as the message.
Result<std::vector<DecodedSignal>> decode(const Message& message, std::span<const std::uint8_t> data);

struct NamedValue {
  std::string_view signal;
  double value = 0;
};

/// The message's bytes for physical values; signals not named are encoded from 0, bits of no signal are 0,
/// and multiplexed signals that the multiplexors' values leave out are not written. Error for a name that is
/// no signal.
Result<std::vector<std::uint8_t>> encode(const Message& message, std::span<const NamedValue> values);

}  // namespace canhil::dbc
