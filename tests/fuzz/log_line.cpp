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
#include "dbc/logs/candump_screen.hpp"
#include "dbc/logs/pcap.hpp"
#include "tests/fuzz/whole_log.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace canhil;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  logs::AscParser asc;
  logs::ScreenParser screen;
  screen.decide_times(text);
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(0, end);
    if (const auto parsed = asc.line(line); parsed && parsed->entry) fuzz::expect_frame(*parsed->entry);
    if (line.find_first_not_of(" \t") != std::string_view::npos) {
      const auto parsed = screen.line(line);
      if (parsed && parsed->entry) fuzz::expect_frame(*parsed->entry);
    }
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  for (const std::uint16_t link : {logs::socketcan, logs::linux_sll, logs::linux_sll2}) {
    const auto parsed = logs::frame_of_packet(link, {data, size});
    if (parsed && parsed->entry && !can_carry(parsed->entry->frame, true)) std::abort();
  }
  const auto entry = parse_log_line(text, "fuzz");
  if (!entry) {
    const std::string& message = entry.error().message;
    if (!message.starts_with("fuzz:") || message.find('\n') != std::string::npos) std::abort();
    return 0;
  }
  const auto again = parse_log_line(format_log_line(*entry), "fuzz");
  if (!again || again->frame != entry->frame || again->interface != entry->interface ||
      again->remote != entry->remote)
    std::abort();
  return 0;
}
