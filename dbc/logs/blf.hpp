// Vector's binary log (BLF). All numbers are little-endian. A file has a header, then objects; each object
// has a header that begins with "LOBJ". Most objects are inside of containers: objects whose content is,
// compressed or not, a part of a stream of further objects. An object of the stream may extend over several
// containers.
//
//   header of the file  "LOGG", size u32, program and version 8 u8, file size u64, size without compression
//                       u64, objects u32, 0 u32, start and end as SYSTEMTIME (8 u16: year, month, day of the
//                       week, day, hour, minute, second, ms; local time)
//   header of objects   "LOBJ", header size u16, header version u16, object size u32, type u32
//   ... in the stream   flags u32 (unit of the time: 1 is 10 us, 2 is 1 ns), 0 u16, version u16, time u64
//   container (10)      method u16 (0 none, 2 zlib), 6 bytes, size without compression u32, 4 bytes, content
#pragma once

#include <cstdint>
#include <span>

#include "dbc/logs/formats.hpp"

namespace canhil::logs::blf {

/// The types of the objects that are read or written.
enum Type : std::uint32_t {
  can_message = 1,
  can_error = 2,
  log_container = 10,
  app_text = 65,
  can_error_ext = 73,
  can_message_2 = 86,
  can_fd_message = 100,
  can_fd_message_64 = 101,
  can_fd_error_64 = 104,
};

inline constexpr std::size_t file_header_size = 144;
inline constexpr std::size_t base_header_size = 16, header_size = 32, container_header_size = 16;
/// The size of the part of a file header that is read, in bytes, and the offsets of its fields.
inline constexpr std::size_t file_header_used = 72, offset_start = 40;

inline constexpr std::uint32_t extended_id = 0x8000'0000;
/// Flags of classic frames, and of CAN_FD_MESSAGE.
inline constexpr std::uint8_t message_sent = 0x01, message_remote = 0x80;
/// The further flags of CAN_FD_MESSAGE.
inline constexpr std::uint8_t fd_edl = 1, fd_brs = 2, fd_esi = 4;
/// In an object APP_TEXT, the source "information about a channel"; its text is "DATABASE;INTERFACE".
inline constexpr std::uint32_t channel_text = 1;
inline constexpr std::uint32_t bus_type_can = 1;

/// The header of an object, as far as it is read.
struct Header {
  std::uint16_t size = 0;
  std::uint32_t object_size = 0, type = 0;
};

/// The header of the next object, which is not taken from the input. Up to 7 bytes before it, which fill the
/// space behind the object before, are taken. Nullopt: the input has ended. The error does not state the
/// file.
Result<std::optional<Header>> next_header(Input& input);

/// The frame that an object contains. `type` is that of its header, `body` is what follows the header. Sets
/// the frame, the direction and the channel (`interface` stays empty). The error states what was expected.
Result<Parsed> frame_of_object(std::uint32_t type, std::span<const std::uint8_t> body, unsigned& channel);

/// The bytes of the objects of a file: the contents of its containers, in order, without the containers.
/// `input` is behind the header of the file.
std::unique_ptr<Bytes> contents_of_containers(Input input);

}  // namespace canhil::logs::blf
