// Defines which frame carries each message. On classic CAN, each message has its own frame. On CAN FD, a
// message is in the container of its sample group; a message without a container has its own frame.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "dbc/wire/bit_length.hpp"
#include "messages/canhil.hpp"
#include "messages/canhil_fd.hpp"

namespace canhil::wire {

/// A frame on the wire.
struct Carrier {
  std::size_t first = 0;    ///< index of the first message in the frame; its id is the id of the frame
  std::string_view name{};  ///< name of the frame in the contract of the bus
  BitLength longest{};
};

/// The carrier of each message. The index is that of the message in all_messages.
using Carriers = std::array<Carrier, messages::all_messages.size()>;

/// The carriers on classic CAN: each message has its own frame.
inline constexpr Carriers classic_carriers = [] {
  Carriers carriers{};
  for (std::size_t i = 0; i < carriers.size(); ++i) {
    const MessageInfo& info = messages::all_messages[i];
    carriers[i] = {.first = i, .name = info.name, .longest = worst_case_length(info.size, info.extended)};
  }
  return carriers;
}();

/// The carriers on CAN FD: the containers of the sample groups. Each message without a container has its own
/// frame.
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

/// The carriers of the messages of a bus. For the project's contract, these are fd_carriers or
/// classic_carriers. Each message of another DBC has its own frame.
inline std::vector<Carrier> carriers_of(std::span<const MessageInfo> messages, bool fd) {
  if (messages.data() == messages::all_messages.data()) {
    const Carriers& own = fd ? fd_carriers : classic_carriers;
    return {own.begin(), own.end()};
  }
  std::vector<Carrier> carriers;
  for (const MessageInfo& info : messages) {
    carriers.push_back({.first = carriers.size(),
                        .name = info.name,
                        .longest = info.fd ? worst_case_fd_length(info.size, info.extended, true)
                                           : worst_case_length(info.size, info.extended)});
  }
  return carriers;
}

}  // namespace canhil::wire
