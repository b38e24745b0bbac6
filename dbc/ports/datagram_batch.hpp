// The datagrams that one system call reads from a socket of the embedded bus.
#pragma once

#include <sys/socket.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "dbc/ports/local_wire.hpp"

namespace canhil::local {

/// Reads messages and gives out their datagrams one by one.
class DatagramBatch {
 public:
  static constexpr std::size_t capacity = 16;  ///< of messages; each has up to most_together datagrams

  /// A datagram and its length on the socket. If it is no datagram, decode() refuses it. 0 bytes: the other
  /// end has closed the connection.
  struct Item {
    const Datagram& datagram;
    std::size_t bytes;
  };

  /// How many datagrams a message may have; see Hello::together.
  enum class Messages : std::uint8_t { of_one, together };

  /// For messages of this kind.
  explicit DatagramBatch(Messages messages);
  DatagramBatch(const DatagramBatch&) = delete;
  DatagramBatch& operator=(const DatagramBatch&) = delete;

  /// Whether every datagram that was read has been taken.
  [[nodiscard]] bool empty() const { return next_ == count_; }
  /// Returns the next datagram of the batch, which must not be empty. It is valid until the next call.
  Item take();
  /// Reads the waiting messages, up to the capacity. False: nothing was read; errno has the reason. `flags`
  /// are MSG_DONTWAIT or MSG_WAITFORONE of recvmmsg().
  bool fetch(int socket, int flags);
  /// True if the last fetch() read all messages that were waiting.
  [[nodiscard]] bool took_all() const { return count_ < capacity; }

 private:
  Messages may_have_;
  std::array<Together, capacity> contents_;
  std::array<iovec, capacity> parts_{};
  std::array<mmsghdr, capacity> messages_{};
  std::size_t count_ = 0;
  std::size_t next_ = 0;    // message
  std::size_t offset_ = 0;  // of the next datagram in this message
  Datagram taken_;
};

}  // namespace canhil::local
