#include "dbc/ports/several.hpp"

#include <fmt/format.h>
#include <sys/epoll.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "dbc/ports/descriptor.hpp"

namespace canhil {
namespace {

constexpr std::int64_t retry_ns =
    200'000;  // time after which to try again: poll() on an epoll set cannot signal room

bool add(const Descriptor& set, const Port& port) {
  epoll_event event{.events = EPOLLIN, .data = {}};
  return ::epoll_ctl(set.get(), EPOLL_CTL_ADD, port.descriptor(), &event) == 0;
}

class Several final : public Port {
 public:
  Several(std::vector<std::unique_ptr<Port>> ports, PortRoute route, Descriptor readable)
      : ports_(std::move(ports)),
        was_up_(ports_.size(), true),
        waiting_(ports_.size()),
        route_(std::move(route)),
        readable_(std::move(readable)) {}

  SendOutcome send(const Frame& frame) override { return ports_.at(route_(frame))->send(frame); }

  std::optional<Received> receive() override {
    std::optional<Received>* oldest = nullptr;
    for (std::size_t i = 0; i < ports_.size(); ++i) {
      if (!waiting_[i]) {
        waiting_[i] = ports_[i]->receive();
        if (waiting_[i]) admit(*waiting_[i], i);
      }
      watch(i);
      if (waiting_[i] && (oldest == nullptr || waiting_[i]->t_ns < (*oldest)->t_ns)) oldest = &waiting_[i];
    }
    return oldest == nullptr ? std::nullopt : std::exchange(*oldest, std::nullopt);
  }

  [[nodiscard]] int descriptor() const override { return readable_.get(); }
  [[nodiscard]] RoomWait room_wait() const override { return {.pause_ns = retry_ns}; }
  [[nodiscard]] bool closed() const override {
    return std::ranges::any_of(ports_, [](const auto& port) { return port->closed(); });
  }
  [[nodiscard]] bool up() const override {
    return std::ranges::all_of(ports_, [](const auto& port) { return port->up(); });
  }
  [[nodiscard]] PortCounters counters() const override {
    PortCounters sum;
    for (const auto& port : ports_) {
      const PortCounters one = port->counters();
      sum.sent += one.sent;
      sum.received += one.received;
      sum.overflowed += one.overflowed;
      sum.error_frames += one.error_frames;
      sum.foreign += one.foreign;
    }
    return sum;
  }
  /// Does not report a wire, because each bus has its own wire.
  [[nodiscard]] Capabilities capabilities() const override {
    return {.reports_errors = std::ranges::all_of(
                ports_, [](const auto& port) { return port->capabilities().reports_errors; })};
  }
  [[nodiscard]] int stamp_clock() const override { return ports_.front()->stamp_clock(); }
  [[nodiscard]] const std::string& name() const override { return ports_.front()->name(); }
  [[nodiscard]] const std::string& bus_name(std::uint8_t bus) const override {
    return ports_.at(bus)->name();
  }
  [[nodiscard]] std::uint8_t bus_of(const Frame& frame) const override {
    return static_cast<std::uint8_t>(route_(frame));
  }

 private:
  // Removes the stamp of the controller from a received frame. Each controller has its own clock, but a
  // stimulus and its answer may be on different buses. For the frames of all buses there are stamps of the
  // kernel's clock.
  static void admit(Received& received, std::size_t bus) {
    received.bus = static_cast<std::uint8_t>(bus);
    received.hardware_ns = 0;
    if (received.source == StampSource::hardware) received.source = StampSource::kernel;
  }

  // Adds a port to the epoll set again when its interface is up again. The error EEXIST is harmless: the set
  // still contains the descriptor of the port.
  void watch(std::size_t i) {
    const bool up = ports_[i]->up();
    if (up && !was_up_[i]) add(readable_, *ports_[i]);
    was_up_[i] = up;
  }

  std::vector<std::unique_ptr<Port>> ports_;
  std::vector<bool> was_up_;
  std::vector<std::optional<Received>>
      waiting_;  // for each port, the next received frame, which receive() has not returned yet
  PortRoute route_;
  Descriptor readable_;
};

template <class Open>
Result<std::unique_ptr<Port>> open_each(const std::vector<std::string>& buses, const Open& open,
                                        PortRoute route) {
  std::vector<std::unique_ptr<Port>> ports;
  for (const std::string& bus : buses) {
    auto opened = open(bus);
    if (!opened) return opened;
    ports.push_back(std::move(*opened));
  }
  return join_ports(std::move(ports), std::move(route));
}

}  // namespace

Result<std::unique_ptr<Port>> join_ports(std::vector<std::unique_ptr<Port>> ports, PortRoute route) {
  if (ports.size() == 1) return std::move(ports.front());
  Descriptor readable(::epoll_create1(EPOLL_CLOEXEC));
  for (const auto& port : ports) {
    if (port->stamp_clock() != ports.front()->stamp_clock())
      return failure(fmt::format("buses '{}' and '{}' have different clocks, expected buses of one kind",
                                 ports.front()->name(), port->name()));
    if (!add(readable, *port))
      return failure(fmt::format("bus '{}': {}", port->name(), std::strerror(errno)));
  }
  return std::make_unique<Several>(std::move(ports), std::move(route), std::move(readable));
}

Result<std::unique_ptr<Port>> open_buses(const std::vector<std::string>& buses, const PortOptions& options,
                                         BusFormat format, PortRoute route, const HubRules& rules) {
  return open_each(
      buses, [&](const std::string& bus) { return join_or_host(bus, options, format, rules); },
      std::move(route));
}

Result<std::unique_ptr<Port>> open_buses(const std::vector<std::string>& buses, const PortOptions& options,
                                         BusFormat format) {
  return open_each(
      buses, [&](const std::string& bus) { return open_bus(bus, options, format); },
      [](const Frame&) { return std::size_t{0}; });
}

}  // namespace canhil
