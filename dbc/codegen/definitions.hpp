// Definitions that the generated header only declares, with static checks of the generated code.
#pragma once

#include <string>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// True if the signals that packing rounds fit as doubles behind the packed bytes in a Frame. False if one of
/// them is multiplexed: only the packed bytes show whether it is present.
bool can_travel_unrounded(const Message& message);

/// Definitions of a message's signals() and scaled(), and assertions on its layout and resolution.
std::string definitions_text(const Message& message);

}  // namespace canhil::dbc
