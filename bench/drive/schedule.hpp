// The order of all transmissions, the same in real time and in lockstep.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/drive/link.hpp"
#include "bench/faults/in_run.hpp"
#include "bench/nodes/node.hpp"
#include "bench/plant/simulation.hpp"
#include "bench/world/truth_values.hpp"

namespace canhil::drive {

/// The nodes of a bus in order of precedence: among nodes that are due at the same time, the node that is
/// earlier in the list transmits first. Faults of bus and target act before the nodes that are due at the
/// same time.
class Schedule final : public observe::Observer {
 public:
  /// `keeper`: the node whose frame closes a step. The keeper transmits last among the nodes that are due at
  /// the same time, and the schedule ends with the keeper's last transmission. `faults`: faults of the run;
  /// null: none. `plants`: advance before each transmission.
  Schedule(std::vector<std::unique_ptr<nodes::Node>> sensors, std::unique_ptr<nodes::Node> keeper,
           Rounding rounding = Rounding::as_on_the_bus, std::unique_ptr<faults::Faults> faults = nullptr,
           std::vector<plant::Simulation*> plants = {})
      : nodes_(std::move(sensors)), out_(rounding), faults_(std::move(faults)), plants_(std::move(plants)) {
    nodes_.push_back(std::move(keeper));
    if (faults_) injectors_ = faults_->injectors();
    look_at_nodes();
  }
  /// Adds a node that transmits after the sensors and before the keeper.
  void add(std::unique_ptr<nodes::Node> node) {
    nodes_.insert(nodes_.end() - 1, std::move(node));
    look_at_nodes();
  }

  /// The time of the next transmission; nodes::never_us after the last one.
  [[nodiscard]] std::int64_t due_us() const {
    return due_us_.back() == nodes::never_us ? nodes::never_us : std::min(due_us_[next_], injected_us_);
  }

  /// Makes the next transmission; the returned frames are valid until the next call.
  std::span<const Frame> take() {
    const std::int64_t t_us = taken_us_ = due_us();
    for (plant::Simulation* plant : plants_) plant->advance(t_us);
    if (truths_ && faults_->begin_in_run()) {
      faults_->look(*truths_, t_us);
      find_next();
    }
    std::size_t injected = 0;  // index of the first injector whose apply() is called below
    if (injected_us_ == t_us) {
      frames_.clear();
      injected = static_cast<std::size_t>(first_injector() - injectors_.begin());
      injectors_[injected++]->transmit(frames_);
    } else {
      out_.clear();
      nodes_[next_]->transmit(out_);
      due_us_[next_] = nodes_[next_]->due_us();
      find_next();
      if (injectors_.empty()) return overheard(out_.frames(), t_us);
      frames_.assign(out_.frames().begin(), out_.frames().end());
    }
    for (; injected < injectors_.size(); ++injected) injectors_[injected]->apply(frames_, t_us);
    find_next();
    return overheard(frames_, t_us);
  }

  /// The truth that the conditions of faults use; without it, none holds. It must outlive the schedule.
  void set_truth(const world::Truths& truths) { truths_.emplace(truths); }
  /// `why`: why a sensor or a partner ended the run; empty: none did.
  void set_stopped(std::shared_ptr<const std::string> why) { stopped_ = std::move(why); }
  /// Why the run cannot go on; none: it can.
  [[nodiscard]] std::optional<std::string> why_failed() const {
    if (stopped_ && !stopped_->empty()) return *stopped_;
    return plant::why_failed(plants_);
  }

  /// The time until which a fault explains the target's silence.
  [[nodiscard]] std::int64_t silent_until_us() const {
    std::int64_t until_us = std::numeric_limits<std::int64_t>::min();
    for (const auto& injector : injectors_) until_us = std::max(until_us, injector->silent_until_us());
    return until_us;
  }

  /// Whether any node listens to frames of other senders.
  [[nodiscard]] bool listens() const { return !listeners_.empty(); }
  /// Passes frames of other senders to the nodes that listen.
  void received(const Received& received) override {
    if (received.own || received.frame.error) return;
    const std::int64_t now_us = clock_ ? clock_() : taken_us_;
    for (const std::size_t i : listeners_) {
      if (!nodes_[i]->hear(received.frame, now_us)) continue;
      due_us_[i] = nodes_[i]->due_us();
      find_next();
    }
  }
  /// The clock of the time base, in real time. Without it, it is the time of the last transmission.
  void set_clock(std::function<std::int64_t()> clock) { clock_ = std::move(clock); }
  /// Whether a node waits for an answer that takes no virtual time.
  [[nodiscard]] bool awaits() const {
    return std::ranges::any_of(listeners_, [&](std::size_t i) { return nodes_[i]->awaits(); });
  }
  /// Lets these nodes wait no longer.
  void give_up() {
    for (const std::size_t i : listeners_) {
      nodes_[i]->give_up(taken_us_);
      due_us_[i] = nodes_[i]->due_us();
    }
    find_next();
  }

  /// To be called at the end of every run: the faults release the frames and resources that they hold.
  void end() {
    for (const auto& injector : injectors_) injector->end();
  }
  /// Null: no faults.
  [[nodiscard]] faults::Faults* faults() const { return faults_.get(); }

  /// The outbox, which keeps the counters of the bench's own messages.
  nodes::Transmission& outbox() { return out_; }

 private:
  void look_at_nodes() {
    due_us_.clear();
    listeners_.clear();
    overhearers_.clear();
    for (const auto& node : nodes_) {
      if (node->listens()) listeners_.push_back(due_us_.size());
      if (node->overhears()) overhearers_.push_back(node.get());
      due_us_.push_back(node->due_us());
    }
    find_next();
  }
  std::span<const Frame> overheard(std::span<const Frame> frames, std::int64_t t_us) {
    for (nodes::Node* node : overhearers_) {
      for (const Frame& frame : frames) node->hear(frame, t_us);
    }
    return frames;
  }
  [[nodiscard]] std::span<const std::unique_ptr<faults::Injector>>::iterator first_injector() const {
    return std::ranges::min_element(injectors_, {}, [](const auto& one) { return one->due_us(); });
  }
  void find_next() {
    next_ = static_cast<std::size_t>(std::ranges::min_element(due_us_) -
                                     due_us_.begin());  // of equal times, the first
    if (!injectors_.empty()) injected_us_ = (*first_injector())->due_us();
  }

  std::vector<std::unique_ptr<nodes::Node>> nodes_;
  std::vector<std::int64_t> due_us_;    // for each node
  std::vector<std::size_t> listeners_;  // indices of nodes
  std::vector<nodes::Node*> overhearers_;
  std::function<std::int64_t()> clock_;
  std::shared_ptr<const std::string> stopped_;
  std::optional<world::Truths> truths_;
  std::int64_t taken_us_ = 0;
  std::size_t next_ = 0;
  nodes::Transmission out_;
  std::vector<Frame> frames_;
  std::unique_ptr<faults::Faults> faults_;
  std::vector<plant::Simulation*> plants_;
  std::span<const std::unique_ptr<faults::Injector>> injectors_;
  std::int64_t injected_us_ = nodes::never_us;  // when the next injector acts
};

}  // namespace canhil::drive
