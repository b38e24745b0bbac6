// The lines that candump shows on the screen with a time stamp (`candump -t a`), for example
//      (1436509052.249713)  vcan0  123   [8]  05 00 00 00 00 00 00 00
//      (1436509052.249713)  vcan0  RX B E  124  [12]  00 01 02 03 04 05 06 07 08 09 0A 0B
//      (1436509052.249713)  vcan0  20000004   [8]  00 04 00 00 00 00 00 00   ERRORFRAME
//      (1436509052.249713)  vcan0  125   [0]  remote request
// The size of a CAN FD frame has two digits. With -x, direction, BRS and ESI precede the id. With -8, the
// size is {B}, a data length code. With -i, a byte has eight binary digits; with -S, the bytes are one word
// from the last to the first, as in 02`01; with -c, there are colours between the words. The time is since
// 1970 (-t a), a local date (-t A), since the first frame
// (-t z) or since the previous frame (-t d).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "dbc/logs/formats.hpp"
#include "dbc/logs/words.hpp"

namespace canhil::logs {

/// How a time without a date counts.
enum class ScreenTimes : std::uint8_t { unknown, from_first, from_previous };

/// The text without the control sequences that select colours.
std::string without_colours(std::string_view text);

/// Parses the lines that candump prints on a screen.
class ScreenParser {
 public:
  /// The frame in a line. The error states what was expected.
  Result<Parsed> line(std::string_view text);
  /// True if the line has a time without a date, so that times() must be decided.
  [[nodiscard]] static bool has_short_time(std::string_view text);
  /// Decides whether times without a date count from the first or from the previous frame: from the previous
  /// one if, among these lines of the log, the time of a frame is less than that of the frame before, or if
  /// all times after the first are equal.
  void decide_times(std::string_view lines);
  /// How times without a date count, once it is decided.
  [[nodiscard]] ScreenTimes times() const { return times_; }

 private:
  std::optional<std::int64_t> read_time();
  Result<Parsed> frame(LogEntry entry);
  [[nodiscard]] Result<void> read_bytes(Frame& frame) const;

  Words words_;
  std::size_t at_ = 0;  // the word that is read next
  ScreenTimes times_ = ScreenTimes::unknown;
  std::int64_t last_ns_ = 0;
};

}  // namespace canhil::logs
