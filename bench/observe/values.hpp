// The signals of a frame, for any message.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dbc/wire/frame.hpp"
#include "dbc/wire/message_info.hpp"

namespace canhil::observe {

struct Value {
  const SignalInfo* signal = nullptr;
  double value = 0;             ///< in the signal's unit; for an enumeration the number of the value
  std::string_view enumerator;  ///< for an enumeration the value's name; otherwise empty
};

/// The value as text for people: a number with 12 digits, or the enumerator.
std::string to_text(const Value& value);

/// The signals of a frame except counter and checksum, in the order of the DBC; empty: the frame is not a
/// message of the DBC.
std::vector<Value> values_of(const Frame& frame);
/// The name of the frame's message; empty: the frame is not a message of the DBC.
std::string_view message_of(const Frame& frame);

/// The signals of a message in the DBC, except counter and checksum.
std::vector<const SignalInfo*> signals_of(const MessageInfo& message);
/// Null: the message has no such signal.
const SignalInfo* signal_of(const MessageInfo& message, std::string_view name);

/// Whether the frame is an answer of the target in any run; excludes reports about the host (TargetTiming)
/// and frames that exist in virtual time only (StepDone).
bool is_answer(const Frame& frame);

}  // namespace canhil::observe
