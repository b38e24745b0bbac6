// Checks that are possible only for a complete message. This header is internal to the parser.
#pragma once

#include <string>
#include <vector>

#include "dbc/parser/finding.hpp"

namespace canhil::dbc {

/// For each signal of a message: true if the reader leaves the signal out of the database.
using LeftOut = std::vector<bool>;

/// "Message.signal"
std::string full_name(const Message& message, const Signal& signal);

/// Gives the objects with a long symbol (an attribute such as SystemSignalLongSymbol) this name, and changes
/// all references to them. Defined in long_symbols.cpp.
void use_long_symbols(Findings& findings, Database& database);

/// Assigns the multiplexor of the message to each multiplexed signal for which the text names no multiplexor.
/// If the message has no multiplexor or several, leaves these signals out. Defined in multiplexing.cpp, like
/// the next two functions.
void resolve_multiplexors(Findings& findings, Message& message, LeftOut& left_out);
/// Checks the types and values of multiplexors. Leaves out signals that are multiplexed in a cycle.
void check_multiplexing(Findings& findings, const Message& message, LeftOut& left_out);
/// Leaves out each signal whose multiplexor is left out. Repeats this until no such signal remains.
void leave_out_multiplexed(Findings& findings, const Message& message, LeftOut& left_out);

}  // namespace canhil::dbc
