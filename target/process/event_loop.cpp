#include "target/process/event_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "dbc/ports/several.hpp"
#include "dbc/text/escape.hpp"
#include "target/device/device.hpp"
#include "target/process/bus_notes.hpp"
#include "target/process/timing_window.hpp"

namespace canhil::target {
namespace {

constexpr std::int64_t period_ns = messages::TargetHeartbeat::info.cycle_time_us * 1000;
constexpr std::int64_t bench_silent_ns = 2 * period_ns;
constexpr std::int64_t bench_gone_ns = 2'000'000'000;
constexpr std::int64_t send_patience_ns = 50'000'000;
constexpr int looks_every = 16;  // the largest number of waits between two readings of the clock
// While frames keep coming, the target reads its clock at the latest after this many frames.
constexpr int most_at_once = 256;

std::int64_t now_ns() { return clock_ns(CLOCK_MONOTONIC); }

// Both a command and a Sync show that a bench is active. If only Sync frames were taken into account, the
// process would send an idle heartbeat between the command `start` and the first Sync. A replay would not
// contain this heartbeat.
bool from_bench(const Frame& frame) {
  return !frame.extended &&
         (frame.id == messages::Sync::info.id || frame.id == messages::TargetCommand::info.id);
}

// Sends frames in order. Drops a frame if the transmit queue stays full until the deadline
// (send_patience_ns), or if the interface is down. Counts the dropped frames; the receiver detects their loss
// by the E2E counters.
void send(Port& port, std::span<const Frame> frames, BusNotes& notes) {
  std::int64_t deadline_ns = 0;  // set when the queue is first full
  for (const Frame& frame : frames.subspan(port.send_all(frames))) {
    SendOutcome outcome = port.send(frame);
    while (outcome == SendOutcome::queue_full) {
      if (deadline_ns == 0) deadline_ns = now_ns() + send_patience_ns;
      if (!wait(port, WaitFor::room, deadline_ns)) break;
      outcome = port.send(frame);
    }
    if (outcome == SendOutcome::queue_full) notes.late_in_queue();
    if (outcome == SendOutcome::down) notes.met_interface_down();
  }
}

void print(const std::string& news) {
  for (std::size_t begin = 0; begin < news.size();) {
    const std::size_t end = news.find('\n', begin);
    std::fprintf(stderr, "hil-target: %s\n", one_line(news.substr(begin, end - begin)).c_str());
    begin = end + 1;
  }
}

}  // namespace

Result<void> serve(const std::vector<std::string>& buses, BusFormat format, const std::atomic<bool>& stop) {
  PortOptions options;
  options.node_name = "hil-target";
  options.foreign = true;
  auto opened = open_buses(buses, options, format);
  if (!opened) return tl::unexpected(opened.error());
  return serve(**opened, format, stop);
}

Result<void> serve(Port& port, BusFormat format, const std::atomic<bool>& stop) {
  Device device;
  TimingWindow window;
  BusNotes notes;
  Outbox<1> reports;
  // The last time at which the bench sent Sync or a command; this time is updated only when a report is due.
  std::int64_t bench_ns = now_ns() - bench_silent_ns;
  // Before it sends its first frame, a target listens for longer than a heartbeat period, to detect another
  // target: two targets on one bus would corrupt each other's groups.
  std::int64_t report_due_ns = now_ns() + period_ns + period_ns / 4;
  bool established = false;
  bool bench_heard = false;  // since the last report
  bool heard = false;        // the last wait brought a frame
  int unlooked = 0;          // waits since the clock was read

  while (!stop && !port.closed()) {
    bool more = true;  // frames may be waiting
    for (int looked_at = 0; looked_at < most_at_once && !stop; ++looked_at) {
      const auto received = port.receive();
      more = received.has_value();
      if (!more) break;
      if (received->foreign) continue;  // the port counts foreign frames
      if (received->frame.error) {
        notes.error_frame(received->frame);
        continue;
      }
      if (!established) {
        const bool heartbeat =
            received->frame.id == messages::TargetHeartbeat::info.id && !received->frame.extended;
        if (!heartbeat) continue;
        return failure(
            fmt::format("bus '{}': a target answers here already, expected to be the only one", port.name()));
      }
      const std::int64_t start_ns = clock_ns(port.stamp_clock());
      const std::span<const Frame> answers = device.receive(received->frame);
      const bool of_bench = from_bench(received->frame);
      bench_heard = bench_heard || of_bench;
      if (!answers.empty()) {
        const std::int64_t end_ns = clock_ns(port.stamp_clock());
        send(port, answers, notes);
        if (!of_bench) window.add(start_ns - received->t_ns, end_ns - start_ns);
      }
    }
    notes.interface_is(port.up());
    // Reading the clock costs time. If the last wait brought no frame, the report may be due; while frames
    // keep coming, the clock is read only after looks_every waits or most_at_once frames.
    const bool look = !heard || more || ++unlooked >= looks_every;
    const std::int64_t now = look ? now_ns() : 0;
    if (look) unlooked = 0;
    if (now >= report_due_ns) {
      report_due_ns = now + period_ns;
      if (std::exchange(bench_heard, false)) bench_ns = now;
      print(notes.news(port, format));
      established = true;
      // While Sync arrives, the device sends the heartbeats that are due. During a run the process adds no
      // heartbeats, even if the bench is slow, so that the frames equal those of a replay. After the bench
      // has disappeared, the process sends heartbeats, so that the next bench finds the target.
      const std::int64_t patience_ns = device.running() ? bench_gone_ns : bench_silent_ns;
      if (now - bench_ns >= patience_ns) {
        send(port, device.idle_heartbeat(), notes);
      } else if (!device.lockstep()) {
        reports.clear();
        reports.send(window.take());
        send(port, reports.frames(), notes);
      }
    }
    // The port may already have read further frames from the bus. wait() would not return for these frames,
    // so wait() is called only if no frames are left.
    heard = more || wait(port, WaitFor::frame, report_due_ns);
  }
  print(notes.news(port, format));
  return {};
}

}  // namespace canhil::target
