// Angles that come round.
#pragma once

#include "dbc/wire/message_info.hpp"

namespace canhil::wire {

/// Whether a signal is an angle from -180 to 180 deg, so that values which differ by a full turn are equal.
constexpr bool turns(const SignalInfo& signal) {
  return signal.unit == "deg" && signal.minimum == -180 && signal.maximum == 180;
}

}  // namespace canhil::wire
