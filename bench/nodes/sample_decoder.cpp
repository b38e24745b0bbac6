#include "bench/nodes/sample_decoder.hpp"

#include <algorithm>

#include "bench/nodes/is_whole.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::nodes {
namespace {

using sensors::Role;
using sensors::Sample;

// Time signals with 16 bits count tens of microseconds, those with 32 bits microseconds.
template <class Member>
std::int64_t unwrapped(Member sent, std::int64_t before_us) {
  constexpr std::int64_t period_us =
      std::is_floating_point_v<Member> ? short_period_us : std::int64_t{1} << 32U;
  const std::int64_t on_us = (static_cast<std::int64_t>(sent) - before_us) % period_us;
  return before_us + (on_us < 0 ? on_us + period_us : on_us);
}

template <class Message>
bool decode_message(const Frame& frame, const SampleSignal* signal, std::int64_t before_us, Sample& sample) {
  if (!is_whole<Message>(frame)) return false;
  const Message message = from_frame<Message>(frame);
  Message::visit(message, [&](const SignalInfo& /*signal*/, const auto& member) {
    const SampleSignal& of = *signal++;
    const auto value = static_cast<double>(member);
    switch (of.role) {
      case Role::time_of_validity:
        sample.valid_us = sample.stamp_us = unwrapped(member, before_us);
        break;
      case Role::interval:
        sample.interval_us = value;
        break;
      case Role::validity:
        if (value == 0) sample.invalid |= 1U << of.index;
        break;
      case Role::value:
        sample.values[of.index] = value * of.factor;
        break;
    }
  });
  return true;
}

}  // namespace

SampleDecoder::SampleDecoder(const Kind& kind) {
  const SampleSignal* signal = kind.signals.data();
  each_message(*kind.table.closes, [&]<class Message>() {
    parts_.push_back({.id = Message::info.id, .decode = decode_message<Message>, .signals = signal});
    while (signal != kind.signals.data() + kind.signals.size() && signal->message == &Message::info) ++signal;
  });
}

bool SampleDecoder::has(const Frame& frame) const {
  return !frame.extended && !frame.error && std::ranges::find(parts_, frame.id, &Part::id) != parts_.end();
}

std::optional<Sample> SampleDecoder::take(const Frame& frame) {
  const auto part = std::ranges::find(parts_, frame.id, &Part::id);
  if (part == parts_.end()) return std::nullopt;
  const std::uint8_t counter = e2e::counter(frame.payload());
  const bool begun = std::ranges::any_of(parts_, &Part::seen);
  if (!begun || counter != counter_) {
    for (Part& one : parts_) one.seen = false;
    sample_ = {};
    counter_ = counter;
  }
  part->seen = part->decode(frame, part->signals, before_us_, sample_);
  if (!std::ranges::all_of(parts_, &Part::seen)) return std::nullopt;
  for (Part& one : parts_) one.seen = false;
  lost_ = latest_ ? (counter + e2e::counter_period - *latest_ - 1) % e2e::counter_period : 0;
  latest_ = counter;
  before_us_ = sample_.valid_us;
  return sample_;
}

}  // namespace canhil::nodes
