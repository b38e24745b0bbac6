#include "dbc/logs/log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "dbc/logs/formats.hpp"

namespace canhil {
namespace {

using namespace std::string_view_literals;

// The first bytes of captures: pcap with stamps in microseconds (little-endian, big-endian); pcap with stamps
// in nanoseconds (little-endian, big-endian); pcapng.
constexpr std::array captures{"\xD4\xC3\xB2\xA1"sv, "\xA1\xB2\xC3\xD4"sv, "\x4D\x3C\xB2\xA1"sv,
                              "\xA1\xB2\x3C\x4D"sv, "\x0A\x0D\x0D\x0A"sv};

bool is_capture(std::string_view beginning) {
  return std::ranges::any_of(captures, [&](std::string_view magic) { return beginning.starts_with(magic); });
}

// The header of an ASC log begins with a comment, the date or the number base.
bool is_asc(std::string_view beginning) {
  return beginning.starts_with("date ") || beginning.starts_with("base ") || beginning.starts_with("//");
}

struct Format {
  std::string_view ending;
  std::unique_ptr<LogSink> (*sink)(logs::File file);
};
constexpr std::array formats{Format{".log", logs::candump_sink}, Format{"", logs::candump_sink},
                             Format{".txt", logs::candump_sink}, Format{".candump", logs::candump_sink},
                             Format{".pcap", logs::pcap_sink},   Format{".asc", logs::asc_sink}};

// The format that the ending of a file name selects; null: a format that cannot be written.
const Format* format_of(const std::string& name) {
  std::string ending = std::filesystem::path(name).extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto found = std::ranges::find(formats, ending, &Format::ending);
  return found == formats.end() ? nullptr : &*found;
}

}  // namespace

Result<LogWriter> LogWriter::create(std::FILE* stream, std::string name) {
  logs::File file(stream);
  const Format* format = format_of(name);
  if (format == nullptr)
    return failure(
        fmt::format("cannot write log '{}': its ending names no format that can be written, expected "
                    ".log (candump), .pcap or .asc",
                    name));
  return LogWriter(format->sink(std::move(file)), std::move(name));
}

Result<void> LogWriter::close() {
  if (const int error = sink_->close(); error != 0)
    return failure(fmt::format("cannot write log '{}': {}", name_, std::strerror(error)));
  return {};
}

Result<LogReader> LogReader::open(const std::string& path) {
  const auto beginning = logs::beginning_of(path, 8);
  if (!beginning) return tl::unexpected(beginning.error());
  if (is_capture(*beginning)) {
    auto source = logs::pcap_source(path);
    if (!source) return tl::unexpected(source.error());
    return LogReader(std::move(*source));
  }
  return LogReader(is_asc(*beginning) ? logs::asc_source(path) : logs::candump_source(path));
}

}  // namespace canhil
