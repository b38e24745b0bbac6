// The simulated wire of an embedded bus in real time, on CLOCK_MONOTONIC.
#pragma once

#include <cstdint>
#include <optional>

#include "dbc/ports/timer.hpp"
#include "dbc/ports/wire_settings.hpp"

namespace canhil::local {

class HubWire {
 public:
  /// Adds two nodes to the wire: that of the hub, and a node that only acknowledges, so that frames can be
  /// sent even if the bus has no other nodes.
  explicit HubWire(const WireSettings& settings);

  static constexpr std::size_t host = 0;
  std::size_t add_node() { return wire_.add_node({.order = settings_.order, .reports_errors = true}); }
  [[nodiscard]] WireFacts facts() const { return settings_.facts(); }
  /// False if the queue of the node is full, or if the node is bus-off.
  [[nodiscard]] bool has_room(std::size_t node) const;
  /// The longest duration of a classic frame of 8 bytes.
  [[nodiscard]] std::int64_t frame_ns() const { return frame_ns_; }
  /// Puts a frame into the queue of a node, with the current time. False: the queue has no room.
  bool queue(std::size_t node, const Frame& frame);
  /// The next frame whose transmission has ended by now; nullopt: there is none.
  std::optional<Carried> next();
  /// The next report of the controller of a node; nullopt: there is none. The report is older than all frames
  /// that later calls of next() return.
  std::optional<WireReport> report() { return wire_.report(); }
  [[nodiscard]] bool has_report() const { return wire_.has_report(); }

  /// A descriptor for poll(). It becomes readable when next() must be called, if set_alarm() has been called.
  [[nodiscard]] int descriptor() const { return timer_.descriptor(); }
  void set_alarm();
  void stop_alarm();

 private:
  WireSettings settings_;
  std::int64_t frame_ns_;
  SimulatedWire wire_;
  Timer timer_;
};

}  // namespace canhil::local
