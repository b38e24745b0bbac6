// Readers and writers of the log formats. Each format has its own source files.
#pragma once

#include "dbc/logs/file.hpp"
#include "dbc/logs/log.hpp"

namespace canhil::logs {

std::unique_ptr<LogSink> candump_sink(File file);
std::unique_ptr<LogSource> candump_source(const std::string& path);

std::unique_ptr<LogSink> asc_sink(File file);
std::unique_ptr<LogSource> asc_source(const std::string& path);

std::unique_ptr<LogSink> pcap_sink(File file);
/// Returns an error of one line if the capture cannot be read, or if its link type is not SocketCAN.
Result<std::unique_ptr<LogSource>> pcap_source(const std::string& path);

}  // namespace canhil::logs
