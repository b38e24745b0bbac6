#include "target/process/replay.hpp"

#include "dbc/ports/fd_groups.hpp"
#include "dbc/wire/routes.hpp"
#include "target/device/device.hpp"

namespace canhil::target {
namespace {

constexpr Routes from_target_route([](const MessageInfo& info) {
  return info.sender == messages::TargetHeartbeat::info.sender;
});
bool from_target(const Frame& frame) { return from_target_route(frame) != Routes::nowhere; }

// Reads a log to its end, before the first line of a replay is written. One without frames is no recording.
Result<void> check(const std::string& log_path) {
  auto reader = LogReader::open(log_path);
  if (!reader) return tl::unexpected(reader.error());
  for (bool empty = true;; empty = false) {
    const auto next = reader->next();
    if (!next) return tl::unexpected(next.error());
    if (!*next && empty) return failure(log_path + ": holds no frames, expected the log of a run");
    if (!*next) return {};
  }
}

}  // namespace

Result<void> replay(const std::string& log_path, std::FILE* out) {
  if (auto whole = check(log_path); !whole) return whole;
  auto opened = LogReader::open(log_path);
  if (!opened) return tl::unexpected(opened.error());
  ClassicLogReader reader(std::move(*opened));
  Device device;
  const auto print = [&](const LogEntry& entry) {
    std::fprintf(out, "%s\n", format_log_line(entry).c_str());
  };
  for (;;) {
    auto next = reader.next();
    if (!next) return tl::unexpected(next.error());
    if (!*next) return {};
    LogEntry entry = std::move(**next);
    if (from_target(entry.frame)) continue;  // what it answered then; now it answers anew
    entry.transmitted = false;
    print(entry);
    const std::span<const Frame> answers = device.receive(entry.frame);
    entry.transmitted = true;
    for (const Frame& answer : answers) {
      entry.frame = answer;
      print(entry);
    }
  }
}

}  // namespace canhil::target
