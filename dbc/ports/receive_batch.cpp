#include "dbc/ports/receive_batch.hpp"

namespace canhil {

ReceiveBatch::ReceiveBatch() {
  for (std::size_t i = 0; i < capacity; ++i) {
    parts_[i] = {.iov_base = &frames_[i], .iov_len = sizeof frames_[i]};
    msghdr& message = messages_[i].msg_hdr;
    message.msg_iov = &parts_[i];
    message.msg_iovlen = 1;
    message.msg_control = controls_[i].bytes.data();
    message.msg_controllen = control_bytes;
  }
}

ReceiveBatch::Item ReceiveBatch::take() {
  mmsghdr& message = messages_[next_];
  return {.frame = frames_[next_++],
          .fd = message.msg_len == CANFD_MTU,
          .own = (message.msg_hdr.msg_flags & MSG_CONFIRM) != 0,
          .ancillary = read_ancillary(message.msg_hdr)};
}

bool ReceiveBatch::fetch(int socket, int flags) {
  for (std::size_t i = 0; i < count_; ++i) messages_[i].msg_hdr.msg_controllen = control_bytes;
  const int count = ::recvmmsg(socket, messages_.data(), capacity, flags, nullptr);
  next_ = 0;
  count_ = count > 0 ? static_cast<std::size_t>(count) : 0;
  return count > 0;
}

}  // namespace canhil
