// Frames read from a CAN socket by one system call.
#pragma once

#include <linux/can.h>
#include <sys/socket.h>

#include <array>
#include <cstddef>

#include "dbc/ports/ancillary.hpp"

namespace canhil {

class ReceiveBatch {
 public:
  static constexpr std::size_t capacity = 16;

  struct Item {
    const canfd_frame& frame;
    bool fd = false;
    bool own = false;  ///< the echo of a frame sent by the same socket
    Ancillary ancillary;
  };

  ReceiveBatch();
  ReceiveBatch(const ReceiveBatch&) = delete;
  ReceiveBatch& operator=(const ReceiveBatch&) = delete;

  [[nodiscard]] bool empty() const { return next_ == count_; }
  /// The next frame; the batch must not be empty. Valid until fetch().
  Item take();
  /// Reads all waiting frames, up to the capacity. False: no frame; errno says why. `flags` as for
  /// recvmmsg(): MSG_DONTWAIT, or MSG_WAITFORONE to wait for the first frame up to the socket's SO_RCVTIMEO.
  bool fetch(int socket, int flags);
  /// True if the last fetch() left nothing behind.
  [[nodiscard]] bool took_all() const { return count_ < capacity; }

 private:
  // Enough for the control message that read_ancillary() reads.
  static constexpr std::size_t control_bytes = 128;
  struct alignas(cmsghdr) Control {
    std::array<char, control_bytes> bytes;
  };
  std::array<canfd_frame, capacity> frames_{};
  std::array<Control, capacity> controls_{};
  std::array<iovec, capacity> parts_{};
  std::array<mmsghdr, capacity> messages_{};
  std::size_t count_ = 0;
  std::size_t next_ = 0;
};

}  // namespace canhil
