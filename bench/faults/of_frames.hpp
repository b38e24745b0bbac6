// Faults of frames on their way to the bus, message by message.
#pragma once

#include <optional>
#include <vector>

#include "bench/faults/injector.hpp"
#include "bench/faults/read.hpp"

namespace canhil::faults {

class OfFrames : public Injector {
 public:
  OfFrames(const OfMessages& of, const When& when, const InRun& run);

  void befall(std::vector<Frame>& frames, std::int64_t t_us) final;

 protected:
  // Of one message.
  struct Own {
    const MessageInfo* message = nullptr;
    Occasions occasions;
    std::optional<std::uint8_t> counter{};  // for kinds that keep one
    std::optional<Frame> held{};            // for kinds that keep one back
    bool before = false;                    // the frame before was befallen
  };
  /// Appends what becomes of a befallen frame.
  virtual void put(Own& own, const Frame& frame, std::int64_t t_us, std::vector<Frame>& left) = 0;
  /// The same of one that is not.
  virtual void pass(Own& /*own*/, const Frame& frame, std::vector<Frame>& left) { left.push_back(frame); }
  Tally& tally() { return tally_; }

 private:
  std::vector<Own> own_;
  std::vector<Frame> before_;
  Tally& tally_;
};

/// What a fault does to one frame, whatever came before: appends what is left of it.
using Change = void (*)(const MessageInfo& message, const Frame& frame, std::vector<Frame>& left);

/// A kind that is no more than that.
std::unique_ptr<Injector> change_frames(const OfMessages& of, const When& when, const InRun& run,
                                        Change change);

}  // namespace canhil::faults
