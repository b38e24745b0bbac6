// Readers and writers of the log formats. Each format has its own source files.
#pragma once

#include "dbc/logs/file.hpp"
#include "dbc/logs/input.hpp"
#include "dbc/logs/log.hpp"

namespace canhil::logs {

/// What a line or record contains: a frame; or nothing of interest, such as a comment (`left_out` is empty);
/// or something that is left out, for the reason in `left_out`.
struct Parsed {
  std::optional<LogEntry> entry{};
  std::string_view left_out{};
};

std::unique_ptr<LogSink> candump_sink(File file);
std::unique_ptr<LogSink> asc_sink(File file);
std::unique_ptr<LogSink> blf_sink(File file);
std::unique_ptr<LogSink> pcap_sink(File file);

std::unique_ptr<LogSource> candump_source(Input input);
std::unique_ptr<LogSource> asc_source(Input input);
std::unique_ptr<LogSource> trc_source(Input input);
std::unique_ptr<LogSource> csv_source(Input input);

// The sources of binary formats return an error of one line if the header of the file is wrong.
Result<std::unique_ptr<LogSource>> blf_source(Input input);
/// Reads pcap and pcapng. A capture of a link layer that carries no CAN frames is an error.
Result<std::unique_ptr<LogSource>> capture_source(Input input);

/// The source for the format that the content has. The error, one line, names a format that is not read, and
/// the command that converts it if there is one.
Result<std::unique_ptr<LogSource>> source_of(Input input);

}  // namespace canhil::logs
