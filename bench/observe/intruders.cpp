#include "bench/observe/intruders.hpp"

#include "messages/canhil.hpp"

namespace canhil::observe {

void Intruders::transmitted(const Frame& frame, std::int64_t /*t_ns*/, std::int64_t /*late_ns*/) {
  if (!frame.extended && frame.id < ours_.size()) ours_.set(frame.id);
}

void Intruders::received(const Received& received) {
  const Frame& frame = received.frame;
  if (received.own || frame.error || frame.extended || frame.id >= ours_.size() || !ours_.test(frame.id))
    return;
  if (const MessageInfo* info = messages::find_message(frame.id)) ++frames_[info->name];
}

}  // namespace canhil::observe
