// The values in a message of a mapped target.
#pragma once

#include <cmath>
#include <vector>

#include "bench/mapping/mapping.hpp"
#include "dbc/parser/codec.hpp"

namespace canhil::mapping {

/// Calls give(signal, value, invalid) for each reported signal that a frame contains, with its value in SI.
/// NaN: the frame says that it has no value, or the value is NaN; `invalid` tells the two apart. The frame
/// must have the size of the message. `values`: room that the caller keeps from one frame to the next.
template <class Give>
void read(const Hear& hear, const Frame& frame, std::vector<double>& values, Give give) {
  values.resize(hear.of.plan.signals());
  static_cast<void>(hear.of.plan.decode(frame.payload(), values));  // the sizes match
  for (const ReportedSignal& one : hear.reported_signals) {
    const std::size_t number = hear.of.number(*one.signal);
    if (!hear.of.plan.is_present(number, frame.payload())) continue;
    const bool invalid = one.invalid && dbc::raw_bits(*one.signal, frame.payload()) == *one.invalid;
    give(one, invalid ? std::nan("") : values[number] * one.factor, invalid);
  }
}

}  // namespace canhil::mapping
