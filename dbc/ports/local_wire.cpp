#include "dbc/ports/local_wire.hpp"

#include <fmt/format.h>
#include <sys/socket.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstring>

#include "dbc/ports/local_bus.hpp"
#include "dbc/wire/frame_rules.hpp"

namespace canhil {

std::string named_local(std::string bus, std::string_view name) {
  const bool nameless = bus == local_prefix || (is_local(bus) && bus[local_prefix.size()] == '?');
  if (nameless) bus.insert(local_prefix.size(), name);
  return bus;
}

}  // namespace canhil

namespace canhil::local {
void encode(const Frame& frame, Datagram& datagram) {
  datagram.id = frame.id;
  datagram.size = frame.size;
  datagram.flags =
      static_cast<std::uint8_t>((frame.extended ? Datagram::extended : 0) | (frame.fd ? Datagram::fd : 0) |
                                (frame.brs ? Datagram::brs : 0) | (frame.error ? Datagram::error : 0) |
                                (frame.esi ? Datagram::esi : 0));
  datagram.unused = 0;
  datagram.t_ns = 0;
  std::memcpy(datagram.data.data(), frame.data.data(), frame.size);
}

std::size_t send_together(int socket, std::span<const Frame> frames, bool fd_bus, std::int64_t t_ns) {
  Together message;
  std::size_t sent = 0;
  for (;;) {
    std::size_t count = 0, begin = 0, end = 0;
    for (; count < most_together && sent + count < frames.size(); ++count) {
      const Frame& frame = frames[sent + count];
      if (!can_carry(frame, fd_bus)) break;
      Datagram datagram;
      encode(frame, datagram);
      datagram.t_ns = t_ns;
      std::memcpy(message.data() + begin, &datagram, datagram.bytes());
      end = begin + datagram.bytes();
      begin += stride(datagram);
    }
    if (count == 0 || ::send(socket, message.data(), end, MSG_NOSIGNAL | MSG_DONTWAIT) < 0) return sent;
    sent += count;
  }
}

std::size_t send_frames(int socket, std::span<const Frame> frames, bool fd_bus, std::int64_t t_ns) {
  std::array<Datagram, most_together> datagrams;
  std::array<iovec, most_together> parts{};
  std::array<mmsghdr, most_together> messages{};
  std::size_t sent = 0;
  for (;;) {
    unsigned count = 0;
    for (; count < most_together && sent + count < frames.size(); ++count) {
      const Frame& frame = frames[sent + count];
      if (!can_carry(frame, fd_bus)) break;
      encode(frame, datagrams[count]);
      datagrams[count].t_ns = t_ns;
      parts[count] = {.iov_base = &datagrams[count], .iov_len = datagrams[count].bytes()};
      messages[count].msg_hdr.msg_iov = &parts[count];
      messages[count].msg_hdr.msg_iovlen = 1;
    }
    if (count == 0) return sent;
    const int taken = ::sendmmsg(socket, messages.data(), count, MSG_NOSIGNAL | MSG_DONTWAIT);
    sent += static_cast<std::size_t>(std::max(taken, 0));
    if (taken < static_cast<int>(count)) return sent;
  }
}

bool decode(const Datagram& datagram, std::size_t received, bool fd_bus, Frame& frame) {
  if (received < offsetof(Datagram, data) || received != datagram.bytes()) return false;
  if (datagram.size > Frame::max_size) return false;
  frame.id = datagram.id;
  frame.size = datagram.size;
  frame.extended = (datagram.flags & Datagram::extended) != 0;
  frame.fd = (datagram.flags & Datagram::fd) != 0;
  frame.brs = (datagram.flags & Datagram::brs) != 0;
  frame.esi = (datagram.flags & Datagram::esi) != 0;
  frame.error = (datagram.flags & Datagram::error) != 0;
  std::memcpy(frame.data.data(), datagram.data.data(), frame.size);
  return can_carry(frame, fd_bus);
}

Result<IdSet> id_set(const std::vector<std::uint32_t>& ids) {
  IdSet set;
  for (const std::uint32_t id : ids) {
    if (id > max_standard_id)
      return failure(fmt::format("only_ids: 0x{:X} is not a standard id (0 to 0x7FF)", id));
    set.set(id);
  }
  return set;
}

Result<BusName> bus_name(std::string_view bus) {
  const std::string_view rest = is_local(bus) ? bus.substr(local_prefix.size()) : std::string_view{};
  BusName result{.name = std::string(rest.substr(0, rest.find('?')))};
  const auto allowed = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
  };
  if (result.name.empty() || result.name.size() > 64 || !std::ranges::all_of(result.name, allowed)) {
    return failure(
        fmt::format("'{}': expected local:NAME, NAME of 1 to 64 letters, digits, '_' or '-'", bus));
  }
  auto wire = wire_settings(bus);
  if (!wire) return tl::unexpected(wire.error());
  result.wire = *wire;
  return result;
}

}  // namespace canhil::local
