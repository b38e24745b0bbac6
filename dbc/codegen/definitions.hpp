// Definitions that the generated header only declares, with static checks of the generated code.
#pragma once

#include <string>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// True if a Frame has room behind the packed bytes for one double per signal that packing rounds. False if
/// such a signal is multiplexed: only the packed bytes show whether the frame holds it.
bool can_travel_unrounded(const Message& message);

/// Definitions of a message's signals() and scaled(), and assertions on its layout and resolution.
std::string definitions_text(const Message& message);

}  // namespace canhil::dbc
