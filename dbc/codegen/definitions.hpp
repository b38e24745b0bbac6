// Generates two parts of the source: definitions of the functions that the generated header only declares,
// and static checks of the generated code.
#pragma once

#include <string>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// True if a Frame has room behind the packed bytes for doubles, namely one double for each signal that
/// packing rounds. Also false if a signal that packing rounds is multiplexed, because only the packed bytes
/// show whether the frame contains this signal.
bool can_travel_unrounded(const Message& message);

/// C++ text: the definitions of signals() and scaled() of a message, and assertions about the layout and the
/// resolution of the message.
std::string definitions_text(const Message& message);

}  // namespace canhil::dbc
