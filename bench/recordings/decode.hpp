// Decodes the frames of a log to physical values. A DBC file describes the frames.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "bench/recordings/decoded_lines.hpp"
#include "dbc/parser/database.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::recordings {

struct DecodeOptions {
  Format format = Format::text;
  std::vector<std::string> only{};  ///< names of the messages to decode; empty: all
  bool since_1970 = false;          ///< true: times since 1970; false: times since the first frame
  bool j1939 = false;               ///< true: all messages with 29-bit ids are parameter groups of SAE J1939
};

/// What the output does not contain.
struct LeftOut {
  std::uint64_t frames = 0;     ///< frames that belong to no message
  std::set<std::string> ids{};  ///< their ids; "error frames"
  std::uint64_t ambiguous = 0;  ///< frames of J1939 whose group has several messages for other sources
  std::set<std::string> ambiguous_ids{};
  std::uint64_t short_frames = 0;  ///< frames that lack signals, because they are shorter than their message
  std::uint64_t missing = 0;       ///< the signals that these frames lack
  std::uint64_t incomplete = 0;    ///< messages of several frames that lack a frame
};

/// Decodes a log and passes the resulting text to `give`, part by part. Numbers are in the units of the
/// signals, with all their digits (dbc::DecimalConversion). Returns an error of one line if the log cannot be
/// read, if the DBC lacks a selected message, or if J1939 is selected and the DBC has no 29-bit ids.
Result<LeftOut> decode(const std::string& log, const dbc::Database& database, const DecodeOptions& options,
                       const Sink& give);

}  // namespace canhil::recordings
