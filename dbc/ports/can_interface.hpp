// Queries the kernel about a CAN interface.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace canhil {

/// The index of the interface with this name; 0: no interface has this name.
int interface_index(const std::string& interface);

/// Returns one line with the reason why the interface cannot be used: it is missing, not a CAN interface,
/// down, or classic although `fd` is true. nullopt: the interface can be used. `socket` may be any socket.
std::optional<std::string> objection(int socket, std::string_view interface, bool fd);

/// The entries of the kernel's receive lists (/proc/net/can/rcvlist_*) that receive from the interface, one
/// for each filter of each socket: more than before means that a program has bound a socket. none: the kernel
/// does not tell.
std::optional<std::size_t> receivers_on(std::string_view interface);

}  // namespace canhil
