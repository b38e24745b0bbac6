// [[fault]]: what befalls frames of the bench's nodes on their way to the bus.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace canhil::scenario {

class Section;
struct Contract;

/// What becomes of a frame.
enum class FaultKind : std::uint8_t {
  lost,       ///< not sent
  damaged,    ///< a bit of its payload is another, its CRC as it was
  repeated,   ///< sent twice
  too_short,  ///< without its last byte
  foreign,    ///< as an extended frame, with 29 bits of id
  changed     ///< a signal has another value, counter and CRC are right
};

/// One fault: of the frames of some messages, in a stretch of the run.
struct Fault {
  FaultKind kind = FaultKind::lost;
  std::vector<std::string> messages{};
  std::int64_t from_us = 0, to_us = std::numeric_limits<std::int64_t>::max();  ///< times of transmission
  std::int64_t every = 1;  ///< befalls the first of each so many frames of a message
  std::string signal{};    ///< of `changed`
  double value = 0;        ///< in the signal's unit
  std::string where{};     ///< its key "messages", for people
};

std::vector<Fault> read_faults(Section& root, const Contract& contract);

}  // namespace canhil::scenario
