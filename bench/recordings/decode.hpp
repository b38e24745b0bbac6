// The frames of a log as values, by a DBC file.
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "dbc/parser/database.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::recordings {

enum class Format : std::uint8_t {
  text,        ///< a line a frame, for people
  csv,         ///< a column a signal, a row a frame: PlotJuggler, pandas, spreadsheets
  json_lines,  ///< an object a frame
};

struct DecodeOptions {
  Format format = Format::text;
  std::vector<std::string> only{};  ///< names of messages; empty: all
  bool since_1970 = false;          ///< times; otherwise since the first frame
};

/// Frames that have no values by the DBC.
struct LeftOut {
  std::uint64_t frames = 0;
  std::set<std::string> ids{};        ///< that no message of the DBC has
  std::uint64_t of_another_size = 0;  ///< than their message
};

using Sink = std::function<void(std::string_view part)>;

/// Gives the text, part by part. Numbers are in the signals' units, to twelve digits. Error: one line; the
/// log cannot be read, or the DBC has no message of a name.
Result<LeftOut> decode(const std::string& log, const dbc::Database& database, const DecodeOptions& options,
                       const Sink& give);

}  // namespace canhil::recordings
