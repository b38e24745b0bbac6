#include "bench/faults/of_frames.hpp"

#include <algorithm>

namespace canhil::faults {
namespace {

class ChangedFrames final : public OfFrames {
 public:
  ChangedFrames(const OfMessages& of, const When& when, const InRun& run, Change change)
      : OfFrames(of, when, run), change_(change) {}

 private:
  void put(Own& own, const Frame& frame, std::int64_t /*t_us*/, std::vector<Frame>& left) override {
    change_(*own.message, frame, left);
  }
  Change change_;
};

}  // namespace

OfFrames::OfFrames(const OfMessages& of, const When& when, const InRun& run) : tally_(run.tally) {
  for (const MessageInfo* message : of.all)
    own_.push_back({.message = message, .occasions = Occasions(run.in(when), run.stream(message->name))});
}

void OfFrames::apply(std::vector<Frame>& frames, std::int64_t t_us) {
  before_.swap(frames);
  frames.clear();
  for (const Frame& frame : before_) {
    const auto own = std::ranges::find_if(own_, [&](const Own& one) {
      return frame.id == one.message->id && frame.extended == one.message->extended && !frame.error;
    });
    if (own == own_.end()) {
      frames.push_back(frame);
    } else if (own->occasions.next(t_us)) {
      ++tally_.count;
      put(*own, frame, t_us, frames);
      own->before = true;
    } else {
      pass(*own, frame, frames);
      own->before = false;
    }
  }
}

std::unique_ptr<Injector> change_frames(const OfMessages& of, const When& when, const InRun& run,
                                        Change change) {
  return std::make_unique<ChangedFrames>(of, when, run, change);
}

}  // namespace canhil::faults
