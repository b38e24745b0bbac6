#include "target/process/replay.hpp"

#include "dbc/logs/candump.hpp"
#include "dbc/ports/fd_groups.hpp"
#include "dbc/wire/routes.hpp"
#include "target/device/device.hpp"

namespace canhil::target {
namespace {

constexpr Routes from_target_route([](const MessageInfo& info) {
  return info.sender == messages::TargetHeartbeat::info.sender;
});
bool from_target(const Frame& frame) { return from_target_route(frame) != Routes::nowhere; }

// Reads the whole log, so that a malformed line is an error before anything is written. A log without frames
// for the target is an error too: it is not the recording of a run.
Result<void> check(const LogFile& log) {
  const std::string& log_path = log.name();
  auto reader = log.read();
  if (!reader) return tl::unexpected(reader.error());
  bool empty = true, unheard = true;
  for (;;) {
    const auto next = reader->next();
    if (!next) return tl::unexpected(next.error());
    if (!*next) break;
    empty = false;
    unheard = unheard && from_target((*next)->frame);
  }
  if (empty) return failure(log_path + ": holds no frames, expected the log of a run");
  if (unheard) return failure(log_path + ": holds only frames of the target, expected the log of a run");
  return {};
}

}  // namespace

Result<void> replay(const std::string& log_path, std::FILE* out) {
  const auto log = LogFile::open(log_path);
  if (!log) return tl::unexpected(log.error());
  if (auto whole = check(*log); !whole) return whole;
  auto opened = log->read();
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
    if (from_target(entry.frame)) continue;  // the recorded answers; the device produces new ones
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
