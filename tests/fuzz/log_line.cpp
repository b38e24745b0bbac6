// Tests the code that reads logs: a line of a candump log, a packet of a capture, and successive lines of an
// ASC file. A candump line must give an entry or one error line. If an entry is written and read again, the
// frame must stay the same.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "dbc/logs/asc.hpp"
#include "dbc/logs/candump.hpp"
#include "dbc/logs/pcap.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view line(reinterpret_cast<const char*>(data), size);
  canhil::logs::AscParser asc;
  for (std::string_view rest = line; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    static_cast<void>(asc.line(rest.substr(0, end)));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  static_cast<void>(canhil::logs::frame_of_packet({data, size}));
  const auto entry = canhil::parse_log_line(line, "fuzz");
  if (!entry) {
    const std::string& message = entry.error().message;
    if (!message.starts_with("fuzz:") || message.find('\n') != std::string::npos) std::abort();
    return 0;
  }
  const auto again = canhil::parse_log_line(canhil::format_log_line(*entry), "fuzz");
  if (!again || again->frame != entry->frame || again->interface != entry->interface) std::abort();
  return 0;
}
