#include "bench/doctor/loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <ctime>

#include "bench/checks/timing.hpp"
#include "messages/canhil.hpp"

namespace canhil::doctor {
namespace {

constexpr std::int64_t patience_ns = 100'000'000;  // the duration of about a thousand frames at 1 Mbit/s
constexpr std::uint8_t classic_size = 8;
// If the near port hosts an embedded bus, other nodes can join only while the near port receives.
constexpr int settling_looks = 10;
constexpr int hopeless = 10;  // so many lost frames in a row mean that there is no connection
constexpr std::uint32_t least_urgent_id = 0x7EF;  // CAN 2.0 A did not allow higher ids
constexpr double good_p99_s = 1e-3;               // for comparison: two frames at 500 kbit/s take 0.5 ms
constexpr double weak_p99_s = 10e-3;              // USB adapters add a few milliseconds each way

// The `nth` id that the DBC does not use, counted downwards from least_urgent_id. nth = 0 is the first.
std::uint32_t free_id(int nth) {
  std::uint32_t id = least_urgent_id + 1;
  do {
    --id;
    if (messages::find_message(id) == nullptr) --nth;
  } while (nth >= 0);
  return id;
}

bool send(Port& port, const Frame& frame, std::int64_t deadline_ns) {
  for (;;) {
    const SendOutcome outcome = port.send(frame);
    if (outcome != SendOutcome::queue_full) return outcome == SendOutcome::sent;
    if (clock_ns(CLOCK_MONOTONIC) >= deadline_ns) return false;
    wait(port, WaitFor::room, deadline_ns);
  }
}

// Waits until a frame with the same id and data as `frame` arrives; nullopt: the deadline passed first.
std::optional<Received> await(Port& port, const Frame& frame, std::int64_t deadline_ns) {
  while (clock_ns(CLOCK_MONOTONIC) < deadline_ns && !port.closed()) {
    const auto received = port.receive();
    if (!received) {
      wait(port, WaitFor::frame, deadline_ns);
    } else if (!received->own && !received->frame.error && received->frame.id == frame.id &&
               received->frame.data == frame.data) {
      return received;
    }
  }
  return std::nullopt;
}

}  // namespace

LoopResult measure_loop(Port& near, Port& far, int frames, const std::function<bool()>& stop) {
  for (int look = 0; look < settling_looks; ++look) near.receive();
  LoopResult result;
  Frame there{.id = free_id(0), .size = classic_size};
  Frame back{.id = free_id(1), .size = classic_size};
  int lost_in_a_row = 0;
  while (result.sent < frames && lost_in_a_row < hopeless && !stop()) {
    std::memcpy(there.data.data(), &result.sent, sizeof result.sent);
    back.data = there.data;
    ++result.sent;
    const std::int64_t start_ns = clock_ns(CLOCK_MONOTONIC);
    const std::int64_t deadline_ns = start_ns + patience_ns;
    const bool across =
        send(near, there, deadline_ns) && await(far, there, deadline_ns) && send(far, back, deadline_ns);
    const auto answer = across ? await(near, back, deadline_ns) : std::nullopt;
    if (!answer) {
      ++result.lost;
      ++lost_in_a_row;
      continue;
    }
    lost_in_a_row = 0;
    result.source = answer->source;
    result.round_trip_s.push_back(static_cast<double>(clock_ns(CLOCK_MONOTONIC) - start_ns) * 1e-9);
  }
  return result;
}

Line loop_line(const LoopResult& result, const std::string& near, const std::string& far) {
  const std::string way = fmt::format("{} to {} and back", near, far);
  if (result.sent == 0) return {Grade::weak, "loop", way + ": not measured", "let it run to its end"};
  if (result.round_trip_s.empty())
    return {Grade::bad, "loop", fmt::format("{}: none of {} frames came back", way, result.sent),
            "connect both to one bus with the same bit rate and 60 ohm between CAN high and low"};
  const checks::Distribution d = checks::distribution(result.round_trip_s);
  const std::string found = fmt::format("{}: p50 {:.3f} p99 {:.3f} max {:.3f} ms, {} of {} frames lost", way,
                                        d.p50 * 1e3, d.p99 * 1e3, d.max * 1e3, result.lost, result.sent);
  if (result.lost > 0)
    return {Grade::bad, "loop", found, "look at wiring, termination, bit rate and the error counters above"};
  if (d.p99 <= good_p99_s) return {Grade::good, "loop", found};
  return {d.p99 <= weak_p99_s ? Grade::weak : Grade::bad, "loop", found,
          "an adapter on PCIe or SPI instead of USB, --realtime, nothing else at work"};
}

}  // namespace canhil::doctor
