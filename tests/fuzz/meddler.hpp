// A bus with a target that may send anything. The target is a Device. The fuzzer's input decides which frames
// of the Device are damaged, dropped, repeated or delayed, and after which frames an additional frame is
// sent. Time is simulated: each frame and each wait advances it.
#pragma once

#include <algorithm>
#include <array>
#include <deque>
#include <limits>
#include <span>
#include <string>

#include "dbc/ports/port.hpp"
#include "dbc/wire/e2e.hpp"
#include "messages/canhil.hpp"
#include "target/device/device.hpp"

namespace canhil::fuzz {

class Meddler final : public Port {
 public:
  explicit Meddler(std::span<const std::uint8_t> script) : script_(script) {
    for (const Frame& frame : device_.idle_heartbeat()) say(frame);
    next_act();
  }

  SendOutcome send(const Frame& frame) override {
    now_ns_ += frame_ns;
    heard_.push_back({.frame = frame, .t_ns = now_ns_, .source = StampSource::hub, .own = true});
    for (const Frame& answer : device_.receive(frame)) answered(answer);
    return SendOutcome::sent;
  }
  std::optional<Received> receive() override {
    if (heard_.empty() || heard_.front().t_ns > now_ns_) return std::nullopt;
    const Received first = heard_.front();
    heard_.pop_front();
    return first;
  }
  bool wait_for_frame(std::int64_t deadline_ns) override {
    const std::int64_t next_ns =
        heard_.empty() ? std::numeric_limits<std::int64_t>::max() : heard_.front().t_ns;
    now_ns_ = std::max(now_ns_, std::min(deadline_ns, next_ns));
    return next_ns <= now_ns_;
  }
  bool wait_for_room(std::int64_t /*deadline_ns*/) override { return true; }
  [[nodiscard]] int descriptor() const override { return -1; }
  [[nodiscard]] RoomWait room_wait() const override { return {}; }
  [[nodiscard]] bool closed() const override { return closed_; }
  [[nodiscard]] PortCounters counters() const override { return {}; }
  [[nodiscard]] Capabilities capabilities() const override {
    return {.reports_errors = true, .time = BusTime::waits, .wire = {.rates = {.nominal = 1'000'000}}};
  }
  [[nodiscard]] int stamp_clock() const override { return CLOCK_MONOTONIC; }
  [[nodiscard]] std::int64_t now_ns() const override { return now_ns_; }
  [[nodiscard]] std::int64_t monotonic_ns() const override { return now_ns_; }
  [[nodiscard]] const std::string& name() const override { return name_; }

 private:
  static constexpr std::int64_t frame_ns = 130'000;

  std::uint8_t byte() {
    if (script_.empty()) return 0;
    const std::uint8_t first = script_.front();
    script_ = script_.subspan(1);
    return first;
  }

  // Reads two bytes of the input: the number of frames before the next act, and the kind of the act. The act
  // itself reads its parameters.
  void next_act() {
    left_ = script_.empty() ? -1 : byte();
    act_ = byte();
  }

  void answered(const Frame& frame) {
    if (left_ != 0) {
      left_ -= left_ > 0 ? 1 : 0;
      return say(frame);
    }
    meddle(frame);
    next_act();
  }

  void say(const Frame& frame, std::int64_t late_ns = 0) {
    now_ns_ += frame_ns;
    const std::int64_t t_ns = std::max(now_ns_ + late_ns, heard_.empty() ? 0 : heard_.back().t_ns);
    heard_.push_back({.frame = frame, .t_ns = t_ns, .source = StampSource::hub});
  }

  static void protect(Frame& frame) {
    const auto* message = messages::find_message(frame.id);
    if (message != nullptr && frame.size == message->size)
      e2e::protect({frame.data.data(), frame.size}, message->e2e_data_id, frame.data[1] & 0x0FU);
  }

  void meddle(Frame frame) {
    switch (act_ % 10) {
      case 0:  // the frame is lost
        return;
      case 1:  // one byte is changed, with a valid checksum (1) or without (2)
      case 2: {
        const std::size_t place = 1 + byte() % 7;
        frame.data[place] ^= byte();
        if (act_ % 10 == 1) protect(frame);
        return say(frame);
      }
      case 3:  // all bytes of the signals get the same value
        std::fill(frame.data.begin() + 2, frame.data.begin() + 8, byte());
        protect(frame);
        return say(frame);
      case 4:
        say(frame);
        return say(frame);
      case 5:
        return say(frame, std::int64_t{byte()} * 1'000'000);
      case 6: {  // an additional frame with any message of the DBC
        say(frame);
        const MessageInfo& message = messages::all_messages[byte() % messages::all_messages.size()];
        Frame other{.id = message.id, .size = message.size};
        for (std::size_t i = 1; i < 8; ++i) other.data[i] = byte();
        if (act_ < 200) protect(other);
        return say(other);
      }
      case 7:  // an additional frame with any id, which need not be in the DBC
        say(frame);
        frame.error = (act_ & 0x10U) != 0;
        frame.extended = (act_ & 0x20U) != 0;
        frame.id = byte() * 8U;
        frame.size = static_cast<std::uint8_t>(byte() % 9);
        return say(frame);
      case 8:  // the target is silent for a while
        left_ = byte();
        now_ns_ += std::int64_t{byte()} * 2'000'000;
        return;
      case 9:
        say(frame);
        closed_ = act_ > 240;
        return;
    }
  }

  target::Device device_;
  std::span<const std::uint8_t> script_;
  std::deque<Received> heard_;
  std::int64_t now_ns_ = 1'000'000'000;
  int left_ = -1;
  std::uint8_t act_ = 0;
  bool closed_ = false;
  std::string name_ = "meddler";
};

}  // namespace canhil::fuzz
