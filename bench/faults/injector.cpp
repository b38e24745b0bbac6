#include "bench/faults/injector.hpp"

#include <algorithm>

namespace canhil::faults {

world::Stream InRun::stream(std::string_view part) const {
  return {seed, run_index, "fault." + fault.name + (part.empty() ? "" : "." + std::string(part))};
}

Switched::Switched(const When& when, const InRun& run)
    : rig_(run.hands), when_(run.in(when)), tally_(run.tally), due_us_(when.from_us) {
  when_.to_us = std::min(when.to_us, run.end_us - 1);  // so no stretch begins at the end of the run
}

std::int64_t Switched::due_us() const {
  if (when_.trigger == nullptr) return due_us_;
  if (on_) return when_.ends_us();
  return when_.begins_us() > begun_us_ ? when_.begins_us() : nodes::never_us;
}

void Switched::transmit(std::vector<Frame>& /*out*/) {
  const std::int64_t now_us = due_us();
  on_ = !on_;
  if (when_.trigger != nullptr) {
    if (!on_) {
      ended_us_ = now_us;
      return off();
    }
    ++tally_.count;
    begun_us_ = when_.begins_us();
    ended_us_ = when_.ends_us();
    return on(ended_us_ - now_us);
  }
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
    : when_(run.in(when)),
      period_us_(period_us),
      due_us_(when.begins_in_run() ? 0 : when.from_us),
      tally_(run.tally) {}

std::int64_t Repeated::due_us() const {
  if (when_.trigger == nullptr) return due_us_;
  const std::int64_t next_us = std::max(due_us_, when_.begins_us());
  return next_us > when_.ends_us() ? nodes::never_us : next_us;
}

void Repeated::transmit(std::vector<Frame>& out) {
  ++tally_.count;
  strike(out);
  due_us_ = due_us() + period_us_;
  if (when_.trigger == nullptr) move_into_time();
}

void Repeated::move_into_time() {
  if (!when_.holds(due_us_) && when_.each_us != 0)
    due_us_ = when_.from_us + (when_.period(due_us_) + 1) * when_.each_us;
  if (due_us_ > when_.to_us) due_us_ = nodes::never_us;
}

}  // namespace canhil::faults
