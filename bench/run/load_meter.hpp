// How busy the frames of a run keep the bus.
#pragma once

#include "bench/run/link.hpp"
#include "dbc/ports/fd_groups.hpp"
#include "dbc/wire/bit_length.hpp"
#include "messages/canhil.hpp"

namespace canhil::run {

/// Adds up the exact length of every frame, from the bench and from others, by second of the time base: the
/// same on every bus and in virtual time. On CAN FD of the frames on the wire: observers see what containers
/// hold, which packs into the same containers again.
class LoadMeter final : public Observer {
 public:
  explicit LoadMeter(BusFormat format) : format_(format) {}
  void transmitted(const Frame& frame, std::int64_t /*t_ns*/, std::int64_t /*late_ns*/) override {
    if (frame.id == messages::Sync::info.id)
      second_ = static_cast<std::size_t>(from_frame<messages::Sync>(frame).time_us / 1'000'000);
    take(frame, own_);
  }
  void received(const Received& received) override {
    if (!received.own) take(received.frame, others_);
  }
  /// Of each second from time 0 on.
  [[nodiscard]] const std::vector<wire::BitLength>& lengths() const { return lengths_; }

 private:
  void take(const Frame& frame, FdPacker& packer) {
    if (format_ == BusFormat::classic || frame.fd) return add(frame);
    if (const auto due = packer.due_before(frame)) {
      add(*due);
      packer.clear();
    }
    if (const auto full = packer.put(frame)) add(*full);
  }
  void add(const Frame& frame) {
    if (lengths_.size() <= second_) lengths_.resize(second_ + 1);
    lengths_[second_] += wire::bit_length(frame);
  }

  BusFormat format_;
  FdPacker own_, others_;
  std::vector<wire::BitLength> lengths_;
  std::size_t second_ = 0;
};

}  // namespace canhil::run
