// Receives a message: checks its frames, and puts them together if the message has several.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>

#include "bench/mapping/mapping.hpp"
#include "dbc/protection/protection.hpp"
#include "dbc/transport/fast_packet.hpp"
#include "dbc/transport/j1939.hpp"

namespace canhil::mapping {

class Receiver {
 public:
  enum class Outcome : std::uint8_t { whole, part, wrong_size, wrong_checksum, wrong_counter, repeated };
  struct Taken {
    Outcome outcome = Outcome::part;
    std::span<const std::uint8_t> bytes{};  ///< of the whole message; valid until the next call
    std::uint8_t size = 0;                  ///< if it is wrong: of the frame, or of the message
    std::uint64_t lost = 0;                 ///< number of messages before this one that are missing
  };

  /// Takes a frame with the id of the message, or one of the transport protocol of J1939 that may be a part
  /// of the message.
  Taken take(const Mapped& of, const Frame& frame);

 private:
  Taken put_together(const Mapped& of, const Frame& frame);
  Taken part_of_j1939(const Mapped& of, const Frame& frame);

  protection::Receiver protection_;
  std::map<std::uint32_t, transport::FastPacketReceiver> fast_packets_;  // by id: several sources may send
  std::optional<transport::J1939Receiver> j1939_;                        // of the message's parameter group
};

}  // namespace canhil::mapping
