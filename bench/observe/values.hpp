// What a frame says, signal by signal, whichever message it is.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dbc/wire/frame.hpp"
#include "dbc/wire/message_info.hpp"

namespace canhil::observe {

struct Value {
  const SignalInfo* signal = nullptr;
  double value = 0;             ///< in the signal's unit; of an enumeration its number
  std::string_view enumerator;  ///< of an enumeration the value's name; empty: of none
};

/// For people: 12 digits, or the enumerator.
std::string to_text(const Value& value);

/// The signals of a frame, without those of its protection, as the DBC orders them; empty: of no message.
std::vector<Value> values_of(const Frame& frame);
/// Empty: of none.
std::string_view message_of(const Frame& frame);

/// Of a message of the contract, without those of its protection.
std::vector<const SignalInfo*> signals_of(const MessageInfo& message);
/// Null: the message has no such signal.
const SignalInfo* signal_of(const MessageInfo& message, std::string_view name);

/// Whether the target answers for it in any run: not what it says of the host (TargetTiming), nor what exists
/// in virtual time only (StepDone).
bool is_answer(const Frame& frame);

}  // namespace canhil::observe
