// hil-target: runs a Device on a bus, or passes the frames of a recorded log to a Device.
#include <fmt/format.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "dbc/command_line/command_line.hpp"
#include "dbc/logs/remarks.hpp"
#include "dbc/realtime/command_line.hpp"
#include "dbc/text/escape.hpp"
#include "dbc/version/version.hpp"
#include "messages/canhil.hpp"
#include "target/process/event_loop.hpp"
#include "target/process/replay.hpp"

namespace {

constexpr int exit_usage = 2;

std::atomic<bool> stop_requested = false;
void request_stop(int /*signal*/) { stop_requested = true; }

int complain(const canhil::Error& error) {
  std::fprintf(stderr, "hil-target: %s\n", canhil::one_line(error.message).c_str());
  return exit_usage;
}

int run(int argc, char** argv) {
  canhil::command_line::Program program{
      "The device under test: navigation and guidance estimators behind a CAN interface.",
      fmt::format("{} · DBC {:016x}, on the bus {:06x}", canhil::version_line("hil-target"),
                  canhil::messages::dbc_hash, canhil::messages::exchange_hash24())};
  std::vector<std::string> buses;
  std::string log;
  std::string dbc{canhil::name_of(canhil::BusFormat::classic)};
  const auto bus_option = program
                              .add_option("--bus", buses,
                                          "bus to serve: a SocketCAN interface (can0, vcan0) or local:NAME; "
                                          "if given several times: receive on all, answer on the first")
                              .one_word_each();
  const auto replay_option = program.add_option(
      "--replay", log, "feed a recorded log to the device and print its answers, in candump's format");
  bus_option.excludes(replay_option);
  program
      .add_option("--dbc", dbc, "contract of the bus: canhil, canhil-fd (CAN FD), or the file of one of them")
      .excludes(replay_option);
  canhil::realtime::Options realtime;
  canhil::realtime::add_options(program, realtime).excludes(replay_option);
  program.refuse_no_values();
  const auto parsed = program.parse(argc, argv);
  if (!parsed) return complain({parsed.error().message + "; see hil-target --help"});
  if (*parsed) return **parsed;
  if (buses.empty() && log.empty()) return complain({"--bus or --replay is required; see hil-target --help"});

  if (!log.empty()) {
    const auto replayed = canhil::target::replay(log, stdout);
    return replayed ? 0 : complain(replayed.error());
  }
  const auto format = canhil::named_contract(dbc);
  if (!format) return complain(format.error());
  if (const auto request = realtime.request()) {
    if (auto entered = canhil::realtime::enter(*request); !entered) return complain(entered.error());
    const std::string warning = canhil::realtime::frequency_warning(canhil::realtime::standing());
    if (!warning.empty()) std::fprintf(stderr, "hil-target: %s\n", canhil::one_line(warning).c_str());
  }
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, request_stop);
  const auto served = canhil::target::serve(buses, *format, stop_requested);
  return served ? 0 : complain(served.error());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const canhil::LogRemarks remarks;
    const int code = run(argc, argv);
    for (const std::string& line : remarks.lines())
      std::fprintf(stderr, "hil-target: %s\n", canhil::one_line(line).c_str());
    return canhil::command_line::finish("hil-target", code);
  } catch (const std::exception& error) {  // for example std::bad_alloc
    std::fprintf(stderr, "hil-target: %s\n", canhil::one_line(error.what()).c_str());
    return exit_usage;
  }
}
