// The kernel's time stamps of a received frame.
#pragma once

#include <sys/socket.h>

#include <cstdint>

namespace canhil {

struct Ancillary {
  std::int64_t software_ns = 0;  ///< CLOCK_REALTIME when the driver handed the frame over; 0: none
  std::int64_t hardware_ns = 0;  ///< the controller's own clock; 0: none
};

/// Reads the control messages of one received frame: SO_TIMESTAMPING.
Ancillary read_ancillary(msghdr& message);

}  // namespace canhil
