// Acoustic positioning from a moving reference ship.
#pragma once

#include "bench/nodes/fix_faults.hpp"
#include "bench/nodes/node.hpp"
#include "bench/scenario/ssbl.hpp"
#include "bench/world/flight_record.hpp"

namespace canhil::nodes {

/// Sends the group Ssbl: where the vehicle is w.r.t. the ship, and where the ship says that it is. The record
/// must outlive the node.
class Ssbl final : public Node {
 public:
  Ssbl(const world::FlightRecord& flight, const scenario::Ssbl& config, world::Stream stream);

  [[nodiscard]] std::int64_t due_us() const override { return sampling_.due_us(); }
  void transmit(Transmission& out) override;

  /// The constant error of this run's fixes, ship and SSBL together, NED [m].
  [[nodiscard]] world::Vector3 constant_error() const { return ship_error_ + bias_; }

 private:
  const world::FlightRecord& flight_;
  scenario::Ssbl config_;
  world::Stream stream_;
  world::Vector3 ship_error_;
  world::Vector3 bias_;
  Sampling sampling_;
};

}  // namespace canhil::nodes
