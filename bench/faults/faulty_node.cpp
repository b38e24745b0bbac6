#include "bench/faults/faulty_node.hpp"

#include <algorithm>
#include <utility>

#include "bench/faults/frame_edit.hpp"
#include "dbc/wire/e2e.hpp"
#include "messages/canhil.hpp"

namespace canhil::faults {

const MessageInfo* FaultyNode::message_of(const Frame& frame) const {
  const auto found = std::ranges::find_if(messages::all_messages, [&](const MessageInfo& message) {
    return message.id == frame.id && message.extended == frame.extended;
  });
  const bool own = found != messages::all_messages.end() && found->sender == table_.closes.sender &&
                   found->sample_group == table_.closes.sample_group;
  return own ? &*found : nullptr;
}

void FaultyNode::sample(nodes::Transmission& out) {
  const std::int64_t t_us = node_->due_us();
  node_->transmit(out);
  std::vector<Frame> frames(out.frames().begin(), out.frames().end());
  apply(frames, t_us);
  out.clipped().add(std::exchange(clipped_, {}));
  out.clear();
  for (const Frame& frame : frames) out.put(frame);
}

void Recount::skip(const Frame& frame) {
  int& offset = offsets_[frame.id];
  offset = (offset + e2e::counter_period - 1) % e2e::counter_period;
}

void Recount::write(Frame& frame, const MessageInfo& message) {
  const int counter = e2e::counter(frame.payload());
  const auto [offset, first] = offsets_.try_emplace(frame.id, 0);
  if (first && at_zero_) offset->second = e2e::counter_period - counter;
  set_counter(frame, message, static_cast<std::uint8_t>((counter + offset->second) % e2e::counter_period));
}

}  // namespace canhil::faults
