// Checks that need a complete message. Internal to the parser.
#pragma once

#include <string>
#include <vector>

#include "dbc/parser/finding.hpp"

namespace canhil::dbc {

/// For each signal of a message: true if the reader leaves the signal out of the database.
using LeftOut = std::vector<bool>;

/// "Message.signal"
std::string full_name(const Message& message, const Signal& signal);

/// Assigns the message's multiplexor to each multiplexed signal for which the text names none; leaves the
/// signal out if the message has no multiplexor or several. Defined in multiplexing.cpp.
void resolve_multiplexors(Findings& findings, Message& message, LeftOut& left_out);
/// Checks types and values of multiplexors, and finds cycles.
void check_multiplexing(Findings& findings, const Message& message, LeftOut& left_out);
/// Leaves out each signal whose multiplexor is left out.
void leave_out_multiplexed(Findings& findings, const Message& message, LeftOut& left_out);

}  // namespace canhil::dbc
