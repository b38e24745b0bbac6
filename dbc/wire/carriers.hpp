// What each message travels in on a bus: itself on classic CAN; on CAN FD the container of its group, or a
// frame of its own.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "dbc/wire/bit_length.hpp"
#include "messages/canhil.hpp"
#include "messages/canhil_fd.hpp"

namespace canhil::wire {

/// A frame on the wire.
struct Carrier {
  std::size_t first = 0;    ///< place in all_messages of the first message in it, whose id it has
  std::string_view name{};  ///< in the bus's contract
  BitLength longest{};
};

/// By place in all_messages.
using Carriers = std::array<Carrier, messages::all_messages.size()>;

inline constexpr Carriers classic_carriers = [] {
  Carriers carriers{};
  for (std::size_t i = 0; i < carriers.size(); ++i) {
    const MessageInfo& info = messages::all_messages[i];
    carriers[i] = {.first = i, .name = info.name, .longest = worst_case_length(info.size, info.extended)};
  }
  return carriers;
}();

inline constexpr Carriers fd_carriers = [] {
  Carriers carriers = classic_carriers;
  for (std::size_t i = 0; i < carriers.size(); ++i) {
    const MessageInfo& info = messages::all_messages[i];
    carriers[i].longest = worst_case_fd_length(info.size, info.extended, true);
    if (info.extended || messages_fd::places[info.id].container == FdPlace::nowhere) continue;
    const FdContainer& container = messages_fd::containers[messages_fd::places[info.id].container];
    const auto first = std::ranges::find(messages::all_messages, container.id, &MessageInfo::id);
    carriers[i] = {.first = static_cast<std::size_t>(first - messages::all_messages.begin()),
                   .name = container.name,
                   .longest = worst_case_fd_length(container.size, false, true)};
  }
  return carriers;
}();

constexpr const Carriers& carriers(bool fd) { return fd ? fd_carriers : classic_carriers; }

}  // namespace canhil::wire
