#include "target/process/replay.hpp"

#include "dbc/ports/candump_log.hpp"
#include "target/device/device.hpp"

namespace canhil::target {

Result<void> replay(const std::string& log_path, std::FILE* out) {
  auto reader = LogReader::open(log_path);
  if (!reader) return tl::unexpected(reader.error());
  Device device;
  for (;;) {
    auto next = reader->next();
    if (!next) return tl::unexpected(next.error());
    if (!*next) return {};
    LogEntry answer = **next;
    answer.transmitted = true;
    for (const Frame& frame : device.receive((*next)->frame)) {
      answer.frame = frame;
      std::fprintf(out, "%s\n", format_log_line(answer).c_str());
    }
  }
}

}  // namespace canhil::target
