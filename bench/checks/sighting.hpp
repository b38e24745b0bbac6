// What came under the id of a message of the target, right or wrong.
#pragma once

#include <cstdint>
#include <string>

#include "dbc/wire/message_info.hpp"

namespace canhil::checks {

/// Frames, by what was wrong with them.
struct Sighting {
  std::uint64_t right = 0;
  std::uint64_t wrong_size = 0;
  std::uint64_t wrong_crc = 0;
  std::uint64_t wrong_counter = 0;  ///< CRC right, but a counter that end-to-end protection does not use
  std::uint64_t repeated = 0;       ///< with the counter of the one before, of a target with a mapping
  std::uint64_t lost = 0;           ///< by what the counters left out, of a target with a mapping
  std::uint8_t size = 0;            ///< of the last one of a wrong size
  std::uint8_t counter = 0;         ///< of the last one with a wrong counter
};

/// "50 with a wrong CRC, 3 of 7 bytes, expected 8"; empty: nothing was wrong.
std::string faults_of(const Sighting& sighting, const MessageInfo& message);

}  // namespace canhil::checks
