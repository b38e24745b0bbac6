// SocketCAN: a raw CAN socket on one interface (can0, vcan0).
//
// Time stamps are those of the kernel (CLOCK_REALTIME), which takes them when the driver delivers the frame;
// the echo of an own frame is stamped after the transmission. The send buffer of the socket has the minimum
// size, 4 to 6 frames. This is smaller than the queue of an interface (txqueuelen 10). Therefore, if the port
// sends too fast, the send buffer becomes full before the queue does: send() fails with EAGAIN, and poll()
// signals room correctly. Other senders can still fill the queue of the interface. Then send() fails with
// ENOBUFS, and poll() is useless, because it reports room immediately. In this case, room_wait() requires a
// pause of about one frame.
#pragma once

#include "dbc/ports/port.hpp"

namespace canhil {

/// Opens a SocketCAN interface by its name. Returns an error if the kernel has no CAN, if the interface does
/// not exist, is not a CAN interface, is down, or is classic although FD is needed, or if the permission is
/// missing. If the interface goes down or is removed later, up() is false and send() returns `down`; when an
/// interface with the same name is up again, the port uses it. Remote frames are not received.
Result<std::unique_ptr<Port>> open_socketcan(std::string_view interface, const PortOptions& options);

}  // namespace canhil
