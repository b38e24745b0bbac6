#include "bench/run/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "bench/checks/timing.hpp"
#include "bench/run/bus_watch.hpp"
#include "bench/run/ears.hpp"
#include "bench/run/flight.hpp"
#include "bench/run/handshake.hpp"
#include "bench/run/host_watch.hpp"
#include "bench/run/in_process_port.hpp"
#include "bench/run/in_process_wire.hpp"
#include "bench/run/load_meter.hpp"
#include "bench/run/lockstep.hpp"
#include "bench/run/monitor.hpp"
#include "bench/run/recorder.hpp"
#include "bench/run/target_process.hpp"
#include "dbc/ports/local_bus.hpp"
#include "dbc/ports/several.hpp"
#include "messages/canhil.hpp"

namespace canhil::run {
namespace {

constexpr std::int64_t silence_limit_ns =
    400'000'000;  // four heartbeats; a dead target is named within 0.5 s
constexpr std::int64_t step_limit_ns = 5'000'000'000;

static_assert(std::ranges::all_of(messages::all_messages, &MessageInfo::can_travel_unrounded));

// Without a wire there is no bus, and frames travel as they are in both contracts.
Result<std::unique_ptr<Port>> open_in_process(const BusName& bus, BusFormat format) {
  if (bus.rounding == Rounding::none) return std::make_unique<InProcessPort>(bus.rounding);
  if (!bus.wire) return tl::unexpected(bus.wire.error());
  if (bus.wire->rates.nominal == 0) return std::make_unique<InProcessPort>(bus.rounding);
  auto port = std::make_unique<InProcessWire>(bus.text, *bus.wire, format);
  if (format == BusFormat::fd) return in_fd_groups(std::move(port));
  return port;
}

// A local bus is hosted by the bench, unless somebody does already. `notes`: whom the bench as a host turns
// away; must outlive the port.
Result<std::unique_ptr<Port>> open(const BusName& bus, BusFormat format, std::vector<std::string>& notes) {
  if (bus.in_process) return open_in_process(bus, format);
  PortOptions options;
  options.own_echo = true;
  options.foreign = true;
  options.node_name = "hil-bench";
  HubRules rules;
  rules.on_turned_away = [&notes](const std::string& line) { notes.push_back(line); };
  return join_or_host(bus.text, std::move(options), format, std::move(rules));
}

// The bus of each node that has one of its own, each once, after the first.
std::vector<std::string> buses_of(const Options& options) {
  std::vector<std::string> buses{options.bus.text};
  for (const auto& [node, bus] : options.bus_of) {
    if (std::ranges::find(buses, bus) == buses.end()) buses.push_back(bus);
  }
  return buses;
}

LoadBy load_by(const Capabilities& bus, ClockKind clock) {
  if (clock == ClockKind::lockstep) return bus.in_process ? LoadBy::time_base_alone : LoadBy::time_base;
  return bus.wire.rates.nominal > 0 ? LoadBy::stamps : LoadBy::time_base;
}

// One port over all of them; a frame goes to the bus of its sender.
Result<std::unique_ptr<Port>> open_all(const Options& options, std::vector<std::string>& notes) {
  const std::vector<std::string> buses = buses_of(options);
  std::vector<std::unique_ptr<Port>> ports;
  for (const std::string& bus : buses) {
    auto opened = open(BusName(bus), options.format, notes);
    if (!opened) return opened;
    ports.push_back(std::move(*opened));
  }
  return join_ports(std::move(ports), [&options, buses](const Frame& frame) {
    const MessageInfo* info = messages::find_message(frame.id);
    const auto own = std::ranges::find_if(
        options.bus_of, [&](const auto& entry) { return info != nullptr && info->sender == entry.first; });
    const std::string& bus = own == options.bus_of.end() ? options.bus.text : own->second;
    return static_cast<std::size_t>(std::ranges::find(buses, bus) - buses.begin());
  });
}

// Why nobody is heard on a bus that has more to carry than it can; empty: it is another reason.
std::string full_wire(const std::vector<wire::BitLength>& by_second, std::int64_t time_ns,
                      const wire::BitRates& rates) {
  constexpr double full = 0.9;
  if (rates.nominal == 0 || time_ns <= 0) return {};
  wire::BitLength all;
  for (const wire::BitLength& length : by_second) all += length;
  const double load = wire::bus_load(all, static_cast<double>(time_ns) * 1e-9, rates);
  if (load < full) return {};
  return fmt::format(" (the wire of {:g} kbit/s is full: load {:.0f} %)",
                     static_cast<double>(rates.nominal) * 1e-3, load * 100);
}

}  // namespace

ClockKind clock_of(BusTime time, bool lockstep) {
  if (time == BusTime::waits) return ClockKind::simulated_wire;
  return lockstep || time == BusTime::told ? ClockKind::lockstep : ClockKind::real_time;
}

Result<Run> run(const scenario::Scenario& scenario, const Options& options,
                const std::atomic<bool>& stop_requested, const Progress& progress) {
  const auto in_file = [&](const Error& error) {
    return failure(fmt::format("{}: {}", scenario.file, error.message));
  };
  auto truth = make_truth(scenario);
  if (!truth) return in_file(truth.error());
  auto own_truth = make_own_truth(scenario, options.run_index);
  if (!own_truth) return in_file(own_truth.error());
  const auto initial = make_initial_states(scenario, *truth, *own_truth, options.run_index);
  if (!initial) return in_file(initial.error());

  const std::vector<int> target_cpus =
      options.target_cpu ? std::vector{*options.target_cpu} : realtime::cpus();
  const bool starts_target = options.target && !options.bus.in_process;
  const auto target_file = starts_target ? look_at_program(*options.target) : std::nullopt;
  if (options.realtime) {
    if (auto entered = realtime::enter(*options.realtime); !entered) return tl::unexpected(entered.error());
  }
  std::vector<std::string> notes;
  auto port = open_all(options, notes);
  if (!port) return tl::unexpected(port.error());
  Link link(**port);
  Capabilities can = (*port)->capabilities();
  if (can.wire.rates.nominal == 0) can.wire = options.controller;
  const ClockKind clock = clock_of(can.time, options.lockstep);
  const bool lockstep = clock == ClockKind::lockstep;
  // Who floods the bus, or was turned away from it, may be why.
  const auto explained = [&](const std::string& why) {
    if (link.flood()) return fmt::format("{}; {}", why, words(*link.flood()));
    return notes.empty() ? why : fmt::format("{}; {}", why, notes.front());
  };
  BusWatch bus(**port);
  link.attach(bus);
  std::unique_ptr<Recorder> recorder;
  if (options.log_path) {
    auto opened = Recorder::open(*options.log_path, **port);
    if (!opened) return tl::unexpected(opened.error());
    recorder = std::move(*opened);
    link.attach(*recorder);
  }
  std::optional<TargetProcess> target;
  if (starts_target) {
    auto started =
        TargetProcess::start(*options.target, options.bus.text, options.target_arguments, target_cpus);
    if (!started) return tl::unexpected(started.error());
    target.emplace(std::move(*started));
  }
  const auto ended = [&]() -> std::optional<std::string> { return target ? target->ended() : std::nullopt; };
  const auto gone = [&]() -> std::optional<std::string> {
    if (stop_requested) return "interrupted";
    const auto why = ended();
    return why ? std::optional("target: " + *why) : std::nullopt;
  };

  Schedule schedule = make_schedule(scenario, *truth, *own_truth, options.run_index, lockstep, can.rounding);
  if (auto configured = configure(link, schedule.outbox(), scenario.targets, *initial, gone, options.format);
      !configured) {
    return failure(explained(configured.error().message));
  }

  // A container of CAN FD is none of the frames that the observers see.
  Monitor monitor(checks::timed_windows(scenario.checks),
                  options.format == BusFormat::classic ? can.wire : WireFacts{});
  link.attach(monitor);
  LoadMeter meter(options.format, load_by(can, clock));
  link.attach(meter);
  HostWatch host((*port)->stamp_clock());
  link.attach(host);
  Ears ears(schedule);
  link.attach(ears);
  if (options.realtime && target) static_cast<void>(realtime::own_memory_again());  // permitted: it entered
  const std::int64_t start_ns = clock_ns(CLOCK_MONOTONIC);
  const std::int64_t started_s = clock_ns(CLOCK_REALTIME) / 1'000'000'000;
  Ending ending =
      lockstep ? run_lockstep(link, schedule, step_limit_ns, stop_requested, progress)
               : run_real_time(link, schedule, silence_limit_ns, stop_requested, progress, options.spin_ns);
  const double wall_s = static_cast<double>(clock_ns(CLOCK_MONOTONIC) - start_ns) * 1e-9;
  link.detach(ears);
  link.detach(host);
  link.detach(meter);
  link.detach(monitor);
  if (ending.kind == Ending::Kind::target_silent) {
    if (const auto why = ended())
      ending.detail += fmt::format(" (its process {})", *why);
    else if (target && target->stopped())
      ending.detail += " (its process is stopped by a signal)";
    else if (!lockstep)
      ending.detail += full_wire(meter.lengths(), ending.t_us * 1000 + silence_limit_ns, can.wire.rates);
  }
  stop(link, schedule.outbox(), scenario.targets);
  std::optional<Error> log_error;
  if (recorder) {
    link.detach(*recorder);
    if (auto closed = recorder->close(); !closed) log_error = closed.error();
  }

  if (ending.kind != Ending::Kind::completed) ending.detail = explained(ending.detail);

  checks::Observations seen = monitor.finish();
  // What the host did has no part in the times of a simulated wire.
  if (clock != ClockKind::simulated_wire) seen.host = host.record();
  seen.bit_rates = can.wire.rates;
  seen.length_by_second = meter.lengths();
  seen.bus = bus.record();
  seen.bus.reports_errors = can.reports_errors;
  seen.bus.late_in_queue = link.late_in_queue();
  seen.bus.foreign = (*port)->counters().foreign;
  seen.bus.notes = notes;
  if (link.flood()) seen.bus.notes.push_back(words(*link.flood()));
  seen.receive_overflows = static_cast<std::uint32_t>((*port)->counters().overflowed);
  std::string timing_unfit = lockstep       ? "virtual time"
                             : link.flood() ? words(*link.flood())
                                            : checks::unfit_for_timing(seen);
  const checks::Evidence evidence{.seen = seen,
                                  .truth = *truth,
                                  .glide = own_truth->glide ? &*own_truth->glide : nullptr,
                                  .engagement = own_truth->engagement ? &*own_truth->engagement : nullptr,
                                  .duration_us = scenario.duration_us,
                                  .ended_early = ending.detail,
                                  .timing_unfit = timing_unfit};
  checks::Verdict verdict = judge(scenario, evidence);
  if (evidence.ended_early.empty() && verdict.outcome != checks::Outcome::pass)
    verdict.reason = explained(verdict.reason);
  if (ending.kind == Ending::Kind::interrupted) verdict.outcome = checks::Outcome::not_measured;
  return Run{.verdict = std::move(verdict),
             .ending = std::move(ending),
             .seen = std::move(seen),
             .truth = std::move(*truth),
             .own_truth = std::move(*own_truth),
             .options = options,
             .clock = clock,
             .in_process = can.in_process,
             .timing_unfit = std::move(timing_unfit),
             .host = clock == ClockKind::real_time ? std::optional(realtime::standing()) : std::nullopt,
             .target_file = target_file,
             .wall_s = wall_s,
             .started_s = started_s,
             .log_error = std::move(log_error)};
}

}  // namespace canhil::run
