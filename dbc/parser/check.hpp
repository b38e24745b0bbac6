// Checks that need a complete message. Internal to the parser.
#pragma once

#include <string>
#include <vector>

#include "dbc/parser/finding.hpp"

namespace canhil::dbc {

/// For each signal of a message: whether it is left out.
using LeftOut = std::vector<bool>;

/// "Message.signal"
std::string full_name(const Message& message, const Signal& signal);

/// Assigns a multiplexor to every multiplexed signal. multiplexing.cpp
void resolve_multiplexors(Findings& findings, Message& message, LeftOut& left_out);
/// Checks types and values of multiplexors, and finds cycles.
void check_multiplexing(Findings& findings, const Message& message, LeftOut& left_out);
/// Leaves out the signals of multiplexors that are left out.
void leave_out_multiplexed(Findings& findings, const Message& message, LeftOut& left_out);

}  // namespace canhil::dbc
