// The carrier's INS.
#pragma once

#include "bench/nodes/node.hpp"
#include "bench/scenario/master_ins.hpp"
#include "bench/world/flight_record.hpp"
#include "bench/world/navigation_errors.hpp"

namespace canhil::nodes {

/// Sends the group MasterIns: the truth of the flight record with the errors of a navigation system. The
/// record must outlive the node. Losses have numbers of their own, so that they change no measurement.
class MasterIns final : public Node {
 public:
  MasterIns(const world::FlightRecord& flight, const scenario::MasterIns& config, world::Stream stream,
            world::Stream losses);

  [[nodiscard]] std::int64_t due_us() const override { return sampling_.due_us(); }
  void transmit(Transmission& out) override;

 private:
  const world::FlightRecord& flight_;
  world::NavigationErrorModel errors_;
  scenario::SampleLoss loss_;
  world::Stream stream_;
  world::Stream losses_;
  Sampling sampling_;
};

}  // namespace canhil::nodes
