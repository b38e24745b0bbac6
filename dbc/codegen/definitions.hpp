// What the header only declares of a message: compiled once, with the checks on what was generated.
#pragma once

#include <string>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// True if the signals that packing rounds, as doubles, have room behind the packed bytes in a Frame. Never
/// with a multiplexed one among them: only the packed bytes say whether that is there.
bool can_travel_unrounded(const Message& message);

/// Definitions of a message's signals() and scaled(), and assertions on its layout and resolution.
std::string definitions_text(const Message& message);

}  // namespace canhil::dbc
