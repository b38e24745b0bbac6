#include "bench/commands/subcommands.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/commands/exit_code.hpp"
#include "bench/commands/interrupt.hpp"
#include "bench/doctor/interface.hpp"
#include "bench/doctor/jitter.hpp"
#include "bench/doctor/listen.hpp"
#include "bench/doctor/loop.hpp"
#include "bench/doctor/machine_lines.hpp"
#include "bench/report/file.hpp"
#include "dbc/files/command_files.hpp"
#include "dbc/ports/fd_groups.hpp"
#include "dbc/realtime/command_line.hpp"
#include "dbc/realtime/host.hpp"

namespace canhil::commands {
namespace {

using doctor::Grade;
using doctor::Line;

constexpr std::int64_t ns_per_s = 1'000'000'000;
constexpr std::int64_t listen_ns = ns_per_s;  // the time of ten heartbeats

// The arguments as given on the command line.
struct Arguments {
  std::string bus;
  std::string loop;
  std::optional<int> seconds = 5;
  std::optional<int> frames = 1000;
  std::optional<int> cpu;
  std::string json;
};

// All findings.
struct Examination {
  std::vector<Line> lines;
  std::vector<double> jitter_s;
  std::optional<doctor::LoopResult> loop;

  void add(std::vector<Line> more) {
    lines.insert(lines.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  }
};

bool stop() { return interrupted; }

Result<std::unique_ptr<Port>> open(const std::string& bus) {
  PortOptions options;
  options.node_name = "hil-bench doctor";
  return join_or_host(bus, std::move(options), BusFormat::classic);
}

// Rejects malformed bus names; a missing bus is reported as a finding.
Result<void> check_name(const std::string& option, const std::string& bus) {
  if (is_local(bus)) {
    if (auto opened = open(bus); !opened) return tl::unexpected(opened.error());
  } else if (bus.empty() || bus.find_first_of(":/ ") != std::string::npos) {
    return failure(fmt::format("{} '{}': expected a CAN interface such as can0, or local:NAME", option, bus));
  }
  return {};
}

// The kernel's data about the interface of a bus; nullopt if the kernel does not know the bus, for example
// because it is an embedded bus.
std::optional<doctor::Interface> interface_of(const std::string& bus) {
  return is_local(bus) ? std::nullopt : doctor::find_interface(bus);
}

std::vector<Line> bus_lines(const std::string& bus) {
  if (is_local(bus)) {
    const auto port = open(bus);
    const wire::BitRates rates = port ? (*port)->capabilities().wire.rates : wire::BitRates{};
    return {{Grade::good, "interface",
             fmt::format("{}: embedded bus of this machine; no controller, {}", bus,
                         rates.nominal > 0 ? fmt::format("a simulated wire of {} bit/s", rates.nominal)
                                           : "no wire, no bit rate")}};
  }
  const auto interface = interface_of(bus);
  return interface ? doctor::interface_lines(*interface) : std::vector{doctor::no_interface(bus)};
}

std::vector<Line> pair_lines(const std::string& bus, const std::string& loop) {
  std::vector<Line> lines = bus_lines(loop);
  const auto one = interface_of(bus), other = interface_of(loop);
  if (one && other) std::ranges::move(doctor::mismatch_lines(*one, *other), std::back_inserter(lines));
  return lines;
}

// Enters real-time scheduling if that is permitted, so that the measurements apply to runs with --realtime.
std::vector<Line> machine_lines(const Arguments& arguments) {
  const std::vector<int> cpus = realtime::cpus();
  const auto entered = realtime::enter({.cpu = arguments.cpu});
  return doctor::machine_lines({.preemption = realtime::preemption(),
                                .refusal = entered ? "" : entered.error().message,
                                .governors = realtime::governors(cpus),
                                .cpus = cpus,
                                .isolated = doctor::isolated_cpus()});
}

Line jitter_line(const Arguments& arguments, Examination& found) {
  found.jitter_s = doctor::measure_jitter(std::int64_t{*arguments.seconds} * ns_per_s, stop);
  const realtime::Standing standing = realtime::standing();
  return doctor::jitter_line(found.jitter_s,
                             fmt::format("{}{}, CPU {}", standing.policy,
                                         standing.priority > 0 ? fmt::format(" {}", standing.priority) : "",
                                         realtime::list(standing.cpus)));
}

std::vector<Line> who_is_there(const std::string& bus) {
  auto port = open_port(bus, {.node_name = "hil-bench doctor"});
  if (!port) {
    if (!is_local(bus)) return {};  // the finding about the interface states the reason
    return {{Grade::weak, "target", "nobody hosts this bus now", "the bench will, when it runs"}};
  }
  return doctor::listen(**port, listen_ns, stop);
}

Line loop_line(const Arguments& arguments, Examination& found) {
  auto near = open(arguments.bus);
  if (!near) return {Grade::bad, "loop", near.error().message, "see the lines of the interface"};
  auto far = open(arguments.loop);
  if (!far) return {Grade::bad, "loop", far.error().message, "see the lines of the interface"};
  found.loop = doctor::measure_loop(**near, **far, *arguments.frames, stop);
  return doctor::loop_line(*found.loop, arguments.bus, arguments.loop);
}

Examination examine(const Arguments& arguments) {
  Examination found;
  found.add(bus_lines(arguments.bus));
  if (!arguments.loop.empty() && arguments.loop != arguments.bus)
    found.add(pair_lines(arguments.bus, arguments.loop));
  found.add(machine_lines(arguments));
  found.add({jitter_line(arguments, found)});
  found.add(who_is_there(arguments.bus));
  if (!arguments.loop.empty()) found.add({loop_line(arguments, found)});
  return found;
}

std::string text(const Examination& found) {
  std::size_t width = 0;
  for (const Line& line : found.lines) width = std::max(width, line.subject.size());
  std::string page;
  for (const Line& line : found.lines) {
    page += fmt::format("  {:<4}  {:<{}}  {}\n", name(line.grade), line.subject, width, line.found);
    if (!line.remedy.empty()) page += fmt::format("        {:<{}}  -> {}\n", "", width, line.remedy);
  }
  page += fmt::format("\n{}\n", name(doctor::worst(found.lines)));
  return page;
}

nlohmann::ordered_json figures(const std::vector<double>& sample_s) {
  const checks::Distribution d = checks::distribution(sample_s);
  return {{"count", d.count}, {"min", d.min}, {"mean", doctor::mean(sample_s)},
          {"p50", d.p50},     {"p99", d.p99}, {"max", d.max}};
}

std::string json(const Arguments& arguments, const Examination& found) {
  nlohmann::ordered_json page{{"bus", arguments.bus}, {"verdict", name(doctor::worst(found.lines))}};
  for (const Line& line : found.lines) {
    page["lines"].push_back({{"grade", name(line.grade)},
                             {"subject", line.subject},
                             {"found", line.found},
                             {"remedy", line.remedy}});
  }
  page["jitter_s"] = figures(found.jitter_s);
  if (found.loop) {
    page["loop"] = {{"with", arguments.loop}, {"sent", found.loop->sent}, {"lost", found.loop->lost}};
    page["loop"]["round_trip_s"] = figures(found.loop->round_trip_s);
  }
  return page.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

ExitCode execute(Arguments arguments) {
  // `local:` and `local:?bitrate=500000` name a private bus of this process, as for hil-bench run.
  for (std::string* bus : {&arguments.bus, &arguments.loop})
    *bus = named_local(*bus, fmt::format("canhil-{}", getpid()));
  if (auto fine = check_name("--bus", arguments.bus); !fine) return complain(fine.error());
  if (!arguments.loop.empty()) {
    if (auto fine = check_name("--loop", arguments.loop); !fine) return complain(fine.error());
  }
  if (arguments.cpu) {
    if (auto known = realtime::check_cpu("--cpu", *arguments.cpu); !known) return complain(known.error());
  }
  CommandFiles files;
  files.writes("--json", arguments.json);
  if (auto fine = files.check(); !fine) return complain(fine.error());
  catch_interrupts();
  const Examination found = examine(arguments);
  if (arguments.json != report::to_stdout) {
    if (auto shown = report::show(text(found)); !shown) return complain(shown.error());
  }
  if (!arguments.json.empty()) {
    if (auto written = report::write(arguments.json, json(arguments, found)); !written)
      return complain(written.error());
  }
  if (interrupted) return ExitCode::not_measured;
  return doctor::worst(found.lines) == Grade::bad ? ExitCode::fail : ExitCode::pass;
}

}  // namespace

void add_doctor(command_line::Command app, int& code) {
  auto arguments = std::make_shared<Arguments>();
  const auto command = app.add_subcommand(
      "doctor", "report what this machine and its CAN interface can do; exit code 1 if something is bad");
  command.add_option("--bus", arguments->bus, "can0, vcan0, local:NAME, or local: for a private one")
      .required();
  command.add_option("--loop", arguments->loop,
                     "a second interface on the same bus: send frames there and back. They disturb no node "
                     "that keeps to the DBC");
  command.add_number("--frames", arguments->frames, "of the loop (default 1000)", 1, 1'000'000);
  command.add_number("--seconds", arguments->seconds, "how long the timer's jitter is measured (default 5)",
                     1, 86'400);
  command.add_number("--cpu", arguments->cpu, "the only CPU to measure on", 0, 1023);
  command.add_option("--json", arguments->json,
                     "write what was found as JSON to a file; -: to stdout, in place of the text");
  command.on_given([&code, arguments] { code = static_cast<int>(execute(*arguments)); });
}

}  // namespace canhil::commands
