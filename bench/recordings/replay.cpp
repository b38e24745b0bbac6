#include "bench/recordings/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dbc/logs/log.hpp"

namespace canhil::recordings {
namespace {

constexpr std::int64_t patience_ns = 1'000'000'000;
constexpr std::int64_t look_ns = 100'000'000;  // while waiting, `stop` is checked at this interval

class Replay {
 public:
  Replay(Port& port, const std::string& log, const ReplayOptions& options, const std::atomic<bool>& stop,
         const std::function<void(std::uint64_t)>& progress)
      : port_(port), log_(log), options_(options), stop_(stop), progress_(progress) {}

  Result<Replayed> run() {
    while (!stop_ && (options_.loops == 0 || done_.loops < options_.loops)) {
      ++done_.loops;
      if (auto sent = once(); !sent) return tl::unexpected(sent.error());
      if (done_.frames == 0)
        return failure(fmt::format("{}: has no frame to send, expected some of those asked for", log_));
    }
    return done_;
  }

 private:
  [[nodiscard]] bool wanted(const LogEntry& entry) const {
    return !entry.frame.error && (!options_.transmitted || entry.transmitted == *options_.transmitted) &&
           (options_.only.empty() || std::ranges::find(options_.only, entry.frame.id) != options_.only.end());
  }

  // Sends the whole log one time, from its beginning. The next repetition follows without a pause.
  Result<void> once() {
    auto reader = LogReader::open(log_);
    if (!reader) return tl::unexpected(reader.error());
    std::optional<std::int64_t> first_ns;
    const std::int64_t start_ns = port_.monotonic_ns();
    while (!stop_) {
      const auto entry = reader->next();
      if (!entry) return tl::unexpected(entry.error());
      if (!*entry) return {};
      if (!wanted(**entry)) continue;
      if (!first_ns) first_ns = (*entry)->t_ns;
      const double since_ns = static_cast<double>((*entry)->t_ns - *first_ns) / options_.speed;
      if (!wait_until(start_ns + std::llround(since_ns))) return {};
      if (auto sent = send((*entry)->frame, start_ns + std::llround(since_ns)); !sent) return sent;
    }
    return {};
  }

  // Waits until `deadline_ns`; false: the replay was stopped. Meanwhile reads and discards frames from the
  // bus, because a node that does not read blocks the bus.
  bool wait_until(std::int64_t deadline_ns) {
    for (;;) {
      while (port_.receive()) {
      }
      const std::int64_t now_ns = port_.monotonic_ns();
      if (stop_) return false;
      if (now_ns >= deadline_ns) return true;
      wait(port_, WaitFor::frame, std::min(deadline_ns, now_ns + look_ns));
    }
  }

  Result<void> send(const Frame& frame, std::int64_t due_ns) {
    const std::int64_t give_up_ns = port_.monotonic_ns() + patience_ns;
    for (;;) {
      const std::int64_t now_ns = port_.monotonic_ns();
      switch (port_.send(frame)) {
        case SendOutcome::sent:
          done_.lateness.add(std::max<std::int64_t>(now_ns - due_ns, 0));
          progress_(++done_.frames);
          return {};
        case SendOutcome::refused:
          return failure(fmt::format(
              "bus '{}': cannot carry a frame with id {:X} and {} bytes{}, expected a bus that can",
              port_.name(), frame.id, frame.size, frame.fd ? " of CAN FD" : ""));
        case SendOutcome::down:
          return failure(fmt::format("bus '{}': is gone", port_.name()));
        case SendOutcome::queue_full:
          break;
      }
      if (stop_) return {};
      if (now_ns >= give_up_ns)
        return failure(fmt::format("bus '{}': took no frame for a second, expected a node that acknowledges",
                                   port_.name()));
      wait(port_, WaitFor::room, give_up_ns);
      while (port_.receive()) {
      }
    }
  }

  Port& port_;
  const std::string& log_;
  const ReplayOptions& options_;
  const std::atomic<bool>& stop_;
  const std::function<void(std::uint64_t)>& progress_;
  Replayed done_;
};

}  // namespace

Result<Replayed> replay(Port& port, const std::string& log, const ReplayOptions& options,
                        const std::atomic<bool>& stop, const std::function<void(std::uint64_t)>& progress) {
  return Replay(port, log, options, stop, progress).run();
}

}  // namespace canhil::recordings
