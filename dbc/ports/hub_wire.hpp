// The simulated wire of an embedded bus in real time, on CLOCK_MONOTONIC.
#pragma once

#include <cstdint>
#include <optional>

#include "dbc/ports/timer.hpp"
#include "dbc/ports/wire_settings.hpp"

namespace canhil::local {

class HubWire {
 public:
  /// Adds the hub's own node and one that only acknowledges, so that frames pass on a bus without other
  /// nodes.
  explicit HubWire(const WireSettings& settings);

  static constexpr std::size_t host = 0;
  std::size_t add_node() { return wire_.add_node({.order = settings_.order, .reports_errors = true}); }
  [[nodiscard]] WireFacts facts() const { return settings_.facts(); }
  /// False while the queue of a node is full, or the node is off the bus.
  [[nodiscard]] bool has_room(std::size_t node) const;
  /// The longest duration of a full classic frame.
  [[nodiscard]] std::int64_t frame_ns() const { return frame_ns_; }
  /// Puts a frame into the queue of a node, with the current time. False: no room.
  bool queue(std::size_t node, const Frame& frame);
  /// The next frame that has been sent by now.
  std::optional<Carried> next();
  /// The next report of a node's controller. It precedes all frames that next() returns later.
  std::optional<WireReport> report() { return wire_.report(); }
  [[nodiscard]] bool has_report() const { return wire_.has_report(); }

  /// Becomes readable when next() has something to do; armed by set_alarm().
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
