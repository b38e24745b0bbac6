#include "dbc/ports/port.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <ctime>

#include "dbc/ports/local_bus.hpp"
#include "dbc/ports/log_port.hpp"
#include "dbc/ports/socketcan.hpp"

namespace canhil {
namespace {

constexpr std::int64_t ns_per_s = 1'000'000'000;
constexpr std::int64_t look_again_ns = 20'000'000;

timespec to_timespec(std::int64_t ns) {
  return {.tv_sec = static_cast<std::time_t>(ns / ns_per_s), .tv_nsec = static_cast<long>(ns % ns_per_s)};
}

// Waits until one of the events occurs, the pause ends or the deadline passes; see wait().
bool wait_for(const Port& port, RoomWait how, std::int64_t deadline_ns) {
  if (how.events == 0 && how.pause_ns == 0) return true;
  const bool forever =
      deadline_ns == no_deadline && how.pause_ns == 0;  // then a clock reading and a timer are not necessary
  const std::int64_t left_ns =
      forever ? 0 : std::max<std::int64_t>(deadline_ns - clock_ns(CLOCK_MONOTONIC), 0);
  const bool pause = how.pause_ns != 0 && how.pause_ns <= left_ns;
  const timespec timeout = to_timespec(pause ? how.pause_ns : left_ns);
  pollfd entry{.fd = how.events == 0 ? -1 : port.descriptor(), .events = how.events, .revents = 0};
  const int ready = ::ppoll(&entry, 1, forever ? nullptr : &timeout, nullptr);
  return ready > 0 || (ready == 0 && pause);
}

}  // namespace

std::int64_t clock_ns(int clock) {
  timespec now{};
  ::clock_gettime(clock, &now);
  return now.tv_sec * ns_per_s + now.tv_nsec;
}

std::size_t Port::send_all(std::span<const Frame> frames) {
  const auto refused =
      std::ranges::find_if(frames, [this](const Frame& frame) { return send(frame) != SendOutcome::sent; });
  return static_cast<std::size_t>(refused - frames.begin());
}

bool Port::wait_for_frame(std::int64_t deadline_ns) {
  return wait_for(*this, {.events = POLLIN}, deadline_ns);
}

bool Port::wait_for_room(std::int64_t deadline_ns) { return wait_for(*this, room_wait(), deadline_ns); }

bool wait(Port& port, WaitFor what, std::int64_t deadline_ns) {
  // If an interface is down, poll() immediately reports room, and gives no notice when the interface comes up
  // again. Therefore the wait ends after a pause, so that the caller checks the interface again.
  if (!port.up()) return wait_for(port, {.events = POLLIN, .pause_ns = look_again_ns}, deadline_ns);
  if (what == WaitFor::frame) return port.wait_for_frame(deadline_ns);
  return port.wait_for_room(deadline_ns);
}

Result<std::unique_ptr<Port>> open_port(std::string_view bus, const PortOptions& options) {
  if (is_local(bus)) return join_local_bus(bus, options);
  if (bus.starts_with("log:")) return open_log_port(bus, options);
  const bool in_process = bus == "in-process" || bus.starts_with("in-process?");
  if (in_process || bus.empty() || bus.find_first_of(":/ ") != std::string_view::npos) {
    return failure(fmt::format("bus '{}': {}expected a CAN interface such as can0, local:NAME or log:FILE",
                               bus, in_process ? "is not a bus between two programs, " : ""));
  }
  return open_socketcan(bus, options);
}

}  // namespace canhil
