#include "bench/faults/measured_value.hpp"

#include <algorithm>
#include <cmath>

#include "bench/faults/frame_edit.hpp"
#include "bench/nodes/increment_rounding.hpp"
#include "dbc/wire/turns.hpp"

namespace canhil::faults {

bool sends(const scenario::NodeTable& node, const MessageInfo& message) {
  return message.sender == node.closes.sender && message.sample_group == node.closes.sample_group;
}

double interval_of(const std::vector<Frame>& frames, std::int64_t period_us) {
  for (const Frame& frame : frames) {
    if (const auto us = value_of(frame, "interval_us")) return 1e-6 * *us;
  }
  return 1e-6 * static_cast<double>(period_us);
}

Frame* MeasuredValue::in(std::vector<Frame>& frames) const {
  const auto found = std::ranges::find_if(frames, [&](const Frame& frame) {
    return frame.id == of_.message->id && frame.extended == of_.message->extended;
  });
  return found == frames.end() ? nullptr : &*found;
}

double MeasuredValue::get(const Frame& frame, double interval_s) const {
  const double value = value_of(frame, of_.signal->name).value_or(0) * of_.factor;
  return of_.rate ? value / interval_s : value;
}

void MeasuredValue::put(Frame& frame, double value, double interval_s, nodes::Clipped& clipped) {
  const SignalInfo& signal = *of_.signal;
  const double wanted = value * (of_.rate ? interval_s : 1) / of_.factor;
  const double step = frame.unrounded ? 0 : wire::lsb(signal);
  // Angles are wrapped when they are packed, and a wrong time is no measurement. A frame that is not rounded
  // is not sent: a mapping packs its values.
  if (!frame.unrounded && !wire::turns(signal) && !is_time(signal.name))
    clipped.check(*of_.message, signal, wanted);
  set(frame, signal.name,
      signal.carries_remainder ? nodes::round_increment(wanted, step, signal, remainder_) : wanted);
}

void MeasuredValue::put_exactly(Frame& frame, double value, double interval_s) const {
  set(frame, of_.signal->name, value * (of_.rate ? interval_s : 1) / of_.factor);
}

}  // namespace canhil::faults
