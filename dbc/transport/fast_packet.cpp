#include "dbc/transport/fast_packet.hpp"

#include <algorithm>

namespace canhil::transport {
namespace {

constexpr unsigned frame_bits = 5, frame_mask = (1U << frame_bits) - 1, sequences = 8;
constexpr std::uint8_t unused = 0xFF;

}  // namespace

std::vector<FastPacketFrame> split_fast_packet(std::span<const std::uint8_t> message, unsigned sequence) {
  std::vector<FastPacketFrame> frames(fast_packet_frames(message.size()));
  std::size_t done = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    FastPacketFrame& frame = frames[i];
    frame.fill(unused);
    frame[0] = static_cast<std::uint8_t>((sequence % sequences) << frame_bits | i);
    std::size_t at = 1;
    if (i == 0) frame[at++] = static_cast<std::uint8_t>(message.size());
    while (at < frame.size() && done < message.size()) frame[at++] = message[done++];
  }
  return frames;
}

// The frames that are left of a lost message do not count again.
void FastPacketReceiver::lose(unsigned sequence) {
  if (!losing_ || sequence != sequence_) ++lost_;
  losing_ = true;
  sequence_ = sequence;
  next_ = 0;
}

std::optional<std::span<const std::uint8_t>> FastPacketReceiver::take(std::span<const std::uint8_t> frame) {
  if (frame.size() < 2) return std::nullopt;
  const unsigned sequence = frame[0] >> frame_bits, number = frame[0] & frame_mask;
  if (number == 0) {
    if (next_ != 0) lose(sequence_);  // the message before is not complete
    losing_ = false;
    message_.clear();
    size_ = frame[1];
    sequence_ = sequence;
    if (size_ < fewest_fast_packet_bytes || size_ > most_fast_packet_bytes) {
      lose(sequence);
      return std::nullopt;
    }
  } else if (next_ == 0 || number != next_ || sequence != sequence_) {
    if (next_ != 0 && sequence != sequence_) lose(sequence_);  // the open message, beside this one
    lose(sequence);
    return std::nullopt;
  }
  const auto content = frame.subspan(number == 0 ? 2 : 1);
  const std::size_t missing = size_ - message_.size();
  const auto used = content.first(std::min(missing, content.size()));
  message_.insert(message_.end(), used.begin(), used.end());
  next_ = number + 1;
  if (message_.size() < size_) return std::nullopt;
  next_ = 0;
  losing_ = false;
  return message_;
}

}  // namespace canhil::transport
