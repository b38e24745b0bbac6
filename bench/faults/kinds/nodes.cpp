#include "bench/faults/kinds/nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "bench/faults/faulty_node.hpp"
#include "bench/faults/frame_edit.hpp"
#include "bench/faults/measured_value.hpp"
#include "bench/observe/values.hpp"
#include "bench/scenario/rule.hpp"

namespace canhil::faults {
namespace {

using nodes::Node;
using scenario::FaultContext;
using scenario::NodeSettings;
using scenario::Section;

// Rejects a target with a mapping, because a mapping sends samples at its own times.
std::string needs_contract(const Place& place) {
  return place.mapped ? "has no effect on a mapping, which plays samples by its own times, expected a target "
                        "that speaks canhil's contract"
                      : "";
}

template <class Kind>
Kind read_of_node(Section& section, const FaultContext& context, Repeats repeats = Repeats::stretch) {
  Kind kind;
  kind.table = read_node(section, context);
  kind.when = read_when(section, context, repeats);
  return kind;
}

class SilentNode final : public FaultyNode {
 public:
  SilentNode(std::unique_ptr<Node> node, const NodeSettings& settings, const InRun& run, const When& when,
             bool restarts)
      : FaultyNode(std::move(node), settings, run), when_(when), restarts_(restarts) {}

 private:
  void apply(std::vector<Frame>& frames, std::int64_t t_us) override {
    if (when_.holds(t_us)) {
      const auto gone = std::erase_if(frames, [&](const Frame& frame) {
        if (is_own(frame)) recount_.skip(frame);
        return is_own(frame);
      });
      if (gone > 0 && !restarts_) ++tally().count;
      return;
    }
    // The counters restart even if the fault was too short to suppress a sample.
    if (restarts_ && t_us > when_.to_us) {
      restarts_ = false;
      recount_.begin_at_zero();
      ++tally().count;
    }
    for (Frame& frame : frames) {
      if (const MessageInfo* message = message_of(frame); message != nullptr) recount_.write(frame, *message);
    }
  }
  When when_;
  bool restarts_;  // true: the counters must still restart
  Recount recount_;
};

class LateNode final : public FaultyNode {
 public:
  LateNode(std::unique_ptr<Node> node, const NodeSettings& settings, const InRun& run, const Late& kind)
      : FaultyNode(std::move(node), settings, run), by_us_(kind.by_us), occasions_(kind.when, run.stream()) {}

  [[nodiscard]] std::int64_t due_us() const override {
    return waiting_.empty() ? node_due_us() : std::min(node_due_us(), waiting_.front().first);
  }
  void transmit(nodes::Transmission& out) override {
    if (waiting_.empty() || waiting_.front().first > node_due_us()) return sample(out);
    for (const Frame& frame : waiting_.front().second) out.put(frame);
    waiting_.pop_front();
  }

 private:
  void apply(std::vector<Frame>& frames, std::int64_t t_us) override {
    if (frames.empty() || !is_own(frames.front()) || !occasions_.next(t_us)) return;
    ++tally().count;
    ++tally().overtaken;
    waiting_.emplace_back(t_us + by_us_, std::exchange(frames, {}));
  }
  std::int64_t by_us_;
  Occasions occasions_;
  std::deque<std::pair<std::int64_t, std::vector<Frame>>>
      waiting_;  // ordered by time, because all samples have the same delay
};

class SlowNode final : public FaultyNode {
 public:
  SlowNode(std::unique_ptr<Node> node, const NodeSettings& settings, const InRun& run, const Slow& kind)
      : FaultyNode(std::move(node), settings, run), when_(kind.when), longer_(kind.longer) {}

 private:
  // During the fault, transmissions are due at multiples of the longer period, counted from the first sample.
  // A sample that comes before the next due time is not sent.
  void apply(std::vector<Frame>& frames, std::int64_t t_us) override {
    if (frames.empty() || !is_own(frames.front())) return;
    if (!when_.holds(t_us)) {
      ticks_us_ = 0;
    } else {
      if (ticks_us_ == 0) ticks_us_ = static_cast<double>(t_us);
      const bool sent = static_cast<double>(t_us) >= ticks_us_;
      if (!sent) {
        for (const Frame& frame : frames) add_increments(frame);
        for (const Frame& frame : frames) recount_.skip(frame);
        ++tally().count;
        frames.clear();
        return;
      }
      ticks_us_ += static_cast<double>(period_us_) * longer_;
    }
    for (Frame& frame : frames) {
      for (auto& [signal, kept] : kept_) {
        const auto own = value_of(frame, signal);
        if (own && kept != 0) set(frame, signal, *own + std::exchange(kept, 0));
      }
      recount_.write(frame, *message_of(frame));
    }
  }
  void add_increments(const Frame& frame) {
    for (const observe::Value& value : observe::values_of(frame)) {
      const bool adds_up = value.signal->name == "interval_us" ||
                           std::ranges::find(table_.increments, value.signal->name,
                                             &scenario::Increment::signal) != table_.increments.end();
      if (adds_up) kept_[value.signal->name] += value.value;
    }
  }
  When when_;
  double longer_;
  double ticks_us_ = 0;                      // time when a transmission is next due; 0: not active
  std::map<std::string_view, double> kept_;  // by signal: sum of the increments that were not sent
  Recount recount_;
};

class WrongClock final : public FaultyNode {
 public:
  /// The node reports the time t + by + rate * (t - from).
  WrongClock(std::unique_ptr<Node> node, const NodeSettings& settings, const InRun& run, const When& when,
             std::int64_t by_us, double rate)
      : FaultyNode(std::move(node), settings, run), when_(when), by_us_(by_us), rate_(rate) {}

 private:
  void apply(std::vector<Frame>& frames, std::int64_t t_us) override {
    if (!when_.holds(t_us)) return;
    const double off_us =
        std::round(static_cast<double>(by_us_) + rate_ * static_cast<double>(t_us - when_.from_us));
    for (Frame& frame : frames) {
      const MessageInfo* message = message_of(frame);
      if (message == nullptr) continue;
      for (const observe::Value& value : observe::values_of(frame)) {
        const SignalInfo& signal = *value.signal;
        if (signal.name == "interval_us") {
          interval(frame, value);
        } else if (signal.name.starts_with("time_of_validity")) {
          const double turn = std::ldexp(signal.scale, static_cast<int>(signal.length));
          const double sent = value.value + off_us;
          set(frame, signal.name, sent - turn * std::floor(sent / turn));
          ++tally().count;
          ++tally().changed;
          ++tally().changed_times;
        }
      }
    }
  }
  void interval(Frame& frame, const observe::Value& value) {
    if (rate_ == 0) return;
    const double wanted = value.value * (1 + rate_) + remainder_us_;
    const double step = wire::lsb(*value.signal);
    const double sent = std::nearbyint(wanted / step) * step;
    remainder_us_ = wanted - sent;
    set(frame, value.signal->name, sent);
  }
  When when_;
  std::int64_t by_us_;
  double rate_;
  double remainder_us_ = 0;
};

}  // namespace

Silent Silent::read(Section& section, const FaultContext& context) {
  return read_of_node<Silent>(section, context);
}
std::unique_ptr<Node> Silent::wrap(std::unique_ptr<Node> node, const NodeSettings& settings,
                                   const InRun& run) const {
  return std::make_unique<SilentNode>(std::move(node), settings, run, when, false);
}

NodeRestart NodeRestart::read(Section& section, const FaultContext& context) {
  NodeRestart kind;
  kind.table = read_node(section, context);
  kind.when.from_us = section.time_us({"from_s", "Time of transmission at which the fault begins."},
                                      scenario::Limits::at_least(0));
  scenario::expect_within_run(section, "from_s", kind.when.from_us, context.duration_us);
  kind.when.to_us = kind.when.from_us + section.time_us({"silent_s", "Time for which the node is silent."},
                                                        scenario::Limits::at_least(0));
  return kind;
}
std::unique_ptr<Node> NodeRestart::wrap(std::unique_ptr<Node> node, const NodeSettings& settings,
                                        const InRun& run) const {
  return std::make_unique<SilentNode>(std::move(node), settings, run, when, true);
}

Late Late::read(Section& section, const FaultContext& context) {
  auto kind = read_of_node<Late>(section, context, Repeats::each);
  kind.by_us = section.time_us({"by_ms", "Delay of the sample."}, scenario::Limits::above(0));
  return kind;
}
std::string Late::cannot(const Place& place) const { return needs_contract(place); }
std::unique_ptr<Node> Late::wrap(std::unique_ptr<Node> node, const NodeSettings& settings,
                                 const InRun& run) const {
  return std::make_unique<LateNode>(std::move(node), settings, run, *this);
}

Slow Slow::read(Section& section, const FaultContext& context) {
  auto kind = read_of_node<Slow>(section, context);
  kind.longer = 1 + section.number({"longer_percent", "Percentage by which the period is longer."},
                                   scenario::Limits::above(0, 100));
  return kind;
}
std::string Slow::cannot(const Place& place) const { return needs_contract(place); }
std::unique_ptr<Node> Slow::wrap(std::unique_ptr<Node> node, const NodeSettings& settings,
                                 const InRun& run) const {
  return std::make_unique<SlowNode>(std::move(node), settings, run, *this);
}

ClockStep ClockStep::read(Section& section, const FaultContext& context) {
  auto kind = read_of_node<ClockStep>(section, context);
  kind.by_us = section.time_us({"by_ms", "Size of the step, which is added to the times of validity."}, {});
  return kind;
}
std::string ClockStep::cannot(const Place& place) const { return needs_contract(place); }
std::unique_ptr<Node> ClockStep::wrap(std::unique_ptr<Node> node, const NodeSettings& settings,
                                      const InRun& run) const {
  return std::make_unique<WrongClock>(std::move(node), settings, run, when, by_us, 0);
}

ClockDrift ClockDrift::read(Section& section, const FaultContext& context) {
  auto kind = read_of_node<ClockDrift>(section, context);
  kind.rate = section.number({"by_ppm", "Relative error of the clock's rate; positive: too fast."},
                             scenario::Limits::between(-1e5, 1e5));
  return kind;
}
std::string ClockDrift::cannot(const Place& place) const { return needs_contract(place); }
std::unique_ptr<Node> ClockDrift::wrap(std::unique_ptr<Node> node, const NodeSettings& settings,
                                       const InRun& run) const {
  return std::make_unique<WrongClock>(std::move(node), settings, run, when, 0, rate);
}

}  // namespace canhil::faults
