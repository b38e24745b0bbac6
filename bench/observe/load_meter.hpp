// Measures the bus load of a run's frames.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "bench/observe/observer.hpp"
#include "dbc/ports/fd_groups.hpp"
#include "dbc/wire/bit_length.hpp"
#include "messages/canhil.hpp"

namespace canhil::observe {

/// How a frame is assigned to a second, and which frames are counted.
enum class LoadBy : std::uint8_t {
  time_base,        ///< by the time in the last Sync; gives the same load on every bus and in virtual time
  time_base_alone,  ///< as time_base, but without StepDone, which exists only in lockstep: the load that the
                    ///< run would cause in real time
  virtual_time,     ///< by the second of virtual time, if no node sends Sync
  stamps  ///< by the second of the frame's stamp, counted from the first stamp: a frame that is still queued
          ///< does not count
};

/// Adds up the exact length of every frame, sent by the bench or by others, for each second. On CAN FD,
/// observers receive the messages of a container one by one. The meter packs them into the same containers
/// again, because it counts frames on the wire.
class LoadMeter final : public Observer {
 public:
  LoadMeter(BusFormat format, LoadBy by) : format_(format), by_(by) {}
  void transmitted(const Frame& frame, std::int64_t /*t_ns*/, std::int64_t /*late_ns*/) override {
    if (by_ == LoadBy::stamps) return;  // the echo of this frame is counted instead
    if (by_ != LoadBy::virtual_time && frame.id == messages::Sync::info.id)
      second_ = static_cast<std::size_t>(from_frame<messages::Sync>(frame).time_us / 1'000'000);
    take(frame, own_);
  }
  void received(const Received& received) override {
    if (received.frame.error) return;
    if (by_ == LoadBy::time_base_alone && received.frame.id == messages::StepDone::info.id) return;
    if (by_ == LoadBy::stamps) {
      if (!first_ns_) first_ns_ = received.t_ns;
      const std::int64_t elapsed_ns = std::max<std::int64_t>(0, received.t_ns - *first_ns_);
      second_ = static_cast<std::size_t>(elapsed_ns / 1'000'000'000);
    }
    if (by_ == LoadBy::stamps || !received.own) take(received.frame, received.own ? own_ : others_);
  }
  void time_set(std::int64_t t_ns) override {
    if (by_ == LoadBy::virtual_time) second_ = static_cast<std::size_t>(t_ns / 1'000'000'000);
  }
  /// The total length of all frames of each second, from time 0 on.
  [[nodiscard]] const std::vector<wire::BitLength>& lengths() const { return lengths_; }
  /// If the mean load so far is at least 90 %: a phrase that explains why nothing is received; otherwise
  /// empty.
  [[nodiscard]] std::string full_wire(std::int64_t now_ns, const wire::BitRates& rates) const {
    constexpr double full = 0.9;
    if (rates.nominal == 0 || now_ns <= 0) return {};
    wire::BitLength all;
    for (const wire::BitLength& length : lengths_) all += length;
    const double load = wire::bus_load(all, static_cast<double>(now_ns) * 1e-9, rates);
    if (load < full) return {};
    return fmt::format(" (the wire of {:g} kbit/s is full: load {:.0f} %)",
                       static_cast<double>(rates.nominal) * 1e-3, load * 100);
  }

 private:
  void take(const Frame& frame, FdPacker& packer) {
    if (format_ == BusFormat::classic || frame.fd) return add(frame);
    packer.pack(frame, [&](const Frame& on_wire) { add(on_wire); });
  }
  void add(const Frame& frame) {
    if (lengths_.size() <= second_) lengths_.resize(second_ + 1);
    lengths_[second_] += wire::bit_length(frame);
  }

  BusFormat format_;
  LoadBy by_;
  std::optional<std::int64_t> first_ns_;
  FdPacker own_, others_;
  std::vector<wire::BitLength> lengths_;
  std::size_t second_ = 0;
};

}  // namespace canhil::observe
