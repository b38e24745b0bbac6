#include "bench/faults/kinds/order.hpp"

#include <deque>
#include <utility>

namespace canhil::faults {
namespace {

class DelayedFrames final : public OfFrames {
 public:
  DelayedFrames(const Delayed& kind, const InRun& run)
      : OfFrames(kind.of, kind.when, run), by_us_(kind.by_us) {}

  [[nodiscard]] std::int64_t due_us() const override {
    return waiting_.empty() ? nodes::never_us : waiting_.front().first;
  }
  void transmit(std::vector<Frame>& out) override {
    const std::int64_t now_us = due_us();
    for (; due_us() == now_us; waiting_.pop_front()) out.push_back(waiting_.front().second);
  }

 private:
  void put(Own& /*own*/, const Frame& frame, std::int64_t t_us, std::vector<Frame>& /*left*/) override {
    waiting_.emplace_back(t_us + by_us_, frame);
    ++tally().overtaken;
  }
  std::int64_t by_us_;
  std::deque<std::pair<std::int64_t, Frame>> waiting_;  // by time, because all have the same delay
};

class ReorderedFrames final : public OfFrames {
 public:
  using OfFrames::OfFrames;

 private:
  // Swaps two successive frames of a message. The second frame is not held, even if the fault affects it too.
  void put(Own& own, const Frame& frame, std::int64_t /*t_us*/, std::vector<Frame>& left) override {
    if (own.held) return pass(own, frame, left);
    own.held = frame;
  }
  void pass(Own& own, const Frame& frame, std::vector<Frame>& left) override {
    left.push_back(frame);
    if (!own.held) return;
    left.push_back(*std::exchange(own.held, std::nullopt));
    ++tally().overtaken;
  }
};

}  // namespace

Delayed Delayed::read(scenario::Section& section, const scenario::FaultContext& context) {
  Delayed kind;
  kind.of = read_messages(section, context);
  kind.when = read_when(section, context, Repeats::each);
  kind.by_us = section.time_us({"by_ms", "Delay of the frame."}, scenario::Limits::above(0));
  return kind;
}

std::unique_ptr<Injector> Delayed::injector(const InRun& run) const {
  return std::make_unique<DelayedFrames>(*this, run);
}

Reordered Reordered::read(scenario::Section& section, const scenario::FaultContext& context) {
  Reordered kind;
  kind.of = read_messages(section, context);
  kind.when = read_when(section, context, Repeats::each);
  return kind;
}

std::unique_ptr<Injector> Reordered::injector(const InRun& run) const {
  return std::make_unique<ReorderedFrames>(of, when, run);
}

}  // namespace canhil::faults
