#include "bench/protocol/contract_watch.hpp"

#include <fmt/format.h>

#include "bench/protocol/decode_from_target.hpp"
#include "bench/protocol/heartbeat_errors.hpp"

namespace canhil::protocol {

void ContractWatch::received(const Received& received) {
  if (!alone_) second_.received(received);
  if (received.own || target_messages(received.frame) == Routes::nowhere) return;
  heard_ = true;
  if (received.frame.id == messages::StepDone::info.id) {
    const auto done = decode_from_target<messages::StepDone>(received);
    done_ = done_ || (done && done->step == awaited_);
  } else if (received.frame.id == messages::TargetHeartbeat::info.id) {
    if (const auto beat = fault_in(received)) fault_ = beat;
  }
}

std::optional<std::string> ContractWatch::fault() const {
  if (second_.found()) return std::string(SecondTarget::complaint);
  return fault_ ? std::optional(fault_of(*fault_)) : std::nullopt;
}

bool ContractWatch::closes_step(const Frame& frame) {
  if (frame.id != messages::Sync::info.id) return false;
  awaited_ = from_frame<messages::Sync>(frame).step;
  done_ = false;
  return true;
}

std::string ContractWatch::step() const { return fmt::format("step {}", awaited_); }

}  // namespace canhil::protocol
