// A node that sends a sample group every period.
#pragma once

#include "bench/nodes/kind.hpp"

namespace canhil::nodes {

/// Sends sample k, which is valid at k * period, one latency after this time. No sample is sent after the end
/// of the run, because an answer after the last Sync would not be observed. `Settings`: the settings of the
/// node's table.
template <class Settings>
class Sampler : public Node {
 public:
  Sampler(const NodeSettings& node, const Run& run)
      : config_(*node.own<Settings>()),
        run_(run),
        period_us_(node.period_us()),
        latency_us_(node.latency_us()),
        valid_us_(period_us_) {}

  [[nodiscard]] std::int64_t due_us() const final {
    const std::int64_t due_us = valid_us_ + latency_us_;
    return due_us > run_.flight.end_us() ? never_us : due_us;
  }
  void transmit(Transmission& out) final {
    if (!sample(valid_us_, out)) out.clear();  // the counter advances, so the receiver detects the gap
    valid_us_ += period_us_;
  }

 protected:
  const Settings config_;
  const Run run_;

 private:
  /// Appends the sample group that is valid at `valid_us`. Returns false if the group is lost.
  virtual bool sample(std::int64_t valid_us, Transmission& out) = 0;

  std::int64_t period_us_;
  std::int64_t latency_us_;
  std::int64_t valid_us_;
};

}  // namespace canhil::nodes
