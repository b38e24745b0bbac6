#include "bench/commands/subcommands.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "bench/commands/exit_code.hpp"
#include "bench/commands/interrupt.hpp"
#include "dbc/ports/local_bus.hpp"

namespace canhil::commands {
namespace {

ExitCode host(const std::string& bus, bool fd) {
  PortOptions options;
  options.fd = fd;
  options.node_name = "hil-bench bus";
  HubRules rules;
  rules.on_turned_away = [](const std::string& line) { fmt::print(stderr, "{}\n", one_line(line)); };
  auto hub = host_local_bus(bus, options, std::move(rules));
  if (!hub) return complain(hub.error());
  catch_interrupts();
  fmt::print("hosting {}; Ctrl-C ends it\n", one_line(bus));
  std::fflush(stdout);
  run_hub(**hub, [] { return interrupted.load(); });
  return ExitCode::pass;
}

}  // namespace

void add_bus(command_line::Command app, int& code) {
  auto bus = std::make_shared<std::string>();
  auto fd = std::make_shared<bool>(false);
  const auto command =
      app.add_subcommand("bus", "host an embedded bus for other programs, until interrupted");
  command.add_option("BUS", *bus, "local:NAME").required();
  command.add_flag("--fd", *fd, "carry CAN FD frames");
  command.on_given([&code, bus, fd] { code = static_cast<int>(host(*bus, *fd)); });
}

}  // namespace canhil::commands
