// The objects of a BLF file that contain frames.
#include <algorithm>

#include "dbc/logs/blf.hpp"
#include "dbc/logs/little_endian.hpp"
#include "dbc/wire/frame_rules.hpp"

namespace canhil::logs::blf {
namespace {

using Body = std::span<const std::uint8_t>;

Result<Parsed> cut() { return failure("an object with all of its fields"); }

bool read_id(std::uint32_t id, Frame& frame) {
  frame.extended = (id & extended_id) != 0;
  frame.id = id & ~extended_id;
  return frame.id <= (frame.extended ? max_extended_id : max_standard_id);
}

Result<Parsed> checked(LogEntry entry, Body data) {
  Frame& frame = entry.frame;
  if (!can_carry(frame, true)) return failure("the id and the size of a frame of CAN or CAN FD");
  if (!entry.remote) {
    if (data.size() < frame.size) return cut();
    std::copy_n(data.begin(), frame.size, frame.data.begin());
  }
  return Parsed{.entry = std::move(entry)};
}

// CAN_MESSAGE and CAN_MESSAGE2: channel u16, flags u8, length code u8, id u32, data 8 bytes
Result<Parsed> classic(Body body) {
  if (body.size() < 16) return cut();
  LogEntry entry;
  if (!read_id(little_endian<std::uint32_t>(body, 4), entry.frame)) return failure("an id");
  entry.transmitted = (body[2] & message_sent) != 0;
  entry.remote = (body[2] & message_remote) != 0;
  entry.frame.size = std::min<std::uint8_t>(body[3], 8);
  return checked(std::move(entry), body.subspan(8, 8));
}

// CAN_FD_MESSAGE: channel u16, flags u8, length code u8, id u32, duration u32, arbitration bits u8, FD flags
// u8, number of data bytes u8, 5 bytes, data 64 bytes
Result<Parsed> fd(Body body) {
  constexpr std::size_t offset_data = 20;
  if (body.size() < offset_data) return cut();
  LogEntry entry;
  Frame& frame = entry.frame;
  if (!read_id(little_endian<std::uint32_t>(body, 4), frame)) return failure("an id");
  entry.transmitted = (body[2] & message_sent) != 0;
  const std::uint8_t flags = body[13];
  frame.fd = (flags & fd_edl) != 0;
  frame.brs = frame.fd && (flags & fd_brs) != 0;
  frame.esi = frame.fd && (flags & fd_esi) != 0;
  entry.remote = !frame.fd && (body[2] & message_remote) != 0;
  const std::uint8_t code = body[3] & 15U;
  frame.size = frame.fd ? size_of_dlc[code] : std::min<std::uint8_t>(code, 8);
  return checked(std::move(entry), body.subspan(offset_data));
}

// CAN_FD_MESSAGE_64: channel u8, length code u8, number of data bytes u8, 1 byte, id u32, duration u32, flags
// u32, 5 u32 of timing, bits u16, direction u8 (0 received, 1 sent, 2 request to send), offset of further
// data u8, CRC u32, data
Result<Parsed> fd_64(Body body) {
  constexpr std::size_t offset_data = 40;
  constexpr std::uint32_t flag_remote = 0x10, flag_edl = 0x1000, flag_brs = 0x2000, flag_esi = 0x4000;
  if (body.size() < offset_data) return cut();
  if (body[34] == 2) return Parsed{.left_out = "requests to send"};
  LogEntry entry;
  Frame& frame = entry.frame;
  if (!read_id(little_endian<std::uint32_t>(body, 4), frame)) return failure("an id");
  entry.transmitted = body[34] == 1;
  const auto flags = little_endian<std::uint32_t>(body, 12);
  frame.fd = (flags & flag_edl) != 0;
  frame.brs = frame.fd && (flags & flag_brs) != 0;
  frame.esi = frame.fd && (flags & flag_esi) != 0;
  entry.remote = !frame.fd && (flags & flag_remote) != 0;
  const std::uint8_t code = body[1] & 15U;
  frame.size = frame.fd ? size_of_dlc[code] : std::min<std::uint8_t>(code, 8);
  return checked(std::move(entry), body.subspan(offset_data));
}

// CAN_ERROR_EXT: channel u16, length u16, flags u32, error code u8, position u8, length code u8, 1 byte,
// duration u32, id u32, further flags u16, 2 bytes, data 8 bytes. If the flags are 0, the error code is not
// valid, and id and data are those of an error frame of SocketCAN: canhil and python-can write such objects.
Result<Parsed> error(std::uint32_t type, Body body) {
  constexpr std::uint32_t bus_error = 0x80;  // CAN_ERR_BUSERROR: the details are not read
  LogEntry entry;
  entry.frame = {.id = bus_error, .size = 8, .error = true};
  if (type == can_error_ext) {
    if (body.size() < 32) return cut();
    const std::uint32_t id = little_endian<std::uint32_t>(body, 16) & max_extended_id;
    if (little_endian<std::uint32_t>(body, 4) == 0 && id != 0) {
      entry.frame.id = id;
      entry.frame.size = std::min<std::uint8_t>(body[10], 8);
      return checked(std::move(entry), body.subspan(24, 8));
    }
  }
  return Parsed{.entry = std::move(entry)};
}

}  // namespace

Result<Parsed> frame_of_object(std::uint32_t type, std::span<const std::uint8_t> body, unsigned& channel) {
  if (body.size() < 2) return cut();
  const bool short_channel = type == can_fd_message_64 || type == can_fd_error_64;
  channel = short_channel ? body[0] : little_endian<std::uint16_t>(body, 0);
  switch (type) {
    case can_message:
    case can_message_2:
      return classic(body);
    case can_fd_message:
      return fd(body);
    case can_fd_message_64:
      return fd_64(body);
    case can_error:
    case can_error_ext:
    case can_fd_error_64:
      return error(type, body);
    default:
      return Parsed{.left_out = "objects other than frames of CAN"};
  }
}

}  // namespace canhil::logs::blf
