// The frames that one system call reads from a CAN socket.
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
    bool own = false;  ///< the echo of a frame that this socket sent
    Ancillary ancillary;
  };

  ReceiveBatch();
  ReceiveBatch(const ReceiveBatch&) = delete;
  ReceiveBatch& operator=(const ReceiveBatch&) = delete;

  [[nodiscard]] bool empty() const { return next_ == count_; }
  /// Returns the next frame of the batch, which must not be empty. The frame is valid until fetch().
  Item take();
  /// Reads all waiting frames, up to the capacity. False: no frame was read; errno has the reason. `flags`
  /// are those of recvmmsg(): with MSG_DONTWAIT, fetch() does not wait; with MSG_WAITFORONE, it waits for the
  /// first frame, at most for the time SO_RCVTIMEO of the socket.
  bool fetch(int socket, int flags);
  /// True if the last fetch() read all frames that were waiting.
  [[nodiscard]] bool took_all() const { return count_ < capacity; }

 private:
  // Large enough for the control messages that read_ancillary() reads.
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
