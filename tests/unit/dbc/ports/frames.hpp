// Functions that make frames and wait for frames, for the tests of ports.
#pragma once

#include <gtest/gtest.h>

#include <ctime>
#include <initializer_list>
#include <optional>

#include "dbc/ports/port.hpp"

namespace canhil {

inline Frame frame_of(std::uint32_t id, std::initializer_list<std::uint8_t> data = {}) {
  Frame frame;
  frame.id = id;
  frame.size = static_cast<std::uint8_t>(data.size());
  std::copy(data.begin(), data.end(), frame.data.begin());
  return frame;
}

/// A frame whose data is a number.
inline Frame numbered(std::uint32_t id, std::uint32_t number) {
  return frame_of(id, {static_cast<std::uint8_t>(number), static_cast<std::uint8_t>(number >> 8U),
                       static_cast<std::uint8_t>(number >> 16U), static_cast<std::uint8_t>(number >> 24U)});
}
inline std::uint32_t number_of(const Frame& frame) {
  return static_cast<std::uint32_t>(frame.data[0]) | static_cast<std::uint32_t>(frame.data[1]) << 8U |
         static_cast<std::uint32_t>(frame.data[2]) << 16U | static_cast<std::uint32_t>(frame.data[3]) << 24U;
}

inline std::int64_t in_seconds(int seconds) { return clock_ns(CLOCK_MONOTONIC) + seconds * 1'000'000'000LL; }

/// The next frame; none if no frame arrives within 5 s or the port closes.
inline std::optional<Received> next_frame(Port& port) {
  const std::int64_t deadline = in_seconds(5);
  while (!port.closed()) {
    if (auto received = port.receive()) return received;
    if (clock_ns(CLOCK_MONOTONIC) >= deadline) return std::nullopt;
    wait(port, WaitFor::frame, deadline);
  }
  return std::nullopt;
}

}  // namespace canhil
