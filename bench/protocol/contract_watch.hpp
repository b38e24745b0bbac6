// Watches a target that uses canhil's own DBC. Any message of the target shows that the target is present.
// The heartbeat tells whether the target has a fault. StepDone tells that the target has finished the step
// that Sync closed.
#pragma once

#include <cstdint>
#include <utility>

#include "bench/observe/target_watch.hpp"
#include "bench/protocol/second_target.hpp"
#include "messages/canhil.hpp"

namespace canhil::protocol {

class ContractWatch final : public observe::TargetWatch {
 public:
  /// `alone`: no other node can be on the bus, so there is no check for a second target.
  explicit ContractWatch(bool alone = false) : alone_(alone) {}

  void transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) override {
    if (!alone_) second_.transmitted(frame, t_ns, late_ns);
  }
  void received(const Received& received) override;
  bool heard() override { return std::exchange(heard_, false); }
  [[nodiscard]] std::optional<std::string> fault() const override;
  bool closes_step(const Frame& frame) override;
  [[nodiscard]] bool step_done() const override { return done_; }
  [[nodiscard]] std::string step() const override;

 private:
  bool alone_;
  bool heard_ = false, done_ = false;
  std::uint16_t awaited_ = 0;
  std::optional<messages::TargetHeartbeat> fault_;  // the heartbeat that reported the fault
  SecondTarget second_;
};

}  // namespace canhil::protocol
