// Decodes packets of SocketCAN captures.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "dbc/wire/frame.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::logs {

/// The frame in a packet; nullopt: it is a remote frame. The error states what is wrong with the packet.
Result<std::optional<Frame>> frame_of_packet(std::span<const std::uint8_t> packet);

}  // namespace canhil::logs
