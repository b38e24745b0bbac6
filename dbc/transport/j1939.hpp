// The transport protocol of SAE J1939-21: a message of 9 to 1785 bytes in up to 255 frames of 7 bytes.
//
// A frame of connection management (PGN 60416) announces the message: to all nodes (BAM), or as a request to
// one node (RTS), which answers with the packets that it wants next (CTS). It has the number of bytes and
// packets in bytes 1 to 3 and the PGN of the message in bytes 5 to 7. The frames of data transfer (PGN 60160)
// have the number of the packet, from 1 on, in byte 0. Bytes of the last frame that are not used are 0xFF.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "dbc/wire/frame.hpp"

namespace canhil::transport {

inline constexpr std::size_t fewest_j1939_bytes = 9, most_j1939_bytes = 1785;

/// The number of packets of a message of 9 to 1785 bytes.
constexpr std::size_t j1939_packets(std::size_t bytes) { return (bytes + 6) / 7; }

/// Splits a message of 9 to 1785 bytes for all nodes (BAM): into the announcement and the packets. SAE
/// J1939-21 has 50 to 200 ms from one to the next. `id`: the 29-bit id of the message, of which the frames
/// have the source address, and the announcement the PGN.
std::vector<Frame> split_j1939(std::span<const std::uint8_t> message, std::uint32_t id);

/// Puts the messages of a bus together. It only listens: nothing is requested or acknowledged.
class J1939Receiver {
 public:
  J1939Receiver() = default;
  /// Takes only the messages of this parameter group, and counts only them.
  explicit J1939Receiver(std::uint32_t group) : only_(group) {}

  /// Whether a frame is one of the transport protocol.
  static bool carries(const Frame& frame);

  /// A message. Its id consists of the priority and the source of its frames, its PGN, and, in PDU1, the
  /// destination of its frames.
  struct Message {
    std::uint32_t id = 0;
    std::span<const std::uint8_t> bytes{};
  };
  /// Takes a frame of the transport protocol. Returns the message that it completes; none: no message is
  /// complete. The result is valid until the next call.
  std::optional<Message> take(const Frame& frame);
  /// The number of messages that began but were not completed, or of which the announcement did not come.
  [[nodiscard]] std::uint64_t lost() const { return lost_; }
  /// The number of messages that have begun and are not complete yet.
  [[nodiscard]] std::uint64_t open() const;

 private:
  // The message that one node sends to another one or to all.
  struct Session {
    std::uint32_t group = 0;
    std::size_t size = 0;
    std::vector<std::uint8_t> bytes{};
    unsigned last = 0;    // number of the packet before; 0: there was none
    unsigned next = 0;    // number of the next packet; 0: no message is open
    bool losing = false;  // packets of a message that counts as lost are still coming
  };
  // Key: source, destination (255: all).
  using Nodes = std::pair<std::uint8_t, std::uint8_t>;

  void manage(const Frame& frame, Nodes nodes);
  void lose(Session& session);

  std::optional<std::uint32_t> only_;
  std::map<Nodes, Session> sessions_;
  std::uint64_t lost_ = 0;
};

}  // namespace canhil::transport
