#include "bench/faults/kinds/target.hpp"

#include <cmath>

#include "bench/scenario/rule.hpp"
#include "bench/scenario/section.hpp"
#include "messages/canhil.hpp"

namespace canhil::faults {
namespace {

using scenario::Limits;

std::string needs_process(const Place& place) {
  if (place.in_process) return "needs a process, expected a bus that is not in-process";
  return place.starts_target ? "" : "needs a target that hil-bench starts, expected none that runs elsewhere";
}

std::string needs_clock(const Place& place) {
  if (std::string why = needs_process(place); !why.empty()) return why;
  return place.virtual_time ? "has no effect in virtual time, which waits for the target, expected real time"
                            : "";
}

class Pauses final : public Switched {
 public:
  using Switched::Switched;

 private:
  void on(std::int64_t /*for_us*/) override { rig_->pause_target(); }
  void off() override { rig_->resume_target(); }
  [[nodiscard]] bool silences() const override { return true; }
};

// Restarts the target when a Sync is due. The new process receives this Sync first, as at the start of a run.
class Restarts final : public Injector {
 public:
  Restarts(const When& when, const InRun& run) : rig_(run.hands), tally_(run.tally), from_us_(when.from_us) {}
  void apply(std::vector<Frame>& frames, std::int64_t t_us) override {
    const bool is_sync = !frames.empty() && frames.front().id == messages::Sync::info.id;
    if (done_ || t_us < from_us_ || !is_sync) return;
    done_ = true;
    ++tally_.count;
    rig_->restart_target(t_us);
  }

 private:
  RigControl* rig_;
  Tally& tally_;
  std::int64_t from_us_;
  bool done_ = false;
};

}  // namespace

Paused Paused::read(scenario::Section& section, const scenario::FaultContext& context) {
  return {.when = read_stretches(section, context)};
}
std::string Paused::cannot(const Place& place) const { return needs_clock(place); }
std::unique_ptr<Injector> Paused::injector(const InRun& run) const {
  return std::make_unique<Pauses>(when, run);
}

Slowed Slowed::read(scenario::Section& section, const scenario::FaultContext& context) {
  Slowed kind{.when = {.from_us = section.time_us({"from_s", "Time at which the fault begins."},
                                                  Limits::at_least(0), 0),
                       .to_us = section
                                    .optional_time_us({"to_s",
                                                       "Time at which the fault ends; by default the end of "
                                                       "the run."},
                                                      Limits::at_least(0))
                                    .value_or(context.duration_us)},
              .share = section.number({"cpu_percent", "Share of each period in which the process runs."},
                                      {.least = 1, .most = 99}),
              .period_us = section.time_us({"period_ms", "Time from one stop of the process to the next."},
                                           Limits::between(1, 1000), 10)};
  scenario::expect_within_run(section, "to_s", kind.when.to_us, context.duration_us);
  if (kind.when.to_us < kind.when.from_us) section.reject("to_s", "is before from_s", "a later time");
  return kind;
}
std::string Slowed::cannot(const Place& place) const { return needs_clock(place); }
std::unique_ptr<Injector> Slowed::injector(const InRun& run) const {
  When stops = when;
  stops.each_us = period_us;
  stops.for_us = std::llround(static_cast<double>(period_us) * (1 - share));
  return std::make_unique<Pauses>(stops, run);
}

Restarted Restarted::read(scenario::Section& section, const scenario::FaultContext& context) {
  Restarted kind;
  kind.when.from_us = scenario::read_time(section, {"from_s", "Time at which the fault begins."},
                                          Limits::at_least(0), context.duration_us);
  kind.when.to_us = kind.when.from_us;
  return kind;
}
std::string Restarted::cannot(const Place& place) const {
  if (!place.handshake)
    return "has no handshake in a mapping, expected a target that speaks canhil's contract";
  return needs_process(place);
}
std::unique_ptr<Injector> Restarted::injector(const InRun& run) const {
  return std::make_unique<Restarts>(when, run);
}

}  // namespace canhil::faults
