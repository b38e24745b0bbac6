// The trace files of PEAK-System (PCAN-View, PCAN-Explorer), versions 1.0 to 2.1: a header of comments, then
// one event per line. The version fixes the columns; since 2.0 the header states them:
//     ;$FILEVERSION=2.1
//     ;$STARTTIME=44548.6028595139
//     ;$COLUMNS=N,O,T,B,I,d,R,L,D
//           1      1059.900 DT 1      0300 Rx -  7    00 00 00 00 04 00 00
// N number, O offset in ms, T type, B bus, I id, d direction, R reserved, l size, L data length code, D data.
// Source: PEAK-System, "PEAK CAN TRC File Format".
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "dbc/logs/formats.hpp"
#include "dbc/logs/words.hpp"

namespace canhil::logs {

/// Parses a trace line by line.
class TrcParser {
 public:
  /// The frame in a line. The error states what was expected.
  Result<Parsed> line(std::string_view text);
  /// True if the header or a frame has been read.
  [[nodiscard]] bool recognised() const { return recognised_; }

 private:
  Result<Parsed> comment(std::string_view text);
  Result<Parsed> event();
  Result<Parsed> frame(LogEntry entry, std::string_view type);
  [[nodiscard]] std::string_view word(char column) const;

  Words words_;
  unsigned major_ = 1;
  std::string columns_ = "NOIlD";  // those of version 1.0, whose header states no version
  std::int64_t start_ns_ = 0;
  bool recognised_ = false;
};

}  // namespace canhil::logs
