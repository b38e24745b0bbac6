// Which node transmits next: the one order of transmissions, for real time and for lockstep.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "bench/drive/frame_faults.hpp"
#include "bench/drive/link.hpp"
#include "bench/nodes/node.hpp"

namespace canhil::drive {

/// The nodes of a bus in order of precedence: of those due at the same time the earlier one transmits first.
class Schedule final : public observe::Observer {
 public:
  /// `keeper` closes every step, so it comes last among equals.
  Schedule(std::vector<std::unique_ptr<nodes::Node>> sensors, std::unique_ptr<nodes::Node> keeper,
           Rounding rounding = Rounding::as_on_the_bus, FrameFaults faults = {})
      : nodes_(std::move(sensors)), out_(rounding), faults_(std::move(faults)) {
    nodes_.push_back(std::move(keeper));
    for (const auto& node : nodes_) {
      due_us_.push_back(node->due_us());
      if (node->listens()) listeners_.push_back(node.get());
    }
    find_next();
  }

  /// When the next transmission is due; nodes::never_us after the last one.
  [[nodiscard]] std::int64_t due_us() const { return due_us_[next_]; }

  /// Takes the next transmission; the frames are valid until the next call.
  std::span<const Frame> take() {
    out_.clear();
    nodes_[next_]->transmit(out_);
    const std::int64_t t_us = due_us_[next_];
    due_us_[next_] = nodes_[next_]->due_us();
    find_next();
    return faults_.befall(out_.frames(), t_us);
  }

  /// Whether any node does.
  [[nodiscard]] bool listens() const { return !listeners_.empty(); }
  /// The nodes that listen hear every frame of somebody else.
  void received(const Received& received) override {
    if (received.own || received.frame.error) return;
    for (nodes::Node* node : listeners_) node->hear(received.frame);
  }

  /// What befell the frames.
  [[nodiscard]] const FrameFaults& faults() const { return faults_; }

  /// Counters of the bench's own messages live in the same outbox.
  nodes::Transmission& outbox() { return out_; }

 private:
  void find_next() {
    next_ =
        static_cast<std::size_t>(std::ranges::min_element(due_us_) - due_us_.begin());  // the first of equals
  }

  std::vector<std::unique_ptr<nodes::Node>> nodes_;
  std::vector<std::int64_t> due_us_;  // of each node
  std::vector<nodes::Node*> listeners_;
  std::size_t next_ = 0;
  nodes::Transmission out_;
  FrameFaults faults_;
};

}  // namespace canhil::drive
