// CAN by the kernel: a raw socket on one interface (can0, vcan0).
//
// Stamps are the kernel's, CLOCK_REALTIME, taken when the driver hands the frame over (own echo: when it has
// left). Room to send: the socket's send buffer is the smallest there is, 4 to 6 frames, fewer than an
// interface's queue (txqueuelen 10). So it is the socket that is full first: send() gets EAGAIN, and poll()
// tells truly when to go on. The interface's queue can still be full from other senders: ENOBUFS, of which
// poll() knows nothing (it says writable at once). Then room_wait() asks for a pause of about a frame's
// length instead.
#pragma once

#include "dbc/ports/port.hpp"

namespace canhil {

/// Opens a SocketCAN interface by its name. Error: no CAN in this kernel, no such interface, not a CAN
/// interface, interface down, FD on a classic one, or no permission. An interface that goes down later, or is
/// removed, and comes back under its name, is carried on with: meanwhile up() is false and send() says down.
/// Remote frames are not received.
Result<std::unique_ptr<Port>> open_socketcan(std::string_view interface, const PortOptions& options);

}  // namespace canhil
