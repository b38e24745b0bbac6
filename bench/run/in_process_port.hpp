// A Device held directly: the bus without a bus.
#pragma once

#include <deque>
#include <string>

#include "dbc/ports/port.hpp"
#include "target/device/device.hpp"

namespace canhil::run {

/// A port whose other end is a Device in this process: send() runs the device, receive() gives its answers.
class InProcessPort final : public Port {
 public:
  InProcessPort() { append(device_.idle_heartbeat()); }

  SendOutcome send(const Frame& frame) override {
    append(device_.receive(frame));
    ++counters_.sent;
    return SendOutcome::sent;
  }
  std::optional<Received> receive() override {
    if (answers_.empty()) return std::nullopt;
    Received received{
        .frame = answers_.front(), .t_ns = 0, .source = StampSource::virtual_time, .own = false};
    answers_.pop_front();
    ++counters_.received;
    return received;
  }
  [[nodiscard]] int descriptor() const override { return -1; }
  [[nodiscard]] RoomWait room_wait() const override { return {}; }
  [[nodiscard]] bool closed() const override { return false; }
  [[nodiscard]] PortCounters counters() const override { return counters_; }
  [[nodiscard]] int stamp_clock() const override { return CLOCK_MONOTONIC; }
  [[nodiscard]] const std::string& name() const override { return name_; }

 private:
  void append(std::span<const Frame> frames) {
    answers_.insert(answers_.end(), frames.begin(), frames.end());
  }

  target::Device device_;
  std::deque<Frame> answers_;
  PortCounters counters_;
  std::string name_ = "in-process";
};

}  // namespace canhil::run
