// The signals that could not carry the values of their nodes.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "dbc/wire/message_info.hpp"

namespace canhil::nodes {

/// A value beyond the range of its signal is sent as the nearest limit, so the target gets another value than
/// the scenario defines: the scenario is at fault.
class Clipped {
 public:
  struct Range {
    double lowest = 0, highest = 0;
    std::string_view unit;
  };
  /// A value was clipped; it is in the unit of the range.
  void add(std::string_view message, std::string_view signal, double value, const Range& range);
  void add(const Clipped& others);
  /// The limits of what is not clipped: a value within half a step of the range is rounded to its end.
  static double lowest(const SignalInfo& signal) { return signal.minimum - wire::lsb(signal) / 2; }
  static double highest(const SignalInfo& signal) { return signal.maximum + wire::lsb(signal) / 2; }
  /// A value, in the unit of the signal, is to be sent; adds it if the signal clips it.
  void check(const MessageInfo& message, const SignalInfo& signal, double value) {
    if (value >= lowest(signal) && value <= highest(signal)) return;
    add(message.name, signal.name, value, {signal.minimum, signal.maximum, signal.unit});
  }

  [[nodiscard]] bool empty() const { return signals_.empty(); }
  /// A line for each signal: its range, the value farthest beyond, and how often.
  [[nodiscard]] std::vector<std::string> to_text() const;

 private:
  struct Signal {
    double lowest = 0, highest = 0, value = 0;
    std::string unit{};
    std::uint64_t count = 0;
    [[nodiscard]] double beyond(double one) const;
    void take(double one);
  };
  std::map<std::string, Signal> signals_;  // by MESSAGE.SIGNAL
};

}  // namespace canhil::nodes
