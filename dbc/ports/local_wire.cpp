#include "dbc/ports/local_wire.hpp"

#include <fmt/format.h>
#include <sys/socket.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstring>

#include "dbc/ports/frame_rules.hpp"

namespace canhil::local {
namespace {

/// What stands before the mark, or all; it and the mark are taken off the text.
std::string_view cut(std::string_view& text, char mark) {
  const std::size_t at = std::min(text.find(mark), text.size());
  const std::string_view head = text.substr(0, at);
  text.remove_prefix(std::min(at + 1, text.size()));
  return head;
}

bool read_rate(std::string_view digits, std::int64_t highest, std::int64_t& rate) {
  const char* end = digits.data() + digits.size();
  const auto read = std::from_chars(digits.data(), end, rate);
  return read.ec == std::errc{} && read.ptr == end && rate >= 1'000 && rate <= highest;
}

/// Takes `key=value` over; false: it is no such thing.
bool read_setting(std::string_view setting, BusName& into) {
  const std::string_view key = cut(setting, '=');
  if (key == "bitrate") return read_rate(setting, 1'000'000, into.rates.nominal);
  if (key == "data-bitrate") return read_rate(setting, 20'000'000, into.rates.data);
  into.order = setting == "priority" ? QueueOrder::priority : QueueOrder::fifo;
  return key == "queue" && (setting == "priority" || setting == "fifo");
}

}  // namespace

void encode(const Frame& frame, Datagram& datagram) {
  datagram.id = frame.id;
  datagram.size = frame.size;
  datagram.flags =
      static_cast<std::uint8_t>((frame.extended ? Datagram::extended : 0) | (frame.fd ? Datagram::fd : 0) |
                                (frame.brs ? Datagram::brs : 0) | (frame.error ? Datagram::error : 0));
  datagram.unused = 0;
  datagram.t_ns = 0;
  std::memcpy(datagram.data.data(), frame.data.data(), frame.size);
}

bool decode(const Datagram& datagram, std::size_t received, bool fd_bus, Frame& frame) {
  if (received < offsetof(Datagram, data) || received != datagram.bytes()) return false;
  if (datagram.size > Frame::max_size) return false;
  frame.id = datagram.id;
  frame.size = datagram.size;
  frame.extended = (datagram.flags & Datagram::extended) != 0;
  frame.fd = (datagram.flags & Datagram::fd) != 0;
  frame.brs = (datagram.flags & Datagram::brs) != 0;
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
  constexpr std::string_view prefix = "local:";
  std::string_view rest = bus.starts_with(prefix) ? bus.substr(prefix.size()) : std::string_view{};
  BusName result{.name = std::string(cut(rest, '?'))};
  const auto allowed = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
  };
  if (result.name.empty() || result.name.size() > 64 || !std::ranges::all_of(result.name, allowed)) {
    return failure(
        fmt::format("'{}': expected local:NAME, NAME of 1 to 64 letters, digits, '_' or '-'", bus));
  }
  while (!rest.empty()) {
    const std::string_view setting = cut(rest, '&');
    if (!read_setting(setting, result)) {
      return failure(
          fmt::format("'{}': '{}' is not understood, expected bitrate=1000..1000000, "
                      "data-bitrate=1000..20000000 or queue=fifo|priority",
                      bus, setting));
    }
  }
  if (result.rates.nominal == 0 && bus.find('?') != std::string_view::npos)
    return failure(fmt::format("'{}': expected bitrate=1000..1000000 after '?'", bus));
  return result;
}

Address address(std::string_view name, Place place) {
  constexpr std::array<std::string_view, 3> suffix{"", "/classic", "/fd"};
  const std::string text = fmt::format("canhil/{}{}", name, suffix.at(static_cast<std::size_t>(place)));
  Address result;
  result.socket.sun_family = AF_UNIX;
  // A leading 0 byte: the abstract namespace, where a name ends with the socket, however its process ended.
  std::memcpy(result.socket.sun_path + 1, text.data(), text.size());
  result.length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + text.size());
  return result;
}

}  // namespace canhil::local
