// A reproducible stream of frames with random ids and sizes, and a digest of the order in which a process
// received frames.
#pragma once

#include <array>
#include <cstdint>

#include "dbc/ports/port.hpp"

namespace canhil {

/// The hash function splitmix64 (Steele, Lea, Flood 2014).
inline std::uint64_t scramble(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15U;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31U);
}

/// Frame n of a sender: a CAN FD frame. Its size and all its bytes depend on `sender` and `n`.
inline Frame streamed(std::uint64_t sender, std::uint64_t n) {
  constexpr std::array<std::uint8_t, 16> sizes{0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};
  std::uint64_t random = scramble(sender << 32U | n);
  Frame frame;
  frame.fd = true;
  frame.brs = (random & 1) != 0;
  frame.extended = (random & 2) != 0;
  frame.id = static_cast<std::uint32_t>(random >> 8U) & (frame.extended ? 0x1FFF'FFFF : 0x7FF);
  frame.size = sizes[random >> 60U];
  for (std::uint8_t i = 0; i < frame.size; ++i) {
    if (i % 8 == 0) random = scramble(random);
    frame.data[i] = static_cast<std::uint8_t>(random >> (8U * (i % 8U)));
  }
  return frame;
}

/// A digest of frames, their stamps and their order.
class Order {
 public:
  void add(const Received& received) {
    const Frame& frame = received.frame;
    sum_ = scramble(sum_ ^ frame.id ^ std::uint64_t{frame.size} << 32U ^
                    static_cast<std::uint64_t>(received.t_ns));
    for (const std::uint8_t byte : frame.payload()) sum_ = scramble(sum_ ^ byte);
  }
  [[nodiscard]] std::uint64_t sum() const { return sum_; }

 private:
  std::uint64_t sum_ = 0;
};

}  // namespace canhil
