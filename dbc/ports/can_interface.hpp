// Queries the kernel about a CAN interface.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace canhil {

/// The interface's index; 0: no interface has this name.
int interface_index(const std::string& interface);

/// One line that says why the interface cannot be used (missing, not CAN, down, or classic although FD is
/// needed); none: it can. `socket` may be any socket.
std::optional<std::string> objection(int socket, std::string_view interface, bool fd);

}  // namespace canhil
