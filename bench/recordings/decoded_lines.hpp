// The output formats of decoded frames.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/recordings/frame_decoder.hpp"
#include "dbc/logs/log.hpp"
#include "dbc/parser/database.hpp"

namespace canhil::recordings {

enum class Format : std::uint8_t {
  text,        ///< one line per frame, for people
  csv,         ///< a column per signal, a row per frame; for PlotJuggler, pandas, spreadsheets
  json_lines,  ///< one object per frame
};

using Sink = std::function<void(std::string_view part)>;

/// A decoded frame.
struct DecodedFrame {
  const LogEntry& entry;
  const dbc::Message& message;
  bool is_group = false;  ///< the message is a parameter group of SAE J1939
  std::string_view t_s;   ///< the time as text
  const std::vector<SignalValue>& values;
};

/// Base class: writes decoded frames in one format.
class LineWriter {
 public:
  LineWriter() = default;
  LineWriter(const LineWriter&) = delete;
  LineWriter& operator=(const LineWriter&) = delete;
  virtual ~LineWriter() = default;
  /// Writes a frame.
  virtual void write(const DecodedFrame& frame) = 0;
  /// Must be called after the last frame.
  virtual void finish() {}
};

/// A writer that passes its output to `give`. `with_groups`: a CSV has columns for the addresses of SAE
/// J1939. `database` and `give` must outlive the writer.
std::unique_ptr<LineWriter> line_writer(Format format, const dbc::Database& database, bool with_groups,
                                        const Sink& give);

}  // namespace canhil::recordings
