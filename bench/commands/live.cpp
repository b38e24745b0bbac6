#include "bench/commands/live.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <utility>

#include "bench/commands/interrupt.hpp"
#include "bench/live/server.hpp"

namespace canhil::commands {

command_line::Option add_live(command_line::Command command, Live& live) {
  const auto page = command.add_flag_or_number(
      "--live", live.port,
      fmt::format(
          "show it in a browser while it goes on: a page on this port (default: {}; 0: any free one); "
          "its URL is printed. See docs/live.md",
          live::usual_port),
      live::usual_port, 0, 65535);
  live.address = live::loopback_address;
  command
      .add_option("--live-address", live.address,
                  fmt::format("IP address of the page (default: {}, for this machine alone; 0.0.0.0: every "
                              "address of it). The URL then has a token, and is needed to see anything",
                              live::loopback_address))
      .needs(page);
  command.add_flag("--live-hold", live.hold, "keep the page after the end, until Ctrl-C").needs(page);
  return page;
}

Result<OpenView> OpenView::open(const Live& live, live::Snapshot begun,
                                std::vector<std::unique_ptr<live::Display>> others) {
  OpenView open;
  std::vector<std::unique_ptr<live::Display>> displays = std::move(others);
  if (live.wanted()) {
    auto server = live::Server::open(live.address, static_cast<std::uint16_t>(*live.port));
    if (!server) return tl::unexpected(server.error());
    fmt::print(stderr, "hil-bench: live at {}\n", (*server)->url());
    if (live.hold) open.held_ = (*server)->url();
    displays.push_back(std::move(*server));
  }
  if (!displays.empty()) open.view_ = std::make_unique<live::View>(std::move(displays), std::move(begun));
  return open;
}

void OpenView::hold() {
  if (held_.empty() || interrupted) return;
  fmt::print(stderr, "hil-bench: the page stays at {} until Ctrl-C\n", held_);
  constexpr useconds_t look_every_us = 50'000;
  while (!interrupted) usleep(look_every_us);
}

}  // namespace canhil::commands
