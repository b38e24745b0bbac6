// The bench's own node: the time base.
#pragma once

#include "bench/nodes/node.hpp"

namespace canhil::nodes {

/// Sends Sync at the DBC's cycle time. The first Sync is at time 0. The last Sync is due at the first time at
/// or after `end_us`; it ends the run. In lockstep each Sync ends a step.
class TimeKeeper final : public Node {
 public:
  TimeKeeper(std::int64_t end_us, bool lockstep) : end_us_(end_us), lockstep_(lockstep) {}

  [[nodiscard]] std::int64_t due_us() const override {
    return t_us_ - period_us >= end_us_ ? never_us : t_us_;
  }
  void transmit(Transmission& out) override {
    out.send(messages::Sync{.time_us = static_cast<std::uint64_t>(t_us_),
                            .step = static_cast<std::uint16_t>(step_ % step_period),
                            .lockstep = static_cast<std::uint8_t>(lockstep_)});
    t_us_ += period_us;
    ++step_;
  }

 private:
  static constexpr std::int64_t period_us = messages::Sync::info.cycle_time_us;
  static constexpr std::uint64_t step_period = 2048;  // 11 bits
  std::int64_t end_us_;
  bool lockstep_;
  std::int64_t t_us_ = 0;
  std::uint64_t step_ = 0;
};

}  // namespace canhil::nodes
