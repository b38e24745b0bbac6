// A node, as faults of its sensors or of itself make it.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "bench/faults/injector.hpp"
#include "bench/nodes/kind.hpp"

namespace canhil::faults {

/// Stands in the place of a node. Frames of others, where several nodes share a log, pass as they are.
class BefallenNode : public nodes::Node {
 public:
  BefallenNode(std::unique_ptr<nodes::Node> node, const scenario::NodeSettings& settings, const InRun& run)
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
  /// Changes the frames of a transmission of the node, at its time.
  virtual void befall(std::vector<Frame>& frames, std::int64_t t_us) = 0;
  /// Has the node transmit, and puts what is left of it.
  void sample(nodes::Transmission& out);
  /// Whether a frame is of the node's sample group.
  [[nodiscard]] bool is_own(const Frame& frame) const { return message_of(frame) != nullptr; }
  /// Null: of another.
  [[nodiscard]] const MessageInfo* message_of(const Frame& frame) const;
  [[nodiscard]] std::int64_t node_due_us() const { return node_->due_us(); }
  Tally& tally() { return tally_; }

  const scenario::NodeTable& table_;
  const std::int64_t period_us_, end_us_;

 private:
  std::unique_ptr<nodes::Node> node_;
  Tally& tally_;
};

/// Counters of a node that did not send all that was made for it. What it sent and lost stays a gap.
class Recount {
 public:
  /// A frame that the node did not send: it did not count it either.
  void skip(const Frame& frame);
  /// The next frame of each message has counter 0.
  void begin_at_zero() { at_zero_ = true, offsets_.clear(); }
  void write(Frame& frame, const MessageInfo& message);

 private:
  bool at_zero_ = false;
  std::map<std::uint32_t, int> offsets_;  // by id: to be added to the counters, modulo their period
};

}  // namespace canhil::faults
