#include "dbc/transport/j1939.hpp"

#include <algorithm>
#include <utility>

#include "dbc/wire/j1939.hpp"

namespace canhil::transport {
namespace {

// Numbers of parameter groups.
constexpr std::uint32_t connection_management = 60'416, data_transfer = 60'160;
// Byte 0 of a frame of connection management.
constexpr std::uint8_t request_to_send = 16, clear_to_send = 17, broadcast = 32, aborted = 255;

constexpr std::size_t bytes_of_packet = 7;
constexpr std::uint8_t all_nodes = 255, filling = 0xFF;
constexpr std::uint32_t lowest_priority = 7;

std::uint32_t id_of(std::uint32_t priority, std::uint32_t group, std::uint8_t destination,
                    std::uint8_t source) {
  const bool to_one = wire::j1939_destination(group << 8U).has_value();
  return priority << 26U | group << 8U | (to_one ? std::uint32_t{destination} << 8U : 0U) | source;
}

Frame frame_of(std::uint32_t group, std::uint8_t source) {
  Frame frame{.id = id_of(lowest_priority, group, all_nodes, source), .size = 8, .extended = true};
  std::fill_n(frame.data.begin(), frame.size, filling);
  return frame;
}

}  // namespace

std::vector<Frame> split_j1939(std::span<const std::uint8_t> message, std::uint32_t id) {
  const std::uint8_t source = wire::j1939_source(id);
  const std::uint32_t group = wire::j1939_group(id);
  std::vector<Frame> frames{frame_of(connection_management, source)};
  auto& announcement = frames.front().data;
  announcement[0] = broadcast;
  announcement[1] = static_cast<std::uint8_t>(message.size() & 0xFFU);
  announcement[2] = static_cast<std::uint8_t>(message.size() >> 8U);
  announcement[3] = static_cast<std::uint8_t>(j1939_packets(message.size()));
  for (unsigned i = 0; i < 3; ++i) announcement[5 + i] = static_cast<std::uint8_t>(group >> 8U * i & 0xFFU);
  for (std::uint8_t number = 1; !message.empty(); ++number) {
    Frame& packet = frames.emplace_back(frame_of(data_transfer, source));
    packet.data[0] = number;
    const auto some = message.first(std::min(message.size(), bytes_of_packet));
    std::ranges::copy(some, packet.data.begin() + 1);
    message = message.subspan(some.size());
  }
  return frames;
}

bool J1939Receiver::carries(const Frame& frame) {
  if (!frame.extended || frame.error || frame.fd) return false;
  const std::uint32_t group = wire::j1939_group(frame.id);
  return group == connection_management || group == data_transfer;
}

std::uint64_t J1939Receiver::open() const {
  return static_cast<std::uint64_t>(
      std::ranges::count_if(sessions_, [](const auto& one) { return one.second.next != 0; }));
}

// The packets that are left of a lost message do not count again.
void J1939Receiver::lose(Session& session) {
  if (!session.losing) ++lost_;
  session.losing = true;
  session.next = 0;
}

void J1939Receiver::manage(const Frame& frame, Nodes nodes) {
  const auto& data = frame.data;
  const std::uint8_t control = data[0];
  const std::uint32_t group = data[5] | std::uint32_t{data[6]} << 8U | (data[7] & 3U) << 16U;
  if (control == request_to_send || control == broadcast) {
    Session& session = sessions_[nodes];
    const bool again = control == request_to_send && session.next == 1 && session.group == group;
    if (session.next != 0 && !again) lose(session);  // the message before is not complete
    const std::size_t size = data[1] | std::size_t{data[2]} << 8U;
    session = {.group = group, .size = size, .next = 1};
    if (only_ && group != *only_) {
      session.next = 0;
      return;
    }
    if (size < fewest_j1939_bytes || size > most_j1939_bytes || data[3] != j1939_packets(size)) lose(session);
    return;
  }
  if (control != clear_to_send && control != aborted) return;
  // The receiver answers; either node may abort.
  for (const Nodes& of : {nodes, Nodes(nodes.second, nodes.first)}) {
    const auto found = sessions_.find(of);
    if (found == sessions_.end() || found->second.next == 0 || found->second.group != group) continue;
    Session& session = found->second;
    const unsigned wanted = data[2];
    if (control == aborted || (data[1] > 0 && wanted > session.next)) {
      lose(session);
    } else if (data[1] > 0 && wanted > 0) {  // else the receiver is busy
      session.next = wanted;
      session.bytes.resize((wanted - 1) * bytes_of_packet);
    }
  }
}

std::optional<J1939Receiver::Message> J1939Receiver::take(const Frame& frame) {
  if (frame.size != 8) return std::nullopt;
  const Nodes nodes(wire::j1939_source(frame.id), wire::j1939_destination(frame.id).value_or(all_nodes));
  if (wire::j1939_group(frame.id) == connection_management) {
    manage(frame, nodes);
    return std::nullopt;
  }
  Session& session = sessions_[nodes];
  const unsigned number = frame.data[0], last = std::exchange(session.last, number);
  if (session.next == 0 && only_) return std::nullopt;  // perhaps a packet of another group
  if (session.next == 0 || number != session.next) {
    if (number <= last) session.losing = false;  // a further message, of which the announcement did not come
    lose(session);
    return std::nullopt;
  }
  const std::size_t missing = session.size - session.bytes.size();
  const auto used = frame.payload().subspan(1, std::min(missing, bytes_of_packet));
  session.bytes.insert(session.bytes.end(), used.begin(), used.end());
  ++session.next;
  if (session.bytes.size() < session.size) return std::nullopt;
  session.next = 0;
  constexpr unsigned priority_shift = 26;
  return Message{.id = id_of(frame.id >> priority_shift, session.group, nodes.second, nodes.first),
                 .bytes = session.bytes};
}

}  // namespace canhil::transport
