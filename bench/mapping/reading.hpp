// The values in a message of a mapped target.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "bench/mapping/mapping.hpp"
#include "dbc/parser/codec.hpp"

namespace canhil::mapping {

/// Whether frames of a message may have different pages.
bool is_multiplexed(const dbc::Message& message);

/// Whether a signal has the raw value that means "invalid". `invalid`: none: no value means this.
bool says_invalid(const dbc::Signal& signal, const std::optional<std::uint64_t>& invalid,
                  std::span<const std::uint8_t> data);

/// The attitude of the quaternion in a message of which all signals have been decoded; none: it is invalid,
/// or its magnitude is below 1/2. A quaternion is normalised, because its parts are rounded.
std::optional<world::Euler> angles_in(const Hear& hear, std::span<const std::uint8_t> data,
                                      std::span<const double> values);

/// Calls give(signal, value, invalid) for each reported signal that a message contains, with its value in SI.
/// NaN: the message says that it has no value, or the value is NaN; `invalid` tells the two apart. `data`:
/// the bytes of the whole message. `values`: room that the caller keeps from one frame to the next.
template <class Give>
void read(const Hear& hear, std::span<const std::uint8_t> data, std::vector<double>& values, Give give) {
  values.resize(hear.of.plan.signals());
  static_cast<void>(hear.of.plan.decode(data, values));  // the sizes match
  const std::optional<world::Euler> angles = hear.quaternion ? angles_in(hear, data, values) : std::nullopt;
  for (const ReportedSignal& one : hear.reported_signals) {
    if (one.angle != nullptr) {
      give(one, angles ? (*angles).*one.angle : std::nan(""), !angles);
      continue;
    }
    const std::size_t number = hear.of.number(*one.signal);
    if (!hear.of.plan.is_present(number, data)) continue;
    const bool invalid = says_invalid(*one.signal, one.invalid, data);
    give(one, invalid ? std::nan("") : values[number] * one.factor, invalid);
  }
}

/// Whether a flag is set in a message of the target; none: the page that came does not have its signal.
std::optional<bool> state_of(const Hear& hear, const ReportedFlag& flag, std::span<const std::uint8_t> bytes);

}  // namespace canhil::mapping
