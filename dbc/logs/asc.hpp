// Vector's ASCII log: a header, then one event per line. Events that are not frames are ignored.
//     date Tue Nov 24 08:12:13.000 2026
//     base hex  timestamps absolute
//     internal events logged
//     Begin Triggerblock Tue Nov 24 08:12:13.000 2026
//        0.249713 1  7DF             Rx   d 8 02 01 0D 00 00 00 00 00
//        0.250000 CANFD   1 Tx        1FFx  1 0 9 12 00 01 ...
// Channels are numbered from 1. A comment such as "// channel 1: can0" contains the name of the interface.
#pragma once

#include <map>
#include <span>
#include <string_view>
#include <vector>

#include "dbc/logs/log.hpp"

namespace canhil::logs {

/// Parses a log line by line.
class AscParser {
 public:
  /// The frame in a line; nullopt: the line contains no frame, or a remote frame. The error states what was
  /// expected.
  Result<std::optional<LogEntry>> line(std::string_view text);

 private:
  Result<std::optional<LogEntry>> event(const std::vector<std::string_view>& words);
  Result<void> read_classic(std::span<const std::string_view> words, LogEntry& entry) const;
  Result<void> read_fd(std::span<const std::string_view> words, LogEntry& entry) const;
  Result<void> read_data(std::span<const std::string_view> words, std::size_t size, Frame& frame) const;
  [[nodiscard]] std::optional<std::uint32_t> number(std::string_view word) const;
  bool read_id(std::string_view word, Frame& frame) const;
  bool header(std::string_view text, const std::vector<std::string_view>& words);
  [[nodiscard]] std::string interface_of(unsigned channel) const;

  int base_ = 16;
  bool relative_ = false;      // true: each time is relative to the previous event
  std::int64_t start_ns_ = 0;  // start of the trigger block
  std::int64_t last_ns_ = 0;   // time of the last event, relative to start_ns_
  std::map<unsigned, std::string> names_;
};

}  // namespace canhil::logs
