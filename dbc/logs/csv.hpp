// The CSV log of SavvyCAN (its format GVRET): a header, then one frame per line. The time is in microseconds;
// the column Dir is missing in logs of older versions.
//     Time Stamp,ID,Extended,Dir,Bus,LEN,D1,D2,D3,D4,D5,D6,D7,D8
//     166064000,0000021A,false,Rx,0,8,FE,36,12,FE,69,05,07,AD,
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "dbc/logs/formats.hpp"

namespace canhil::logs {

/// Parses a log line by line.
class CsvParser {
 public:
  /// The frame in a line. The error states what was expected.
  Result<Parsed> line(std::string_view text);
  /// True if the header has been read.
  [[nodiscard]] bool recognised() const { return has_header_; }

 private:
  static constexpr std::array<std::string_view, 7> names{"time stamp", "id",  "extended", "dir",
                                                         "bus",        "len", "d1"};
  enum Column : std::size_t { time, id, extended, direction, bus, length, data };

  Result<Parsed> header();
  [[nodiscard]] std::string_view cell(Column column) const;

  std::vector<std::string_view> cells_;
  std::array<std::optional<std::size_t>, names.size()> places_;
  bool has_header_ = false;
};

}  // namespace canhil::logs
