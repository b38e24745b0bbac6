// What the nodes of a schedule hear of the bus.
#pragma once

#include "bench/run/link.hpp"
#include "bench/run/schedule.hpp"

namespace canhil::run {

/// Hands every frame of somebody else to the nodes that listen.
class Ears final : public Observer {
 public:
  explicit Ears(Schedule& schedule) : schedule_(schedule) {}
  void received(const Received& received) override {
    if (!received.own && !received.frame.error) schedule_.hear(received.frame);
  }

 private:
  Schedule& schedule_;
};

}  // namespace canhil::run
