// A sensor of canhil.dbc: its samples become the messages of a sample group.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "bench/nodes/kind.hpp"
#include "bench/nodes/sample_signals.hpp"
#include "dbc/wire/sample_group.hpp"

namespace canhil::nodes {

/// Packs samples into the messages of a group, each value in the unit of its signal. Angles are wrapped to
/// the range of the signal. The rounding remainder of an increment and of its interval is added to the next
/// sample.
class SampleEncoder {
 public:
  SampleEncoder(const MessageInfo& closes, const std::vector<SampleSignal>& signals);
  void encode(const sensors::Sample& sample, Transmission& out);

  /// What a signal carries.
  struct Slot {
    sensors::Role role = sensors::Role::value;
    std::size_t index = 0;           ///< of the value or flag in the sample
    double factor = 1;               ///< from the unit of the signal to SI
    double step = 0;                 ///< of the signal; 0: a float
    double lowest = 0, highest = 0;  ///< values beyond are clipped, see Clipped::check
    bool turns = false;
    double remainder = 0;  ///< of the last increment, in the unit of the signal
  };

 private:
  using Encode = Slot* (*)(Slot* slot, const sensors::Sample& sample, Transmission& out);
  std::vector<Slot> slots_;  // for each signal of the group, message by message
  std::vector<Encode> messages_;
};

/// Reads the target's answers that guide the missile of a seeker.
class AnswerOfLosRate {
 public:
  /// The answer that this frame completes, if it has an estimate. `near_us`: a time near that of the sample.
  std::optional<sensors::Guidance> take(const Frame& frame, std::int64_t near_us);

 private:
  SampleGroup<messages::LosRateEstimate, messages::LosRateSigma, messages::LosRateTarget> group_;
};

class BoundSensor final : public Node {
 public:
  BoundSensor(std::unique_ptr<sensors::Sensor> sensor, const Kind& kind)
      : sensor_(std::move(sensor)), encoder_(*kind.table.closes, kind.signals) {}

  [[nodiscard]] std::int64_t due_us() const override { return sensor_->due_us(); }
  void transmit(Transmission& out) override;
  [[nodiscard]] bool listens() const override { return sensor_->is_guided(); }
  bool hear(const Frame& frame, std::int64_t now_us) override;

 private:
  std::unique_ptr<sensors::Sensor> sensor_;
  SampleEncoder encoder_;
  std::int64_t valid_us_ = 0;  // of the latest sample
  AnswerOfLosRate answer_;
};

}  // namespace canhil::nodes
