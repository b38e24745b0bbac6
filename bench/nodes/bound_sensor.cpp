#include "bench/nodes/bound_sensor.hpp"

#include <algorithm>
#include <cmath>

#include "bench/nodes/increment_rounding.hpp"
#include "dbc/wire/time_base.hpp"
#include "dbc/wire/turns.hpp"

namespace canhil::nodes {
namespace {

using sensors::Role;
using sensors::Sample;
using Slot = SampleEncoder::Slot;

// Time signals with 16 bits have a resolution of 10 us, those with 32 bits a resolution of 1 us.
template <class Member>
double stamp(const Sample& sample) {
  return static_cast<double>(std::is_floating_point_v<Member> ? wrap_short_us(sample.stamp_us)
                                                              : wrap_us(sample.stamp_us));
}

// As std::llround(), which is a call of the library, but for whole numbers, which nearly all are, a single
// instruction.
std::int64_t nearest(double value) {
  const std::int64_t near = std::llrint(value);
  return static_cast<double>(near) == value ? near : std::llround(value);
}

template <class Message, class Member>
double carried(const SignalInfo& signal, Slot& slot, const Sample& sample, Transmission& out) {
  const auto step = [&] { return out.rounding() == Rounding::none ? 0 : slot.step; };
  switch (slot.role) {
    case Role::time_of_validity:
      return stamp<Member>(sample);
    case Role::interval:
      // A wrong interval, by a fault, is no measurement: it is not noted as clipped.
      return round_increment(sample.interval_us, step(), signal, slot.remainder);
    case Role::validity:
      return (sample.invalid >> slot.index & 1U) != 0 ? 0 : 1;
    case Role::value:
      break;
  }
  const double value = sample.values[slot.index] / slot.factor;
  if (slot.turns) return std::abs(value) <= 180 ? value : std::remainder(value, 360);
  if (!signal.carries_remainder) return value;
  if (value < signal.minimum || value > signal.maximum) out.clipped().check(Message::info, signal, value);
  return round_increment(value, step(), signal, slot.remainder);
}

template <class Message>
Slot* encode_message(Slot* slot, const Sample& sample, Transmission& out) {
  if (sample.restarted) out.restart<Message>();
  Message message{};
  bool fits = true;
  Message::visit(message, [&](const SignalInfo& signal, auto& member) {
    using Member = std::remove_cvref_t<decltype(member)>;
    const double value = carried<Message, Member>(signal, *slot, sample, out);
    if constexpr (std::is_floating_point_v<Member>)
      member = static_cast<Member>(value);
    else
      member = static_cast<Member>(nearest(value));
    fits =
        fits && static_cast<double>(member) >= slot->lowest && static_cast<double>(member) <= slot->highest;
    ++slot;
  });
  if (fits)
    out.send_fitting(message);
  else
    out.send(message);
  return slot;
}

}  // namespace

SampleEncoder::SampleEncoder(const MessageInfo& closes, const std::vector<SampleSignal>& signals) {
  for (const SampleSignal& signal : signals)
    slots_.push_back({.role = signal.role,
                      .index = signal.index,
                      .factor = signal.factor,
                      .step = wire::lsb(signal.info),
                      .lowest = Clipped::lowest(signal.info),
                      .highest = Clipped::highest(signal.info),
                      .turns = wire::turns(signal.info)});
  each_message(closes, [&]<class Message>() { messages_.push_back(encode_message<Message>); });
}

void SampleEncoder::encode(const Sample& sample, Transmission& out) {
  Slot* slot = slots_.data();
  for (const Encode one : messages_) slot = one(slot, sample, out);
}

void BoundSensor::transmit(Transmission& out) {
  const Sample sample = sensor_->measure();
  if (sample.fate == Sample::Fate::none) return;
  valid_us_ = sample.valid_us;
  encoder_.encode(sample, out);
  if (sample.fate == Sample::Fate::lost)
    out.clear();  // the counters advance, so the receiver detects the gap
}

bool BoundSensor::hear(const Frame& frame, std::int64_t /*now_us*/) {
  if (const auto answer = answer_.take(frame, valid_us_)) sensor_->guide(*answer);
  return false;
}

}  // namespace canhil::nodes
