// Decodes the frames of a log to physical values. A DBC file describes the frames.
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
  csv,         ///< a column per signal, a row per frame; for PlotJuggler, pandas, spreadsheets
  json_lines,  ///< one object per frame
};

struct DecodeOptions {
  Format format = Format::text;
  std::vector<std::string> only{};  ///< names of the messages to decode; empty: all
  bool since_1970 = false;          ///< true: times since 1970; false: times since the first frame
};

/// Frames that cannot be decoded with the DBC.
struct LeftOut {
  std::uint64_t frames = 0;
  std::set<std::string> ids{};         ///< ids that the DBC does not have; "error frames"
  std::uint64_t of_another_size = 0;   ///< number of frames whose size differs from that of their message
  std::vector<std::string> remarks{};  ///< see LogReader::remarks()
};

using Sink = std::function<void(std::string_view part)>;

/// Decodes a log and passes the resulting text to `give`, part by part. Numbers are in the units of the
/// signals, with twelve digits. Returns an error of one line if the log cannot be read or if the DBC lacks a
/// selected message.
Result<LeftOut> decode(const std::string& log, const dbc::Database& database, const DecodeOptions& options,
                       const Sink& give);

}  // namespace canhil::recordings
