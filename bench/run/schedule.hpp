// Which node transmits next: the one order of transmissions, for real time and for lockstep.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "bench/nodes/node.hpp"

namespace canhil::run {

/// The nodes of a bus in order of precedence: of those due at the same time the earlier one transmits first.
class Schedule {
 public:
  /// `keeper` closes every step, so it comes last among equals.
  Schedule(std::vector<std::unique_ptr<nodes::Node>> sensors, std::unique_ptr<nodes::Node> keeper)
      : nodes_(std::move(sensors)) {
    nodes_.push_back(std::move(keeper));
  }

  /// When the next transmission is due; nodes::never_us after the last one.
  [[nodiscard]] std::int64_t due_us() const { return next().due_us(); }

  /// Takes the next transmission; the frames are valid until the next call.
  std::span<const Frame> take() {
    out_.clear();
    next().transmit(out_);
    return out_.frames();
  }

  /// Counters of the bench's own messages live in the same outbox.
  nodes::Transmission& outbox() { return out_; }

 private:
  [[nodiscard]] nodes::Node& next() const {
    nodes::Node* first = nodes_.front().get();
    for (const auto& node : nodes_) {
      if (node->due_us() < first->due_us()) first = node.get();
    }
    return *first;
  }
  std::vector<std::unique_ptr<nodes::Node>> nodes_;
  nodes::Transmission out_;
};

}  // namespace canhil::run
