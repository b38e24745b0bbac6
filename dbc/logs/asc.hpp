// Vector's ASCII log: a header, then one event per line. Events that are not frames are ignored.
//     date Tue Nov 24 08:12:13.000 2026
//     base hex  timestamps absolute
//     internal events logged
//     Begin Triggerblock Tue Nov 24 08:12:13.000 2026
//        0.249713 1  7DF             Rx   d 8 02 01 0D 00 00 00 00 00
//        0.249900 1  7DF             Rx   r 8
//        0.250000 CANFD   1 Tx        1FFx  1 0 9 12 00 01 ...
// Channels are numbered from 1. A comment such as "// channel 1: can0" contains the name of the interface.
#pragma once

#include <map>
#include <span>
#include <string_view>
#include <vector>

#include "dbc/logs/formats.hpp"
#include "dbc/logs/words.hpp"

namespace canhil::logs {

/// The flags of an event CANFD.
struct AscFdFlags {
  static constexpr std::uint32_t remote = 0x10, fd = 0x1000, brs = 0x2000, esi = 0x4000;
};

/// Parses a log line by line.
class AscParser {
 public:
  /// The frame in a line. The error states what was expected.
  Result<Parsed> line(std::string_view text);
  /// True if the header or a frame has been read.
  [[nodiscard]] bool recognised() const { return recognised_; }

 private:
  using Rest = std::span<const std::string_view>;  // words of a line

  Result<Parsed> event();
  Result<Parsed> classic(Rest words, LogEntry entry) const;
  Result<Parsed> fd(Rest words, LogEntry entry) const;
  // The columns of a frame of CAN FD: the place of BRS, and the values of DLC and SIZE.
  struct FdColumns {
    std::size_t flags_at = 0;
    std::optional<std::size_t> dlc{}, size{};
  };
  static FdColumns after_name(Rest words);
  Result<void> read_fd(Rest words, LogEntry& entry) const;
  Result<void> read_fd_of_old_tools(Rest words, LogEntry& entry) const;
  Result<void> read_data(Rest words, std::size_t size, Frame& frame) const;
  [[nodiscard]] std::optional<std::uint32_t> number(std::string_view word) const;
  [[nodiscard]] bool is_id(std::string_view word) const;
  bool read_id(std::string_view word, Frame& frame) const;
  std::optional<Parsed> header(std::string_view text);
  const std::string& interface_of(unsigned channel);

  Words words_;
  int base_ = 16;
  bool relative_ = false;  // true: each time is relative to the previous event
  bool recognised_ = false;
  std::int64_t start_ns_ = 0;  // start of the trigger block
  std::int64_t last_ns_ = 0;   // time of the last event, relative to start_ns_
  std::map<unsigned, std::string> names_;
};

}  // namespace canhil::logs
