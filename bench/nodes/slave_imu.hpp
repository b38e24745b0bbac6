// The IMU of the weapon to be aligned: exact increments, its errors, and what the bus makes of them.
#pragma once

#include "bench/nodes/increment_rounding.hpp"
#include "bench/nodes/node.hpp"
#include "bench/scenario/slave_imu.hpp"
#include "bench/world/flight_record.hpp"
#include "bench/world/imu_errors.hpp"

namespace canhil::nodes {

/// Sends the group SlaveImu at every epoch of the flight record; the record must outlive the node. Losses
/// have numbers of their own, so that they change no measurement.
class SlaveImu final : public Node {
 public:
  SlaveImu(const world::FlightRecord& flight, const scenario::SlaveImu& config, world::Stream stream,
           world::Stream losses);

  [[nodiscard]] std::int64_t due_us() const override { return sampling_.due_us(); }
  void transmit(Transmission& out) override;

  /// Errors that this run drew: for the truth of the biases.
  [[nodiscard]] const world::ErroneousImu& errors() const { return imu_; }

 private:
  const world::FlightRecord& flight_;
  world::ErroneousImu imu_;
  world::Stream losses_;
  double loss_probability_;
  Sampling sampling_;
  std::size_t next_ = 0;
  IncrementRounding theta_rounding_;
  IncrementRounding velocity_rounding_;
};

}  // namespace canhil::nodes
