// The checks that need all of a message. Internal to the parser.
#pragma once

#include <string>
#include <vector>

#include "dbc/parser/finding.hpp"

namespace canhil::dbc {

/// Of each signal of a message: whether it is left out.
using LeftOut = std::vector<bool>;

/// "Message.signal"
std::string full_name(const Message& message, const Signal& signal);

/// Gives every multiplexed signal its multiplexor. multiplexing.cpp
void resolve_multiplexors(Findings& findings, Message& message, LeftOut& left_out);
/// Types and values of multiplexors, and circles.
void check_multiplexing(Findings& findings, const Message& message, LeftOut& left_out);
/// Leaves out what lies under a multiplexor that is left out.
void leave_out_multiplexed(Findings& findings, const Message& message, LeftOut& left_out);

}  // namespace canhil::dbc
