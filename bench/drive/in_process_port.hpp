// A port without a bus: it calls a Device directly.
#pragma once

#include <string>
#include <vector>

#include "bench/drive/buses.hpp"
#include "dbc/ports/port.hpp"
#include "target/device/device.hpp"

namespace canhil::drive {

/// A port whose other end is a Device in this process: send() runs the device, receive() returns its answers.
/// The host's clock is not used: every stamp is the virtual time that set_time() set last.
class InProcessPort final : public Port {
 public:
  explicit InProcessPort(Rounding rounding)
      : device_(rounding),
        rounding_(rounding),
        name_(rounding == Rounding::none ? unrounded_bus : in_process_bus) {
    append(device_.idle_heartbeat());
  }

  SendOutcome send(const Frame& frame) override {
    append(device_.receive(frame));
    ++counters_.sent;
    return SendOutcome::sent;
  }
  std::optional<Received> receive() override {
    if (next_ == answers_.size()) {
      answers_.clear();
      next_ = 0;
      return std::nullopt;
    }
    ++counters_.received;
    return Received{.frame = answers_[next_++], .t_ns = now_ns_, .source = StampSource::virtual_time};
  }
  /// Every frame that can be received has already arrived during send().
  bool wait_for_frame(std::int64_t /*deadline_ns*/) override { return true; }
  [[nodiscard]] int descriptor() const override { return -1; }
  [[nodiscard]] RoomWait room_wait() const override { return {}; }
  [[nodiscard]] bool closed() const override { return false; }
  [[nodiscard]] PortCounters counters() const override { return counters_; }
  [[nodiscard]] Capabilities capabilities() const override {
    return {.in_process = true, .time = BusTime::set, .rounding = rounding_};
  }
  [[nodiscard]] int stamp_clock() const override { return CLOCK_MONOTONIC; }
  [[nodiscard]] std::int64_t now_ns() const override { return now_ns_; }
  void set_time(std::int64_t t_ns) override { now_ns_ = t_ns; }
  [[nodiscard]] const std::string& name() const override { return name_; }

 private:
  void append(std::span<const Frame> frames) {
    for (const Frame& frame : frames) answers_.push_back(frame);  // usually none or three
  }

  target::Device device_;
  Rounding rounding_;
  std::vector<Frame> answers_;
  std::size_t next_ = 0;  // index of the first answer that has not been received
  std::int64_t now_ns_ = 0;
  PortCounters counters_;
  std::string name_;
};

}  // namespace canhil::drive
