#include "bench/drive/frame_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/observe/values.hpp"
#include "dbc/wire/bits.hpp"
#include "dbc/wire/e2e.hpp"
#include "messages/canhil.hpp"

namespace canhil::drive {
namespace {

using scenario::FaultKind;

/// Writes a physical value, rounded to the signal's step, and makes the CRC right.
void set(Frame& frame, const MessageInfo& message, const SignalInfo& signal, double value) {
  const auto raw = static_cast<std::uint64_t>(std::llround((value - signal.offset) / signal.scale));
  for (unsigned i = 0; i < signal.length; ++i) {
    const unsigned from = signal.big_endian ? signal.length - 1 - i : i;
    const unsigned at = wire::bit_position(signal.start_bit, i, signal.big_endian);
    const auto bit = static_cast<std::uint8_t>(1U << (at % 8));
    auto& byte = frame.data[at / 8];
    byte = static_cast<std::uint8_t>((raw >> from & 1U) != 0 ? byte | bit : byte & ~bit);
  }
  if (message.e2e_data_id != 0) frame.data[0] = e2e::crc(frame.payload(), message.e2e_data_id);
  frame.unrounded = false;  // or the value beside the bytes would be the old one
}

}  // namespace

Result<FrameFaults> FrameFaults::make(std::span<const scenario::Fault> faults,
                                      std::span<const MessageInfo> messages) {
  FrameFaults made;
  for (const scenario::Fault& fault : faults) {
    for (const std::string& name : fault.messages) {
      const auto message = std::ranges::find(messages, std::string_view(name), &MessageInfo::name);
      if (message == messages.end() || message->sample_group.empty() ||
          message->sender == canhil::messages::TargetHeartbeat::info.sender)
        return failure(
            fmt::format("key '{}': {} is no sample of a node of the bench, expected one", fault.where, name));
      const bool own = messages.data() == canhil::messages::all_messages.data();
      if (fault.kind == FaultKind::changed && !own)
        return failure(
            fmt::format("key '{}': 'changed' is of canhil's own messages, expected another kind for {}",
                        fault.where, name));
      const SignalInfo* signal = nullptr;
      if (fault.kind == FaultKind::changed &&
          (signal = observe::signal_of(*message, fault.signal)) == nullptr)
        return failure(fmt::format("key '{}': {} has no signal '{}', expected one that it has", fault.where,
                                   name, fault.signal));
      if (signal != nullptr && !(fault.value >= signal->minimum && fault.value <= signal->maximum))
        return failure(fmt::format("key '{}': {} of {} is {:g}, expected {:g} to {:g}", fault.where,
                                   fault.signal, name, fault.value, signal->minimum, signal->maximum));
      made.faults_.push_back({.fault = &fault, .message = &*message, .signal = signal});
    }
  }
  return made;
}

std::span<const Frame> FrameFaults::befall(std::span<const Frame> frames, std::int64_t t_us) {
  if (faults_.empty()) return frames;
  left_.assign(frames.begin(), frames.end());
  for (Own& own : faults_) {
    if (t_us < own.fault->from_us || t_us > own.fault->to_us) continue;
    before_.swap(left_);
    left_.clear();
    for (const Frame& frame : before_) {
      const bool its_own = frame.id == own.message->id && frame.extended == own.message->extended;
      if (its_own && own.seen++ % own.fault->every == 0)
        put(own, frame);
      else
        left_.push_back(frame);
    }
  }
  return left_;
}

void FrameFaults::put(Own& own, const Frame& frame) {
  switch (own.fault->kind) {
    case FaultKind::lost:
      return;
    case FaultKind::repeated:
      left_.push_back(frame);
      left_.push_back(frame);
      return;
    case FaultKind::damaged:
      left_.push_back(frame);
      left_.back().data[std::min<std::size_t>(3, frame.size - 1)] ^=
          0x10U;  // of the first signal of every measurement: the value is another
      left_.back().unrounded = false;
      return;
    case FaultKind::too_short:
      left_.push_back(frame);
      --left_.back().size;
      return;
    case FaultKind::foreign:
      left_.push_back(frame);
      left_.back().extended = true;
      return;
    case FaultKind::changed:
      left_.push_back(frame);
      set(left_.back(), *own.message, *own.signal, own.fault->value);
      ++changed_.all;
      if (own.signal->name.starts_with("time_of_validity")) ++changed_.times;
      return;
  }
}

}  // namespace canhil::drive
