// A node with a fault of its sensor or of the node as a whole.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "bench/faults/injector.hpp"
#include "bench/nodes/kind.hpp"

namespace canhil::faults {

/// Wraps a Node object. A Node object that replays a log sends the frames of all nodes in the log; the frames
/// of the other nodes pass unchanged.
class FaultyNode : public nodes::Node {
 public:
  FaultyNode(std::unique_ptr<nodes::Node> node, const scenario::NodeSettings& settings, const InRun& run)
      : table_(settings.table()),
        period_us_(settings.period_us()),
        end_us_(run.end_us),
        node_(std::move(node)),
        tally_(run.tally) {}

  [[nodiscard]] std::int64_t due_us() const override { return node_->due_us(); }
  void transmit(nodes::Transmission& out) override { sample(out); }
  [[nodiscard]] bool listens() const final { return node_->listens(); }
  void hear(const Frame& frame) final { node_->hear(frame); }

 protected:
  /// Changes the frames that the node sends in one transmission. The transmission was due at `t_us`.
  virtual void apply(std::vector<Frame>& frames, std::int64_t t_us) = 0;
  /// Lets the node transmit, changes the frames with apply(), and puts the changed frames into `out`.
  void sample(nodes::Transmission& out);
  /// Whether a frame belongs to the node's sample group.
  [[nodiscard]] bool is_own(const Frame& frame) const { return message_of(frame) != nullptr; }
  /// The message of a frame; null if the frame is not of the sample group of this node.
  [[nodiscard]] const MessageInfo* message_of(const Frame& frame) const;
  [[nodiscard]] std::int64_t node_due_us() const { return node_->due_us(); }
  Tally& tally() { return tally_; }
  /// The values beyond the range of their signals, during apply().
  nodes::Clipped& clipped() { return clipped_; }

  const scenario::NodeTable& table_;
  const std::int64_t period_us_, end_us_;

 private:
  std::unique_ptr<nodes::Node> node_;
  Tally& tally_;
  nodes::Clipped clipped_;
};

/// Adjusts counters after samples that the node did not send, so that these samples leave no gap in the
/// counters. Frames that were sent and then lost do leave a gap.
class Recount {
 public:
  /// Records that the node did not send this frame, so that the counter does not count the frame.
  void skip(const Frame& frame);
  /// From now on, the counter of each message starts again at 0.
  void begin_at_zero() { at_zero_ = true, offsets_.clear(); }
  void write(Frame& frame, const MessageInfo& message);

 private:
  bool at_zero_ = false;
  std::map<std::uint32_t, int> offsets_;  // by id: offset of the counter, modulo the period of counters
};

}  // namespace canhil::faults
