// Counts the frames that carry the id of a target's message, by validity and defect.
#pragma once

#include <cstdint>
#include <string>

#include "dbc/wire/message_info.hpp"

namespace canhil::checks {

/// Frames by kind of defect. The counts of a defect are 0 if the message has no protection that shows it.
struct Sighting {
  bool has_counter = false, has_checksum = false;
  std::uint64_t right = 0;
  std::uint64_t wrong_size = 0;
  std::uint64_t wrong_crc = 0;
  std::uint64_t wrong_counter = 0;  ///< CRC valid, but a counter value that the E2E protection never uses
  std::uint64_t repeated = 0;       ///< frames with the counter of the previous one
  std::uint64_t lost = 0;           ///< frames that are missing by the gaps of the counter
  std::uint8_t size = 0;            ///< size of the last frame of a wrong size
  std::uint8_t counter = 0;         ///< counter of the last frame with a wrong counter
};

/// Describes the defects, for example "50 with a wrong CRC, 3 of 7 bytes, expected 8": 50 frames had a wrong
/// CRC, and 3 frames had 7 bytes instead of 8. Empty: there are no defects.
std::string faults_of(const Sighting& sighting, const MessageInfo& message);

}  // namespace canhil::checks
