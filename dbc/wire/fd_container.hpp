// Containers of the FD contract: the classic messages of a sample group in one CAN FD frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace canhil::wire {

/// Describes a container: it has `count` classic frames of 8 bytes, in the order of transmission. dbcgen
/// generates these descriptions.
struct FdContainer {
  static constexpr std::size_t max_slots = 8;
  static constexpr std::size_t slot_bytes = 8;

  std::string_view name{};  ///< name of the container's message in the FD contract
  std::uint16_t id = 0;     ///< id of the container, which is the id of its first slot
  std::uint8_t size = 0;
  std::uint8_t count = 0;
  std::array<std::uint16_t, max_slots> slots{};  ///< the ids of the classic frames
};

/// The place of a classic message on CAN FD: the container that carries the message, and the slot in this
/// container.
struct FdPlace {
  static constexpr std::uint8_t nowhere = 0xFF;
  std::uint8_t container = nowhere;  ///< index of the container; nowhere: the message is in no container
  std::uint8_t slot = 0;
};

/// The place of every standard id. The index is the id.
constexpr std::array<FdPlace, 2048> fd_places(std::span<const FdContainer> containers) {
  std::array<FdPlace, 2048> places{};
  for (std::size_t c = 0; c < containers.size(); ++c) {
    for (std::uint8_t slot = 0; slot < containers[c].count; ++slot)
      places[containers[c].slots[slot]] = {static_cast<std::uint8_t>(c), slot};
  }
  return places;
}

}  // namespace canhil::wire
