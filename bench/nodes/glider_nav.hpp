// The GPS/INS of the glider.
#pragma once

#include "bench/nodes/node.hpp"
#include "bench/scenario/glider_nav.hpp"
#include "bench/world/correlated_noise.hpp"
#include "bench/world/glide/glide.hpp"

namespace canhil::nodes {

/// Sends the group GliderNav: ground velocity, attitude, rates and height, with their time of validity. The
/// record must outlive the node.
class GliderNav final : public Node {
 public:
  /// The run may end before the record does.
  GliderNav(const world::GlideRecord& glide, const scenario::GliderNav& config, world::Stream stream,
            world::Stream losses, std::int64_t end_us);

  [[nodiscard]] std::int64_t due_us() const override { return sampling_.due_us(); }
  void transmit(Transmission& out) override;

 private:
  const world::GlideRecord& glide_;
  scenario::GliderNav config_;
  world::Stream stream_;
  world::Stream losses_;
  double period_s_;
  Sampling sampling_;
  world::CorrelatedNoise velocity_;
  world::CorrelatedNoise rates_;
  world::CorrelatedNoise attitude_;
};

}  // namespace canhil::nodes
