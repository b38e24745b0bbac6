// The log formats; each has its own source file.
#pragma once

#include "dbc/logs/file.hpp"
#include "dbc/logs/log.hpp"

namespace canhil::logs {

std::unique_ptr<LogSink> candump_sink(File file);
std::unique_ptr<LogSource> candump_source(const std::string& path);

std::unique_ptr<LogSink> asc_sink(File file);
std::unique_ptr<LogSource> asc_source(const std::string& path);

std::unique_ptr<LogSink> pcap_sink(File file);
/// Error: one line; the capture cannot be read, or its link type is not SocketCAN.
Result<std::unique_ptr<LogSource>> pcap_source(const std::string& path);

}  // namespace canhil::logs
