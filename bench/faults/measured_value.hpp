// A number that a node measures, in the frames of its sample.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/faults/read.hpp"
#include "dbc/wire/frame.hpp"

namespace canhil::faults {

/// Whether a node sends a message.
bool sends(const scenario::NodeTable& node, const MessageInfo& message);

/// How long the sample of these frames took [s]: what they say, or else the node's period.
double interval_of(const std::vector<Frame>& frames, std::int64_t period_us);

class MeasuredValue {
 public:
  explicit MeasuredValue(const Measured& of) : of_(of) {}

  [[nodiscard]] const Measured& of() const { return of_; }
  /// The frame that has it; null: none of them.
  [[nodiscard]] Frame* in(std::vector<Frame>& frames) const;
  [[nodiscard]] double get(const Frame& frame, double interval_s) const;
  /// An increment carries what rounding leaves into the next one: value' = value + remainder.
  void put(Frame& frame, double value, double interval_s);
  /// Whatever was left before.
  void put_exactly(Frame& frame, double value, double interval_s) const;

 private:
  Measured of_;
  double remainder_ = 0;  // in the signal's unit
};

}  // namespace canhil::faults
