// The base class of faults that change frames on their way to the bus. Each message has its own state.
#pragma once

#include <optional>
#include <vector>

#include "bench/faults/injector.hpp"
#include "bench/faults/read.hpp"

namespace canhil::faults {

class OfFrames : public Injector {
 public:
  OfFrames(const OfMessages& of, const When& when, const InRun& run);

  void apply(std::vector<Frame>& frames, std::int64_t t_us) final;

 protected:
  // The state kept for one message.
  struct Own {
    const MessageInfo* message = nullptr;
    Occasions occasions;
    std::optional<std::uint64_t> counter{};  // for kinds that remember a counter
    std::optional<Frame> held{};             // for kinds that hold a frame back
    bool before = false;                     // the previous frame of the message was affected
  };
  /// Appends to `left` the frames that are sent in place of an affected frame.
  virtual void put(Own& own, const Frame& frame, std::int64_t t_us, std::vector<Frame>& left) = 0;
  /// Appends to `left` the frames that are sent in place of an unaffected frame.
  virtual void pass(Own& /*own*/, const Frame& frame, std::vector<Frame>& left) { left.push_back(frame); }
  Tally& tally() { return tally_; }

 private:
  std::vector<Own> own_;
  std::vector<Frame> before_;
  Tally& tally_;
};

/// Appends to `left` the frames that are sent in place of `frame`; does not depend on earlier frames.
using Change = void (*)(const MessageInfo& message, const Frame& frame, std::vector<Frame>& left);

/// A fault that applies `change` to each affected frame.
std::unique_ptr<Injector> change_frames(const OfMessages& of, const When& when, const InRun& run,
                                        Change change);

}  // namespace canhil::faults
