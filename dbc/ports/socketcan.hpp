// SocketCAN: a raw CAN socket on one interface (can0, vcan0).
//
// Stamps are the kernel's, CLOCK_REALTIME, taken when the driver hands the frame over (own echo: after
// transmission). Room to send: the socket's send buffer has the minimum size, 4 to 6 frames, less than an
// interface's queue (txqueuelen 10). The socket therefore fills up first: send() gets EAGAIN, and poll()
// signals room correctly. Other senders can still fill the interface's queue: send() then gets ENOBUFS, for
// which poll() is useless (it reports writable at once), and room_wait() asks for a pause of about one frame.
#pragma once

#include "dbc/ports/port.hpp"

namespace canhil {

/// Opens a SocketCAN interface by its name. Error: no CAN in this kernel, no such interface, not a CAN
/// interface, interface down, FD on a classic one, or no permission. The port survives an interface that goes
/// down or is removed and returns under the same name. Meanwhile up() is false and send() returns `down`.
/// Remote frames are not received.
Result<std::unique_ptr<Port>> open_socketcan(std::string_view interface, const PortOptions& options);

}  // namespace canhil
