// The vehicle's GPS receiver.
#pragma once

#include "bench/nodes/fix_faults.hpp"
#include "bench/nodes/node.hpp"
#include "bench/scenario/gps.hpp"
#include "bench/world/flight_record.hpp"

namespace canhil::nodes {

/// Sends the group Gps; under water it says that it has no fix. The record must outlive the node.
class Gps final : public Node {
 public:
  Gps(const world::FlightRecord& flight, const scenario::Gps& config, world::Stream stream);

  [[nodiscard]] std::int64_t due_us() const override { return sampling_.due_us(); }
  void transmit(Transmission& out) override;

 private:
  const world::FlightRecord& flight_;
  scenario::Gps config_;
  world::Stream stream_;
  world::Vector3 bias_;
  Sampling sampling_;
};

}  // namespace canhil::nodes
