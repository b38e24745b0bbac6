#include "bench/drive/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "bench/drive/dialect.hpp"
#include "bench/drive/judged.hpp"
#include "bench/faults/in_run.hpp"
#include "bench/observe/load_meter.hpp"
#include "bench/scenario/binding.hpp"
#include "dbc/logs/candump.hpp"
#include "messages/canhil.hpp"

namespace canhil::drive {
namespace {

constexpr std::string_view unknown_lateness = "a recording does not say when its frames were due";

// Acts on nothing, because the recorded frames already contain the effects of faults that act on the target
// or on the interface.
class NoRigControl final : public faults::RigControl {
 public:
  explicit NoRigControl(const std::unique_ptr<observe::Watcher>& watcher) : watcher_(watcher) {}
  void pause_target() override {}
  void resume_target() override {}
  void restart_target(std::int64_t /*t_us*/) override { watcher_->target_restarts(); }
  void report_error(const Frame& /*error*/) override {}
  void interface_down(std::int64_t /*for_us*/) override {}
  void interface_up() override {}

 private:
  const std::unique_ptr<observe::Watcher>& watcher_;
};

const MessageInfo* find(std::span<const MessageInfo> messages, const Frame& frame) {
  const auto found = std::ranges::find_if(messages, [&](const MessageInfo& info) {
    return info.id == frame.id && info.extended == frame.extended && !frame.error;
  });
  return found == messages.end() ? nullptr : &*found;
}

// Reads the entries of a log, with a look-ahead of one.
class Frames {
 public:
  static Result<Frames> open(const LogFile& log) {
    auto reader = log.read();
    if (!reader) return tl::unexpected(reader.error());
    Frames frames(std::move(*reader));
    if (auto read = frames.advance(); !read) return tl::unexpected(read.error());
    return frames;
  }
  [[nodiscard]] const std::optional<LogEntry>& next() const { return next_; }
  Result<void> advance() {
    auto entry = reader_.next();
    if (!entry) return tl::unexpected(entry.error());
    next_ = std::move(*entry);
    return {};
  }

 private:
  explicit Frames(LogReader reader) : reader_(std::move(reader)) {}
  ClassicLogReader reader_;
  std::optional<LogEntry> next_;
};

// The clock and the format of the recorded run, derived from its frames.
struct Manner {
  bool lockstep = false;
  bool in_process = false;
  BusFormat format = BusFormat::classic;
};

// The first Sync shows whether the run was in lockstep; a CAN FD frame shows that messages were packed in
// containers.
Result<Manner> manner_of(const LogFile& log, const scenario::Scenario& scenario) {
  auto reader = log.read();
  if (!reader) return tl::unexpected(reader.error());
  Manner manner{.format = format_of(scenario)};
  // A mapped target receives no Sync. In virtual time, its frames have the stamp of the bench's frame before.
  std::optional<std::int64_t> last_ns;
  bool at_once = true;
  for (;;) {
    const auto entry = reader->next();
    if (!entry) return tl::unexpected(entry.error());
    if (!*entry) {
      manner.lockstep = !scenario.binding->time_base && at_once;
      return manner;
    }
    if (!scenario.binding->time_base) {
      const MessageInfo* message = find(scenario.binding->messages, (*entry)->frame);
      if (message != nullptr && scenario.binding->is_of_events(*message)) continue;
      const bool target = message != nullptr && is_targets(*message);
      at_once = at_once && (!target || last_ns.value_or((*entry)->t_ns) == (*entry)->t_ns);
      last_ns = (*entry)->t_ns;
      continue;
    }
    manner.in_process = BusName((*entry)->interface).in_process;
    const Frame& frame = (*entry)->frame;
    if (frame.fd) manner.format = BusFormat::fd;
    const FdUnpacked unpacked(frame);
    for (const Frame& one : unpacked.frames()) {
      if (one.id != messages::Sync::info.id || one.size != messages::Sync::size || one.error) continue;
      manner.lockstep = from_frame<messages::Sync>(one).lockstep != 0;
      return manner;
    }
  }
}

observe::LoadBy load_by(const scenario::Scenario& scenario, const Manner& manner) {
  if (!scenario.binding->time_base) return observe::LoadBy::virtual_time;
  return manner.in_process ? observe::LoadBy::time_base_alone : observe::LoadBy::time_base;
}

class Recording {
 public:
  Recording(const scenario::Scenario& scenario, const world::FlightRecord& truth, Flight flight,
            Frames frames, std::string log, Manner manner, observe::Observer* also)
      : scenario_(scenario),
        flight_(std::move(flight)),
        truth_(flight_of(truth, flight_.per_run_truth)),
        frames_(std::move(frames)),
        log_(std::move(log)),
        manner_(manner),
        also_(also),
        load_(manner.format, load_by(scenario, manner)) {}

  Result<Collected> judge() {
    auto dialect = make_dialect({.scenario = scenario_,
                                 .truth = truth_,
                                 .flight = flight_,
                                 .virtual_time = manner_.lockstep,
                                 .format = manner_.format,
                                 .of_log = true});
    if (!dialect) return tl::unexpected(dialect.error());
    dialect_ = std::move(*dialect);
    schedule_ = dialect_->schedule(
        std::make_unique<faults::Faults>(scenario_, 0, scenario_.binding->messages,
                                         faults::Place{.virtual_time = manner_.lockstep,
                                                       .starts_target = true,
                                                       .handshake = scenario_.binding->handshake,
                                                       .fd = format_of(scenario_) != BusFormat::classic},
                                         &hands_));
    schedule_->set_truth(truths_of(truth_, flight_.per_run_truth));
    watcher_ = dialect_->watcher(true);
    target_ = dialect_->target_watch(true);
    observers_ = {watcher_.get(), target_.get(), &load_};
    if (also_ != nullptr) observers_.push_back(also_);
    dialogue_ = dialect_->dialogue();
    auto ending = replay();
    if (!ending) return tl::unexpected(ending.error());
    ending = with_end_of_plant(std::move(*ending), flight_.per_run_truth, scenario_.duration_us);
    schedule_->end();
    checks::Observations seen = expecting(watcher_->finish(), *schedule_->faults(), scenario_);
    seen.clipped = schedule_->outbox().clipped().to_text();
    seen.length_by_second = load_.lengths();
    seen.exchanges = dialect_->exchanges();
    return Collected{.ending = std::move(*ending),
                     .seen = std::move(seen),
                     .per_run_truth = std::move(flight_.per_run_truth),
                     .faults = schedule_->faults()->reports()};
  }
  [[nodiscard]] double wall_s() const { return static_cast<double>(last_ns_ - first_ns_) / 1e9; }
  [[nodiscard]] std::int64_t started_s() const { return first_ns_ / 1'000'000'000; }

 private:
  Result<Ending> replay() {
    std::int64_t t_us = 0;
    while (schedule_->due_us() != nodes::never_us) {
      if (auto heard = hear(); !heard)
        return tl::unexpected(heard.error());  // before the nodes transmit again
      t_us = schedule_->due_us();
      load_.time_set(t_us * 1000);
      for (const Frame& frame : schedule_->take()) {
        if (auto heard = hear(); !heard) return tl::unexpected(heard.error());
        if (!frames_.next()) return ended_at(t_us);
        if (auto same = expect(frame, t_us); !same) return tl::unexpected(same.error());
      }
      if (auto fault = target_->fault()) return Ending{Ending::Kind::target_fault, t_us, *fault};
    }
    flown_ = true;
    if (auto heard = hear(); !heard) return tl::unexpected(heard.error());
    if (auto fault = target_->fault()) return Ending{Ending::Kind::target_fault, t_us, *fault};
    return Ending{Ending::Kind::completed, t_us, ""};
  }

  Result<Ending> ended_at(std::int64_t t_us) const {
    if (!begun_) return failure(fmt::format("{}: no frame of the bench, expected the log of a run", log_));
    return Ending{Ending::Kind::interrupted, t_us,
                  fmt::format("the recording ends at t={:.3f} s", static_cast<double>(t_us) / 1e6)};
  }

  // Passes to the observers all recorded frames that come before the bench's next frame. Skips the frames of
  // the handshake, because they are not part of the flight.
  Result<void> hear() {
    for (; frames_.next();) {
      const LogEntry& entry = *frames_.next();
      const MessageInfo* message = find(scenario_.binding->messages, entry.frame);
      const bool target = message != nullptr && is_targets(*message);
      if (message != nullptr && scenario_.binding->is_of_events(*message)) {
        hear_event(entry, target);
        if (auto read = frames_.advance(); !read) return tl::unexpected(read.error());
        continue;
      }
      const bool handshake =
          message != nullptr && !target && scenario_.binding->handshake && message->cycle_time_us == 0;
      if (!target && !handshake && (message != nullptr || entry.transmitted)) return {};
      over_ = over_ || (flown_ && handshake);  // the bench stops the target
      if (begun_ && !handshake && !over_) hear(entry);
      if (auto read = frames_.advance(); !read) return tl::unexpected(read.error());
    }
    return {};
  }
  // What an event sends depends on the target, so the log alone says what it sent, and when. Events may come
  // before the flight and after it.
  void hear_event(const LogEntry& entry, bool target) {
    for (observe::Observer* observer :
         {dialogue_, begun_ && !over_ ? static_cast<observe::Observer*>(&load_) : nullptr}) {
      if (observer == nullptr) continue;
      if (target)
        observer->received({.frame = entry.frame, .t_ns = entry.t_ns});
      else
        observer->transmitted(entry.frame, entry.t_ns, 0);
    }
  }
  void hear(const LogEntry& entry) {
    const Received received{.frame = entry.frame, .t_ns = entry.t_ns};
    last_ns_ = entry.t_ns;
    for (observe::Observer* observer : observers_) observer->received(received);
    if (schedule_->listens()) schedule_->received(received);
  }

  Result<void> expect(const Frame& frame, std::int64_t t_us) {
    const LogEntry& entry = *frames_.next();
    if (entry.frame != frame) {
      const auto shown = [](Frame one) {
        return format_log_line({.interface = "bus", .frame = one}).substr(15);
      };
      const MessageInfo* message = find(scenario_.binding->messages, frame);
      return failure(fmt::format("{}: is not of {}: at t={:.3f} s it has {}, the scenario sends {}{}", log_,
                                 scenario_.file, static_cast<double>(t_us) / 1e6, shown(entry.frame),
                                 shown(frame),
                                 message == nullptr ? "" : fmt::format(" ({})", message->name)));
    }
    if (!std::exchange(begun_, true)) {
      first_ns_ = entry.t_ns;
      first_us_ = t_us;
    }
    last_ns_ = entry.t_ns;
    if (manner_.lockstep) target_->closes_step(frame);
    // The lateness relative to the frame's deadline, assuming that the first frame was on time.
    const std::int64_t late_ns =
        std::max<std::int64_t>(entry.t_ns - first_ns_ - (t_us - first_us_) * 1000, 0);
    for (observe::Observer* observer : observers_)
      observer->transmitted(frame, entry.t_ns, manner_.lockstep ? 0 : late_ns);
    return frames_.advance();
  }

  const scenario::Scenario& scenario_;
  Flight flight_;
  const world::FlightRecord& truth_;
  Frames frames_;
  std::string log_;
  Manner manner_;
  observe::Observer* also_;  // null: none
  NoRigControl hands_{watcher_};
  std::unique_ptr<Dialect> dialect_;
  std::unique_ptr<Schedule> schedule_;
  std::unique_ptr<observe::Watcher> watcher_;
  std::unique_ptr<observe::TargetWatch> target_;
  observe::Observer* dialogue_ = nullptr;
  observe::LoadMeter load_;
  std::vector<observe::Observer*> observers_;
  bool begun_ = false;
  bool flown_ = false;  // the bench has sent the last frame of the schedule
  bool over_ = false;
  std::int64_t first_ns_ = 0, last_ns_ = 0;  // stamps
  std::int64_t first_us_ = 0;                // deadline of the first frame
};

}  // namespace

Result<Run> judge_recording(const scenario::Scenario& scenario, const std::string& log,
                            observe::Observer* also) {
  if (!scenario.programs.empty())
    return failure(
        fmt::format("{}: has [[node]], and a log does not say what its programs changed, expected a "
                    "scenario without",
                    scenario.file));
  if (auto begins = faults::check_begins(scenario, false); !begins) return tl::unexpected(begins.error());
  auto truth = make_truth(scenario);
  if (!truth) return failure(fmt::format("{}: {}", scenario.file, truth.error().message));
  auto flight = make_flight(scenario, *truth, 0);
  if (!flight) return failure(fmt::format("{}: {}", scenario.file, flight.error().message));
  const auto file = LogFile::open(log);
  if (!file) return tl::unexpected(file.error());
  const auto manner = manner_of(*file, scenario);
  if (!manner) return tl::unexpected(manner.error());
  if (!scenario.plant.steered.empty() && !manner->lockstep)
    return failure(fmt::format(
        "{}: is of a run in real time, whose commands steered the plant at times that a log does not keep "
        "exactly, expected the log of a run in lockstep",
        log));
  auto frames = Frames::open(*file);
  if (!frames) return tl::unexpected(frames.error());
  Recording recording(scenario, *truth, std::move(*flight), std::move(*frames), log, *manner, also);
  auto flown = recording.judge();
  if (!flown) return tl::unexpected(flown.error());
  std::string timing_unfit(manner->lockstep ? checks::virtual_time : unknown_lateness);
  Options options;
  options.bus = BusName("log:" + log);
  options.lockstep = manner->lockstep;
  options.format = manner->format;
  std::vector<RunFile> files = files_of(scenario, options, true);
  if (auto identity = identify_file(log)) files.push_back({"log", log, std::move(*identity)});
  return Run{.verdict = verdict_of(scenario, *truth, *flown, timing_unfit),
             .ending = std::move(flown->ending),
             .seen = std::move(flown->seen),
             .truth = std::move(*truth),
             .per_run_truth = std::move(flown->per_run_truth),
             .faults = std::move(flown->faults),
             .options = std::move(options),
             .clock = manner->lockstep ? ClockKind::lockstep : ClockKind::real_time,
             .timing_unfit = std::move(timing_unfit),
             .files = std::move(files),
             .wall_s = recording.wall_s(),
             .started_s = recording.started_s()};
}

}  // namespace canhil::drive
