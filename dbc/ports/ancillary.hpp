// The kernel's time stamps of a received frame.
#pragma once

#include <sys/socket.h>

#include <cstdint>

namespace canhil {

struct Ancillary {
  /// The CLOCK_REALTIME at which the driver delivered the frame to the kernel; 0: no stamp.
  std::int64_t software_ns = 0;
  std::int64_t hardware_ns = 0;  ///< stamp of the controller's own clock; 0: no stamp
};

/// Reads the time stamps from the control messages (SO_TIMESTAMPING) of one received frame.
Ancillary read_ancillary(msghdr& message);

}  // namespace canhil
