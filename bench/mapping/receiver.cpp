#include "bench/mapping/receiver.hpp"

#include <algorithm>

namespace canhil::mapping {

Receiver::Taken Receiver::take(const Mapped& of, const Frame& frame) {
  if (frame.size != of.frame_size() || frame.fd != of.message->fd)
    return {.outcome = Outcome::wrong_size, .size = frame.size};
  if (of.message->j1939_transport()) return part_of_j1939(of, frame);
  if (of.message->fast_packet) return put_together(of, frame);
  Taken taken{.outcome = Outcome::whole, .bytes = frame.payload()};
  if (!of.protection) return taken;
  switch (protection_.check(*of.protection, frame.payload())) {
    case protection::Check::wrong_checksum:
      taken.outcome = Outcome::wrong_checksum;
      break;
    case protection::Check::counter_not_allowed:
      taken.outcome = Outcome::wrong_counter;
      break;
    case protection::Check::repeated:
      taken.outcome = Outcome::repeated;
      break;
    case protection::Check::some_lost:
      taken.lost = protection_.lost();
      break;
    case protection::Check::ok:
      break;
  }
  return taken;
}

Receiver::Taken Receiver::put_together(const Mapped& of, const Frame& frame) {
  transport::FastPacketReceiver& receiver = fast_packets_[frame.id];
  const std::uint64_t lost_before = receiver.lost();
  const auto message = receiver.take(frame.payload());
  Taken taken{.lost = receiver.lost() - lost_before};
  if (!message) return taken;
  taken.outcome = message->size() == of.message->size ? Outcome::whole : Outcome::wrong_size;
  taken.bytes = *message;
  taken.size = static_cast<std::uint8_t>(message->size());
  return taken;
}

Receiver::Taken Receiver::part_of_j1939(const Mapped& of, const Frame& frame) {
  if (!transport::J1939Receiver::carries(frame)) return {.outcome = Outcome::wrong_size, .size = frame.size};
  if (!j1939_) j1939_.emplace(wire::j1939_group(of.message->id));
  const std::uint64_t lost_before = j1939_->lost();
  const auto message = j1939_->take(frame);
  Taken taken{.lost = j1939_->lost() - lost_before};
  if (!message) return taken;
  taken.outcome = message->bytes.size() == of.message->size ? Outcome::whole : Outcome::wrong_size;
  taken.bytes = message->bytes;
  taken.size = static_cast<std::uint8_t>(std::min<std::size_t>(message->bytes.size(), 255));
  return taken;
}

}  // namespace canhil::mapping
