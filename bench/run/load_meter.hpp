// How busy the frames of a run keep the bus.
#pragma once

#include "bench/run/link.hpp"
#include "dbc/wire/bit_length.hpp"
#include "messages/canhil.hpp"

namespace canhil::run {

/// Adds up the exact length of every frame, from the bench and from others, by second of the time base: the
/// same on every bus and in virtual time.
class LoadMeter final : public Observer {
 public:
  void transmitted(const Frame& frame, std::int64_t /*t_ns*/, std::int64_t /*late_ns*/) override {
    if (frame.id == messages::Sync::info.id)
      second_ = static_cast<std::size_t>(from_frame<messages::Sync>(frame).time_us / 1'000'000);
    add(frame);
  }
  void received(const Received& received) override {
    if (!received.own) add(received.frame);
  }
  /// Of each second from time 0 on.
  [[nodiscard]] const std::vector<wire::BitLength>& lengths() const { return lengths_; }

 private:
  void add(const Frame& frame) {
    if (lengths_.size() <= second_) lengths_.resize(second_ + 1);
    lengths_[second_] += wire::bit_length(frame);
  }

  std::vector<wire::BitLength> lengths_;
  std::size_t second_ = 0;
};

}  // namespace canhil::run
