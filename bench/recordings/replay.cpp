#include "bench/recordings/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace canhil::recordings {
namespace {

constexpr std::int64_t patience_ns = 1'000'000'000;
constexpr std::int64_t look_ns = 100'000'000;        // while waiting, `stop` is checked at this interval
constexpr std::int64_t look_at_all_ns = 10'000'000;  // ... and several buses are read

bool wanted(const LogEntry& entry, const ReplayOptions& options) {
  return !entry.frame.error && (!options.transmitted || entry.transmitted == *options.transmitted) &&
         (options.only.empty() || std::ranges::find(options.only, entry.frame.id) != options.only.end());
}

class Replay {
 public:
  Replay(const std::vector<ReplayBus>& buses, const LogFile& log, const ReplayOptions& options,
         const std::atomic<bool>& stop, const std::function<void(std::uint64_t)>& progress)
      : buses_(buses),
        clock_(buses.front().port),
        log_(log),
        options_(options),
        stop_(stop),
        progress_(progress) {}

  Result<Replayed> run() {
    while (!stop_ && (options_.loops == 0 || done_.loops < options_.loops)) {
      ++done_.loops;
      if (auto sent = once(); !sent) return tl::unexpected(sent.error());
      if (done_.frames == 0)
        return failure(
            fmt::format("{}: has no frame to send, expected some of those asked for", log_.name()));
    }
    return done_;
  }

 private:
  // The bus that carries the frame; null: none does.
  [[nodiscard]] Port* port_for(const LogEntry& entry) const {
    if (!wanted(entry, options_)) return nullptr;
    const auto found = std::ranges::find_if(buses_, [&](const ReplayBus& bus) {
      return bus.interface.empty() || bus.interface == entry.interface;
    });
    return found == buses_.end() ? nullptr : &found->port;
  }

  // Sends the whole log one time, from its beginning. The next repetition follows without a pause.
  Result<void> once() {
    auto reader = log_.read();
    if (!reader) return tl::unexpected(reader.error());
    std::optional<std::int64_t> first_ns;
    const std::int64_t start_ns = clock_.monotonic_ns();
    while (!stop_) {
      const auto entry = reader->next();
      if (!entry) return tl::unexpected(entry.error());
      if (!*entry) break;
      Port* const port = port_for(**entry);
      if (port == nullptr) continue;
      if (!first_ns) first_ns = (*entry)->t_ns;
      const double since_ns = static_cast<double>((*entry)->t_ns - *first_ns) / options_.speed;
      if (!wait_until(start_ns + std::llround(since_ns))) return {};
      if (auto sent = send(*port, (*entry)->frame, start_ns + std::llround(since_ns)); !sent) return sent;
    }
    return {};
  }

  // Reads and discards frames from the buses, because a node that does not read blocks its bus.
  void discard_received() {
    for (const ReplayBus& bus : buses_) {
      while (bus.port.receive()) {
      }
    }
  }

  // Waits until `deadline_ns`; false: the replay was stopped.
  bool wait_until(std::int64_t deadline_ns) {
    for (;;) {
      discard_received();
      const std::int64_t now_ns = clock_.monotonic_ns();
      if (stop_) return false;
      if (now_ns >= deadline_ns) return true;
      wait(clock_, WaitFor::frame,
           std::min(deadline_ns, now_ns + (buses_.size() > 1 ? look_at_all_ns : look_ns)));
    }
  }

  Result<void> send(Port& port, const Frame& frame, std::int64_t due_ns) {
    const std::int64_t give_up_ns = port.monotonic_ns() + patience_ns;
    for (;;) {
      const std::int64_t now_ns = port.monotonic_ns();
      switch (port.send(frame)) {
        case SendOutcome::sent:
          done_.lateness.add(std::max<std::int64_t>(now_ns - due_ns, 0));
          progress_(++done_.frames);
          return {};
        case SendOutcome::refused:
          return failure(fmt::format(
              "bus '{}': cannot carry a frame with id {:X} and {} bytes{}, expected a bus that can",
              port.name(), frame.id, frame.size, frame.fd ? " of CAN FD" : ""));
        case SendOutcome::down:
          return failure(fmt::format("bus '{}': is gone", port.name()));
        case SendOutcome::queue_full:
          break;
      }
      if (stop_) return {};
      if (now_ns >= give_up_ns)
        return failure(fmt::format(
            "bus '{}': accepted no frame for a second, expected a node that acknowledges", port.name()));
      wait(port, WaitFor::room, give_up_ns);
      discard_received();
    }
  }

  const std::vector<ReplayBus>& buses_;
  Port& clock_;  // the bus whose clock counts
  const LogFile& log_;
  const ReplayOptions& options_;
  const std::atomic<bool>& stop_;
  const std::function<void(std::uint64_t)>& progress_;
  Replayed done_;
};

}  // namespace

Result<std::vector<std::string>> interfaces_of(const LogFile& log, const ReplayOptions& options) {
  auto reader = log.read();
  if (!reader) return tl::unexpected(reader.error());
  std::vector<std::string> interfaces;
  for (;;) {
    const auto entry = reader->next();
    if (!entry) return tl::unexpected(entry.error());
    if (!*entry) return interfaces;
    if (wanted(**entry, options) && std::ranges::find(interfaces, (*entry)->interface) == interfaces.end())
      interfaces.push_back((*entry)->interface);
  }
}

Result<Replayed> replay(const std::vector<ReplayBus>& buses, const LogFile& log, const ReplayOptions& options,
                        const std::atomic<bool>& stop, const std::function<void(std::uint64_t)>& progress) {
  return Replay(buses, log, options, stop, progress).run();
}

}  // namespace canhil::recordings
