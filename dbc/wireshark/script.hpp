// Wireshark's own tables for signals (the UATs of its protocol Signal PDU) have no signed signals of other
// sizes than 8, 16, 32 and 64 bits, and no Motorola signal that begins inside a byte after an Intel signal. A
// script in Lua, which tshark and Wireshark load, has no such limits.
#pragma once

#include <string>
#include <string_view>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// A Lua script for tshark and Wireshark that decodes the messages of a DBC. Each signal becomes a field with
/// the name protocol.message.signal, in the unit of the signal. `source` is the file name of the DBC: its
/// stem becomes the name of the protocol.
std::string wireshark_script(const Database& database, std::string_view source);

/// The part of the script that does not depend on the DBC. It uses the tables `protocol` and `messages`.
extern const std::string_view wireshark_dissector;

}  // namespace canhil::dbc
