#include "dbc/ports/datagram_batch.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace canhil::local {

DatagramBatch::DatagramBatch(Messages messages) : may_have_(messages) {
  for (std::size_t i = 0; i < capacity; ++i) {
    parts_[i] = {.iov_base = contents_[i].data(), .iov_len = contents_[i].size()};
    messages_[i].msg_hdr.msg_iov = &parts_[i];
    messages_[i].msg_hdr.msg_iovlen = 1;
  }
}

DatagramBatch::Item DatagramBatch::take() {
  const std::size_t left = messages_[next_].msg_len - offset_;
  std::memcpy(&taken_, contents_[next_].data() + offset_, std::min(left, sizeof taken_));
  const bool last = may_have_ == Messages::of_one || left <= stride(taken_);
  offset_ = last ? 0 : offset_ + stride(taken_);
  if (last) ++next_;
  return {.datagram = taken_, .bytes = last ? left : taken_.bytes()};
}

bool DatagramBatch::fetch(int socket, int flags) {
  int count = 0;
  do {
    // If the other end closes the connection before it has read all frames of this end, the call fails once
    // with ECONNRESET. The next calls return the frames that the other end had sent before.
    count = ::recvmmsg(socket, messages_.data(), capacity, flags | MSG_TRUNC, nullptr);
  } while (count < 0 && errno == ECONNRESET);
  next_ = offset_ = 0;
  count_ = count > 0 ? static_cast<std::size_t>(count) : 0;
  return count > 0;
}

}  // namespace canhil::local
