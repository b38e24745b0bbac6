#include "dbc/ports/log_port.hpp"

#include <fmt/format.h>
#include <sys/eventfd.h>

#include <cerrno>
#include <cstring>
#include <ctime>

#include "dbc/logs/log.hpp"
#include "dbc/ports/descriptor.hpp"
#include "dbc/ports/local_wire.hpp"
#include "dbc/wire/frame_rules.hpp"

namespace canhil {
namespace {

class LogPort final : public Port {
 public:
  LogPort(LogReader reader, std::string name, const PortOptions& options, local::IdSet wanted)
      : reader_(std::move(reader)),
        always_readable_(::eventfd(1, EFD_CLOEXEC)),
        name_(std::move(name)),
        fd_(options.fd),
        only_some_(!options.only_ids.empty()),
        wanted_(wanted) {}

  SendOutcome send(const Frame& frame) override {
    if (!can_carry(frame, fd_)) return SendOutcome::refused;
    ++counters_.sent;
    return SendOutcome::sent;
  }

  std::optional<Received> receive() override {
    while (!closed_) {
      const auto entry = reader_.next();
      if (!entry || !*entry) {  // the whole log was valid when it was opened, so the file has changed since
        closed_ = true;
      } else if (const Frame& frame = (*entry)->frame; passes(frame)) {
        ++counters_.received;
        if (frame.error) ++counters_.error_frames;
        return Received{.frame = frame, .t_ns = (*entry)->t_ns};
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] int descriptor() const override { return always_readable_.get(); }
  [[nodiscard]] RoomWait room_wait() const override { return {}; }
  [[nodiscard]] bool closed() const override { return closed_; }
  [[nodiscard]] PortCounters counters() const override { return counters_; }
  [[nodiscard]] Capabilities capabilities() const override { return {.reports_errors = true}; }
  [[nodiscard]] int stamp_clock() const override { return CLOCK_REALTIME; }
  [[nodiscard]] const std::string& name() const override { return name_; }

 private:
  [[nodiscard]] bool passes(const Frame& frame) const {
    return !only_some_ || frame.error || (!frame.extended && wanted_.test(frame.id));
  }

  LogReader reader_;
  Descriptor always_readable_;
  std::string name_;
  bool fd_;
  bool only_some_;
  local::IdSet wanted_;
  bool closed_ = false;
  PortCounters counters_;
};

Result<void> check(LogReader reader, bool fd, std::string_view bus) {
  for (;;) {
    const auto entry = reader.next();
    if (!entry) return tl::unexpected(entry.error());
    if (!*entry) return {};
    if ((*entry)->frame.fd && !fd)
      return failure(fmt::format("'{}' holds CAN FD frames: open it with FD", bus));
  }
}

}  // namespace

Result<std::unique_ptr<Port>> open_log_port(std::string_view bus, const PortOptions& options) {
  const auto wanted = local::id_set(options.only_ids);
  if (!wanted) return tl::unexpected(wanted.error());
  const std::string path(bus.substr(std::string_view("log:").size()));
  const auto log = LogFile::open(path);
  if (!log) return tl::unexpected(log.error());
  auto first = log->read();
  if (!first) return tl::unexpected(first.error());
  if (auto checked = check(std::move(*first), options.fd, bus); !checked)
    return tl::unexpected(checked.error());
  auto reader = log->read();
  if (!reader) return tl::unexpected(reader.error());
  return std::make_unique<LogPort>(std::move(*reader), std::string(bus), options, *wanted);
}

}  // namespace canhil
