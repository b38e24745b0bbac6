// Decodes the frames of a log to values, with a DBC file.
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
  text,        ///< one line per frame, for people
  csv,         ///< one column per signal, one row per frame: PlotJuggler, pandas, spreadsheets
  json_lines,  ///< one object per frame
};

struct DecodeOptions {
  Format format = Format::text;
  std::vector<std::string> only{};  ///< names of messages; empty: all
  bool since_1970 = false;          ///< times since 1970; otherwise since the first frame
};

/// Frames that cannot be decoded with the DBC.
struct LeftOut {
  std::uint64_t frames = 0;
  std::set<std::string> ids{};        ///< ids of frames without a message in the DBC; "error frames"
  std::uint64_t of_another_size = 0;  ///< frames of another size than their message
};

using Sink = std::function<void(std::string_view part)>;

/// Decodes a log and passes the text on in parts. Numbers are in the signals' units, with twelve digits.
/// Error: one line; the log cannot be read, or the DBC lacks a selected message.
Result<LeftOut> decode(const std::string& log, const dbc::Database& database, const DecodeOptions& options,
                       const Sink& give);

}  // namespace canhil::recordings
