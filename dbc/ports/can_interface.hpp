// What the kernel says of a CAN interface.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace canhil {

/// Its index; 0: there is none of this name.
int interface_index(const std::string& interface);

/// Nothing, or one line why this interface cannot be used: not there, no CAN, down, classic where FD is asked
/// for. Asks by way of any socket.
std::optional<std::string> objection(int socket, std::string_view interface, bool fd);

}  // namespace canhil
