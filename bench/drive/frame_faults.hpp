// A scenario's faults, put into the frames of its nodes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bench/scenario/faults.hpp"
#include "dbc/wire/frame.hpp"
#include "dbc/wire/message_info.hpp"
#include "dbc/wire/result.hpp"
#include "messages/canhil.hpp"

namespace canhil::drive {

class FrameFaults {
 public:
  /// `messages`: of the bus. Error: one line; a fault names a message of the target, or a signal that its
  /// messages do not have.
  static Result<FrameFaults> make(std::span<const scenario::Fault> faults,
                                  std::span<const MessageInfo> messages = messages::all_messages);

  /// What is left of the frames of a transmission that is due at `t_us`; valid until the next call.
  std::span<const Frame> befall(std::span<const Frame> frames, std::int64_t t_us);

  /// Frames with a value that the node did not send, right by their protection; of those, with another time.
  struct Changed {
    std::uint64_t all = 0, times = 0;
  };
  [[nodiscard]] const Changed& changed() const { return changed_; }

 private:
  // Of one message.
  struct Own {
    const scenario::Fault* fault = nullptr;
    const MessageInfo* message = nullptr;
    const SignalInfo* signal = nullptr;
    std::int64_t seen = 0;  // frames within the fault's time
  };
  void put(Own& own, const Frame& frame);

  std::vector<Own> faults_;
  std::vector<Frame> left_, before_;
  Changed changed_;
};

}  // namespace canhil::drive
