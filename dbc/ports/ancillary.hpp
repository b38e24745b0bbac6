// What the kernel says beside a received frame.
#pragma once

#include <sys/socket.h>

#include <cstdint>
#include <optional>

namespace canhil {

struct Ancillary {
  std::int64_t software_ns = 0;       ///< CLOCK_REALTIME as the driver handed the frame over; 0: none
  std::int64_t hardware_ns = 0;       ///< the controller's own clock; 0: none
  std::optional<std::uint32_t> lost;  ///< by the receive queue since the socket was opened, modulo 2^32
};

/// Reads the control messages SO_TIMESTAMPING and SO_RXQ_OVFL of one recvmsg().
Ancillary read_ancillary(msghdr& message);

}  // namespace canhil
