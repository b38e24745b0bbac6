#include "bench/drive/session.hpp"

#include <fmt/format.h>

#include <csignal>
#include <list>
#include <utility>

#include "bench/checks/other_senders.hpp"
#include "bench/checks/timing.hpp"
#include "bench/drive/bus_facts.hpp"
#include "bench/drive/dialect.hpp"
#include "bench/drive/judged.hpp"
#include "bench/drive/lockstep.hpp"
#include "bench/drive/rig_commands.hpp"
#include "bench/drive/rig_control.hpp"
#include "bench/drive/run_partners.hpp"
#include "bench/drive/stimuli.hpp"
#include "bench/drive/target_process.hpp"
#include "bench/estimators/of_scenario.hpp"
#include "bench/observe/bus_watch.hpp"
#include "bench/observe/delay_watch.hpp"
#include "bench/observe/host_watch.hpp"
#include "bench/observe/intruders.hpp"
#include "bench/observe/load_meter.hpp"
#include "bench/observe/recorder.hpp"
#include "bench/scenario/binding.hpp"
#include "bench/world/stoppable.hpp"

namespace canhil::drive {
namespace {

constexpr std::int64_t step_limit_ns = 5'000'000'000;

// One run, stage by stage: open, configure, drive, collect.
class Session {
 public:
  // Opens bus and log and starts the target. All arguments except `flight` must outlive the session.
  static Result<std::unique_ptr<Session>> open(const scenario::Scenario& scenario,
                                               const world::FlightRecord& truth, Flight flight,
                                               const Options& options) {
    const std::vector<int> cpus = options.target_cpu        ? std::vector{*options.target_cpu}
                                  : options.targets.empty() ? std::vector<int>{}
                                                            : realtime::cpus();
    if (options.realtime) {
      if (auto entered = realtime::enter(*options.realtime); !entered) return tl::unexpected(entered.error());
    }
    auto buses = open_buses(options.bus, options.bus_of, options.format, scenario.binding.get());
    if (!buses) return tl::unexpected(buses.error());
    auto session = std::make_unique<Session>(scenario, truth, std::move(flight), options, std::move(*buses));
    if (auto spoken = session->speak(); !spoken) return tl::unexpected(spoken.error());
    if (auto logged = session->open_log(); !logged) return tl::unexpected(logged.error());
    if (auto started = session->start_target(cpus); !started) return tl::unexpected(started.error());
    return session;
  }

  Session(const scenario::Scenario& scenario, const world::FlightRecord& truth, Flight flight,
          const Options& options, OpenBuses buses)
      : scenario_(scenario),
        options_(options),
        flight_(std::move(flight)),
        notes_(std::move(buses.notes)),
        others_(std::move(buses.others)),
        port_(std::move(buses.port)),
        bus_(known_of(*port_, options.controller)),
        clock_(clock_of(bus_.time, options.lockstep)),
        truth_(flight_of(truth, flight_.per_run_truth)),
        hands_(options.bus.text, targets_, link_, [this](std::int64_t t_us) { restart_target(t_us); }),
        link_(*port_),
        bus_watch_(*port_),
        load_(options.format, load_by(bus_, clock_, scenario.binding->time_base)),
        commands_(rig_commands_of(scenario)) {
    RunPartners::prepare(scenario, options, flight_.per_run_truth);
  }

  // Creates the dialect. After this call the session is complete.
  Result<void> speak() {
    auto dialect = make_dialect({.scenario = scenario_,
                                 .truth = truth_,
                                 .flight = flight_,
                                 .run_index = options_.run_index,
                                 .in_process = bus_.in_process,
                                 .virtual_time = clock_ == ClockKind::lockstep,
                                 .rounding = bus_.rounding,
                                 .format = options_.format,
                                 .wire = bus_.wire,
                                 .programs = options_.targets.size(),
                                 .others = others_});
    if (!dialect) return tl::unexpected(dialect.error());
    dialect_ = std::move(*dialect);
    const faults::Place where = place();
    if (auto work = faults::check(scenario_.faults, where); !work) return work;
    auto begins = faults::check_begins(scenario_, flight_.per_run_truth.overrides != nullptr);
    if (!begins) return begins;
    schedule_ = dialect_->schedule(std::make_unique<faults::Faults>(
        scenario_, options_.run_index, scenario_.binding->messages, where, &hands_));
    schedule_->set_truth(truths_of(truth_, flight_.per_run_truth));
    schedule_->set_stopped(flight_.per_run_truth.stopped);
    if (flight_.per_run_truth.overrides) {
      partners_.emplace(scenario_, truth_, flight_.per_run_truth, *schedule_);
      if (auto joined = partners_->join(options_, clock_ != ClockKind::real_time); !joined) return joined;
    }
    // A campaign against a program judges the causes of its answers, which needs their stimuli.
    watcher_ = dialect_->watcher(options_.for_verdict || !options_.targets.empty());
    if (!options_.for_verdict) return {};
    link_.attach(bus_watch_);
    link_.attach(intruders_.emplace(scenario_.binding->messages));
    return {};
  }

  // Configures the target and starts its estimators.
  Result<void> configure(const std::atomic<bool>& stop) {
    auto ready = commands_.begin(stop);
    if (!ready) return failure(fmt::format("{}: {}", scenario_.file, ready.error().message));
    ready = dialect_->configure(link_, schedule_->outbox(), [&] { return gone(stop); });
    if (!ready) return failure(explained(ready.error().message) + log_of_the_handshake());
    return ready;
  }

  // Flies to the end, or as far as possible.
  void drive(const std::atomic<bool>& stop, const Progress& progress) {
    stop_ = &stop;
    const Attached monitored(link_, *watcher_);
    std::optional<Attached> load_watched, host_watched;
    if (options_.for_verdict) {
      load_watched.emplace(link_, load_);
      host_watched.emplace(
          link_, host_.emplace(port_->stamp_clock(), options_.offers_realtime && !options_.realtime));
      if (clock_ == ClockKind::real_time)
        delay_watches_.emplace(targets_.ids(), options_.realtime.has_value());
    }
    std::list<Attached> looking_on;
    for (Onlooker* one : options_.onlookers) {
      one->departs(departure());
      looking_on.emplace_back(link_, *one);
    }
    std::optional<Attached> listening;
    if (schedule_->listens()) listening.emplace(link_, *schedule_);
    if (options_.realtime && !targets_.empty())
      static_cast<void>(realtime::own_memory_again());  // locking memory was permitted at the start
    const auto target = dialect_->target_watch(bus_.in_process);
    const Gone is_gone = [this] { return gone(false); };
    ending_ = clock_ == ClockKind::lockstep
                  ? run_lockstep(link_, *schedule_, *target, step_limit_ns, stop, progress, is_gone)
                  : run_real_time(link_, *schedule_, *target, dialect_->silence_limit_ns(), stop, progress,
                                  options_.spin_ns, is_gone);
    if (delay_watches_) delays_ = delay_watches_->record();
    ending_ = with_end_of_plant(std::move(ending_), flight_.per_run_truth, scenario_.duration_us);
  }

  // Stops the target, closes the log and ends the target's process.
  Collected collect() {
    schedule_->end();
    if (ending_.kind == Ending::Kind::target_silent) ending_.detail += why_silent();
    const auto ended_before = targets_.ended();
    if (options_.for_verdict) dialect_->stop(link_, schedule_->outbox());
    commands_.finish();
    for (Onlooker* one : options_.onlookers) one->landed();
    const auto logged = log_ ? log_->close() : Result<void>{};
    checks::Observations seen = expecting(watcher_->finish(), *schedule_->faults(), scenario_);
    seen.clipped = schedule_->outbox().clipped().to_text();
    seen.exchanges = dialect_->exchanges();
    if (options_.for_verdict) add_watched(seen);
    if (partners_) partners_->add_to(seen);
    end_target(ended_before, seen.bus.notes);
    if (ending_.kind != Ending::Kind::completed) ending_.detail = explained(ending_.detail);
    return Collected{.ending = std::move(ending_),
                     .seen = std::move(seen),
                     .per_run_truth = std::move(flight_.per_run_truth),
                     .faults = schedule_->faults()->reports(),
                     .log_error = logged ? std::nullopt : std::optional(logged.error())};
  }

  [[nodiscard]] const Capabilities& bus() const { return bus_; }
  [[nodiscard]] const checks::TargetDelays& delays() const { return delays_; }
  [[nodiscard]] ClockKind clock() const { return clock_; }
  // Adds the possible cause to an error message: a flood of frames, or the first note of the bus.
  [[nodiscard]] std::string explained(const std::string& what) const {
    if (link_.flood()) return fmt::format("{}; {}", what, to_text(*link_.flood()));
    return notes_->empty() ? what : fmt::format("{}; {}", what, notes_->front());
  }
  // Why timing cannot be judged; empty: it can.
  [[nodiscard]] std::string timing_unfit(const checks::Observations& seen) const {
    if (clock_ == ClockKind::lockstep) return std::string(checks::virtual_time);
    return link_.flood() ? to_text(*link_.flood()) : checks::unfit_for_timing(seen);
  }

 private:
  Result<void> open_log() {
    if (!options_.log_path) return {};
    return observe::Recorder::open(*options_.log_path, *port_).map([&](auto log) {
      link_.attach(*(log_ = std::move(log)));
    });
  }

  // Why waiting for the target is pointless; none: the bench can wait.
  std::optional<std::string> gone(bool stop) {
    if (stop) return "interrupted";
    const auto failed = flight_.per_run_truth.why_failed();
    return failed ? failed : targets_.ended();
  }

  [[nodiscard]] Departure departure() {
    Departure departure{.scenario = scenario_,
                        .truth = truth_,
                        .per_run_truth = flight_.per_run_truth,
                        .real_time = clock_ == ClockKind::real_time,
                        .format = options_.format,
                        .wire = bus_.wire,
                        .load_by = load_by(bus_, clock_, scenario_.binding->time_base)};
    if (dialect_->watches_frames_alone())
      departure.watcher = [this](bool with_times) { return dialect_->watcher(with_times); };
    return departure;
  }

  // The properties of the run that faults depend on.
  [[nodiscard]] faults::Place place() const {
    const InterfaceFacts interface =
        scenario_.faults.empty() ? InterfaceFacts{} : interface_facts(options_.bus.text);
    return {.bus = options_.bus.text,
            .interface = interface.kind,
            .may_set_interface = interface.may_set,
            .virtual_time = clock_ != ClockKind::real_time,
            .in_process = bus_.in_process,
            .starts_target = !options_.targets.empty() && !bus_.in_process,
            .handshake = scenario_.binding->handshake,
            .fd = options_.format != BusFormat::classic,
            .wire = bus_.wire};
  }

  // Restarts the target for a fault. If the restart fails, the target stays silent, which ends the run.
  void restart_target(std::int64_t t_us) {
    targets_.kill();
    watcher_->target_restarts();
    auto ready = start_target(target_cpus_);
    if (ready && delay_watches_) delay_watches_->follow(targets_.ids());
    flight_.initial = initial_states(scenario_, truth_, flight_.per_run_truth, options_.run_index, t_us);
    if (ready) ready = dialect_->configure(link_, schedule_->outbox(), [&] { return gone(*stop_); });
    if (!ready) restart_error_ = "; restarted: " + ready.error().message;
  }

  Result<void> start_target(const std::vector<int>& cpus) {
    if (bus_.in_process) return {};
    target_cpus_ = cpus;
    std::vector<std::string> arguments = options_.target_arguments;
    // On CAN FD, every target gets the option --dbc, so that the target uses the same DBC as the bench.
    if (options_.format == BusFormat::fd)
      arguments.insert(arguments.end(), {"--dbc", std::string(name_of(options_.format))});
    return targets_.start(options_.targets, options_.bus.text, arguments, cpus);
  }

  // Closes the log of a run that did not begin. Returns the name of the log, for the end of an error message.
  std::string log_of_the_handshake() {
    if (!log_) return {};
    const auto name = log_->close_early();
    if (!name) return "; " + name.error().message;
    return name->empty() ? "" : fmt::format("; the log of the handshake is '{}'", *name);
  }

  std::string why_silent() {
    if (!restart_error_.empty()) return restart_error_;
    if (targets_.stopped()) return " (its process is stopped by a signal)";
    if (clock_ == ClockKind::lockstep) return {};
    return load_.full_wire(ending_.t_us * 1000 + dialect_->silence_limit_ns(), bus_.wire.rates);
  }

  // Ends the target's process. `ended_before`: how it ended before the bench stopped it; none: it did not.
  void end_target(const std::optional<std::string>& ended_before, std::vector<std::string>& notes) {
    if (targets_.empty()) return;
    const bool judged = ending_.kind != Ending::Kind::interrupted;
    const auto patience = judged ? ChildProcess::usual_patience : ChildProcess::short_patience;
    const TargetPrograms::End end = targets_.end(patience);
    if (!judged) return;
    if (end.any_killed)
      notes.push_back(fmt::format("the target did not end within {} s after SIGTERM and was killed",
                                  patience.count() / 1000));
    ending_ = with_process_end(std::move(ending_), ended_before, end.of);
  }

  // The note about other senders on the bus comes before all other notes.
  void add_watched(checks::Observations& seen) {
    seen.bus = bus_watch_.record();
    seen.bus.intruded = intruders_->frames();
    if (const std::string others = checks::other_senders(seen); !others.empty())
      notes_->insert(notes_->begin(), others);
    // The host does not affect the times of a simulated wire.
    if (clock_ != ClockKind::simulated_wire) seen.host = host_->record();
    seen.bit_rates = bus_.wire.rates;
    seen.length_by_second = load_.lengths();
    seen.bus.reports_errors = bus_.reports_errors;
    seen.bus.late_in_queue = link_.late_in_queue();
    seen.bus.foreign = port_->counters().foreign;
    seen.bus.notes = *notes_;
    if (link_.flood()) seen.bus.notes.push_back(to_text(*link_.flood()));
    seen.receive_overflows = static_cast<std::uint32_t>(port_->counters().overflowed);
  }

  const scenario::Scenario& scenario_;
  const Options& options_;
  Flight flight_;
  std::shared_ptr<std::vector<std::string>> notes_;
  Others others_;
  std::unique_ptr<Port> port_;
  Capabilities bus_;
  ClockKind clock_;
  const world::FlightRecord& truth_;
  RunRigControl hands_;
  Link link_;
  std::unique_ptr<Dialect> dialect_;
  std::optional<RunPartners>
      partners_;  // before the schedule, whose nodes refer to it; none: the run has none
  std::unique_ptr<Schedule> schedule_;
  std::unique_ptr<observe::Watcher> watcher_;
  observe::BusWatch bus_watch_;
  std::optional<observe::Intruders> intruders_;
  observe::LoadMeter load_;
  std::optional<observe::HostWatch> host_;  // watches from its construction on
  checks::TargetDelays delays_;
  std::unique_ptr<observe::Recorder> log_;
  TargetPrograms targets_;
  std::optional<observe::DelayWatches> delay_watches_;
  RigCommands commands_;  // after the target: `after` runs before the target's process ends
  const std::atomic<bool>* stop_ = nullptr;  // of the flight
  std::vector<int> target_cpus_;
  std::string restart_error_;
  Ending ending_;
};

}  // namespace

Result<Run> run(const scenario::Scenario& scenario, const Options& options, const std::atomic<bool>& stop,
                const Progress& progress) {
  const auto in_file = [&](const Error& error) {
    return failure(fmt::format("{}: {}", scenario.file, error.message));
  };
  const world::Stoppable stoppable(stop);
  auto truth = make_truth(scenario);
  if (!truth) return in_file(truth.error());
  auto flight = make_flight(scenario, *truth, options.run_index);
  if (!flight) return in_file(flight.error());
  if (auto fits = check_stimuli(scenario, *truth, options.run_index, stop); !fits)
    return in_file(fits.error());
  std::vector<RunFile> files = files_of(scenario, options, options.bus.in_process);
  const auto opened = Session::open(scenario, *truth, std::move(*flight), options);
  if (!opened) return tl::unexpected(opened.error());
  Session& session = **opened;
  if (auto ready = session.configure(stop); !ready) return tl::unexpected(ready.error());
  const std::int64_t start_ns = clock_ns(CLOCK_MONOTONIC);
  const std::int64_t started_s = clock_ns(CLOCK_REALTIME) / 1'000'000'000;
  session.drive(stop, progress);
  const double wall_s = static_cast<double>(clock_ns(CLOCK_MONOTONIC) - start_ns) * 1e-9;
  Collected flown = session.collect();
  std::string timing_unfit = session.timing_unfit(flown.seen);
  const ClockKind clock = session.clock();
  checks::Verdict verdict = verdict_of(scenario, *truth, flown, timing_unfit, session.delays());
  if (flown.ending.detail.empty() && verdict.outcome != checks::Outcome::pass)
    verdict.reason = session.explained(verdict.reason);
  return Run{.verdict = std::move(verdict),
             .ending = std::move(flown.ending),
             .seen = std::move(flown.seen),
             .truth = std::move(*truth),
             .per_run_truth = std::move(flown.per_run_truth),
             .faults = std::move(flown.faults),
             .options = options,
             .clock = clock,
             .in_process = session.bus().in_process,
             .timing_unfit = std::move(timing_unfit),
             .host = clock == ClockKind::real_time ? std::optional(realtime::standing()) : std::nullopt,
             .files = std::move(files),
             .adapters = adapters_of(options),
             .wall_s = wall_s,
             .started_s = started_s,
             .log_error = std::move(flown.log_error)};
}

Result<Collected> observe_run(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                              std::uint64_t run_index, Options options, const std::atomic<bool>& stop) {
  auto flight = make_flight(scenario, truth, run_index);
  if (!flight)
    return Collected{.ending = {.kind = Ending::Kind::not_flown, .t_us = 0, .detail = flight.error().message},
                     .seen = {}};
  options.run_index = run_index;
  options.for_verdict = false;
  const auto session = Session::open(scenario, truth, std::move(*flight), options);
  if (!session) return tl::unexpected(session.error());
  if (auto ready = (*session)->configure(stop); !ready) return tl::unexpected(ready.error());
  (*session)->drive(stop, [](std::int64_t) {});
  Collected flown = (*session)->collect();
  const bool judged =
      !options.targets.empty() || !flown.seen.clipped.empty();  // the device in process is right
  if (judged) flown.ending = ending_as_a_run(flown.ending, scenario, flown.seen, flown.per_run_truth);
  return flown;
}

Result<Collected> run_in_process(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                                 std::uint64_t run_index) {
  return observe_run(scenario, truth, run_index, unattended("", scenario));
}

}  // namespace canhil::drive
