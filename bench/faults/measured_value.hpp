// A measured value of a node in the frames of its sample.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/faults/read.hpp"
#include "bench/nodes/clipped.hpp"
#include "dbc/wire/frame.hpp"

namespace canhil::faults {

/// Whether a node sends a message.
bool sends(const scenario::NodeTable& node, const MessageInfo& message);

/// The interval [s] of the sample that these frames carry. If one of the frames contains an interval, returns
/// this interval; otherwise returns the period of the node.
double interval_of(const std::vector<Frame>& frames, std::int64_t period_us);

class MeasuredValue {
 public:
  explicit MeasuredValue(const Measured& of) : of_(of) {}

  [[nodiscard]] const Measured& of() const { return of_; }
  /// The frame that carries the value; null if no frame carries it.
  [[nodiscard]] Frame* in(std::vector<Frame>& frames) const;
  [[nodiscard]] double get(const Frame& frame, double interval_s) const;
  /// Writes the value. If the value is an increment, the rounding remainder of the previous increment is
  /// added first: value' = value + remainder. `clipped` notes a value beyond the range of the signal.
  void put(Frame& frame, double value, double interval_s, nodes::Clipped& clipped);
  /// Writes the value without adding a remainder.
  void put_exactly(Frame& frame, double value, double interval_s) const;

 private:
  Measured of_;
  double remainder_ = 0;  // rounding remainder of the last increment, in the signal's unit
};

}  // namespace canhil::faults
