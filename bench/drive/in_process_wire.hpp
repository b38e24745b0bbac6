// A Device behind a simulated CAN wire, in virtual time. The frames have the same times as in a real-time run
// on a bus of this bit rate, if the target of that run computed infinitely fast.
#pragma once

#include <deque>
#include <string>

#include "dbc/ports/fd_groups.hpp"
#include "dbc/ports/port.hpp"
#include "dbc/ports/wire_settings.hpp"
#include "target/device/device.hpp"

namespace canhil::drive {

/// The bench's port on the simulated wire. Time begins at 0 and advances only while the bench waits, from one
/// event on the wire to the next. Therefore the same frames give the same bits and stamps, whatever the host
/// does. A stamp is the time at which the frame ends on the wire, also for the bench's own frames; the device
/// sends an answer when the stimulus ends on the wire.
class InProcessWire final : public Port {
 public:
  /// `format` selects the DBC, which defines the layout of the frames on the wire.
  InProcessWire(std::string name, const WireSettings& settings, BusFormat format);

  SendOutcome send(const Frame& frame) override;
  std::optional<Received> receive() override;
  bool wait_for_frame(std::int64_t deadline_ns) override;
  bool wait_for_room(std::int64_t deadline_ns) override;
  [[nodiscard]] int descriptor() const override { return -1; }
  [[nodiscard]] RoomWait room_wait() const override { return {}; }
  [[nodiscard]] bool closed() const override { return false; }
  [[nodiscard]] PortCounters counters() const override { return counters_; }
  [[nodiscard]] Capabilities capabilities() const override {
    return {.reports_errors = true, .in_process = true, .time = BusTime::waits, .wire = facts_};
  }
  [[nodiscard]] int stamp_clock() const override { return CLOCK_MONOTONIC; }
  [[nodiscard]] std::int64_t now_ns() const override { return now_ns_; }
  [[nodiscard]] std::int64_t monotonic_ns() const override { return now_ns_; }
  [[nodiscard]] const std::string& name() const override { return name_; }

 private:
  static constexpr std::size_t bench = 0, device = 1;

  [[nodiscard]] std::int64_t next_event_ns() const;
  void pass(std::int64_t until_ns);
  void arrive(const Carried& carried);
  void put(std::span<const Frame> answers, std::int64_t t_ns);
  void queue(const Frame& frame, std::int64_t t_ns);
  void queue_waiting();
  void give(const Frame& frame, std::int64_t t_ns, bool own);

  std::string name_;
  bool fd_;
  WireFacts facts_;
  SimulatedWire wire_;
  target::Device device_;
  FdPacker packer_;            // packs the device's frames
  std::deque<Frame> waiting_;  // frames of the device that wait for room on the wire
  std::int64_t now_ns_ = 0;
  std::int64_t idle_heartbeat_due_ns_ = 0;  // used until the first frame of the bench has arrived
  std::deque<Received> ready_;
  PortCounters counters_;
};

}  // namespace canhil::drive
