#include "bench/faults/injector.hpp"

#include <algorithm>

namespace canhil::faults {

world::Stream InRun::stream(std::string_view part) const {
  return {seed, run_index, "fault." + fault.name + (part.empty() ? "" : "." + std::string(part))};
}

Switched::Switched(const When& when, const InRun& run)
    : rig_(run.hands), when_(when), tally_(run.tally), due_us_(when.from_us) {
  when_.to_us = std::min(when.to_us, run.end_us - 1);  // so no stretch begins at the end of the run
}

void Switched::transmit(std::vector<Frame>& /*out*/) {
  const std::int64_t now_us = due_us_;
  on_ = !on_;
  if (on_) {
    ++tally_.count;
    due_us_ = when_.each_us == 0 ? when_.to_us : std::min(now_us + when_.for_us, when_.to_us);
    ended_us_ = due_us_;
    return on(due_us_ - now_us);
  }
  const std::int64_t next_us = when_.from_us + (when_.period(now_us - 1) + 1) * when_.each_us;
  due_us_ = when_.each_us == 0 || next_us >= when_.to_us ? nodes::never_us : next_us;
  off();
}

Repeated::Repeated(const When& when, std::int64_t period_us, const InRun& run)
    : when_(when), period_us_(period_us), due_us_(when.from_us), tally_(run.tally) {}

void Repeated::transmit(std::vector<Frame>& out) {
  ++tally_.count;
  strike(out);
  due_us_ += period_us_;
  move_into_time();
}

void Repeated::move_into_time() {
  if (!when_.holds(due_us_) && when_.each_us != 0)
    due_us_ = when_.from_us + (when_.period(due_us_) + 1) * when_.each_us;
  if (due_us_ > when_.to_us) due_us_ = nodes::never_us;
}

}  // namespace canhil::faults
