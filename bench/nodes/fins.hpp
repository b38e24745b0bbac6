// The fin actuators of the glider.
#pragma once

#include "bench/nodes/node.hpp"
#include "bench/scenario/fins.hpp"
#include "bench/world/glide/glide.hpp"

namespace canhil::nodes {

/// Sends FinDeflections: what the fins stood at, and when. The record must outlive the node.
class Fins final : public Node {
 public:
  /// The run may end before the record does.
  Fins(const world::GlideRecord& glide, const scenario::Fins& config, world::Stream losses,
       std::int64_t end_us);

  [[nodiscard]] std::int64_t due_us() const override { return sampling_.due_us(); }
  void transmit(Transmission& out) override;

 private:
  const world::GlideRecord& glide_;
  scenario::Fins config_;
  world::Stream losses_;
  Sampling sampling_;
};

}  // namespace canhil::nodes
