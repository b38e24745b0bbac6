#include "dbc/ports/local_gate.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include <algorithm>
#include <ctime>

namespace canhil::local {
namespace {

constexpr int most_reports = 20;

// The largest number of nodes. Each node needs one file descriptor. Three quarters of the descriptors remain
// for the rest of the process.
std::size_t most_nodes(std::size_t wanted) {
  rlimit files{};
  if (::getrlimit(RLIMIT_NOFILE, &files) != 0) return wanted;
  return std::min<std::size_t>(wanted, files.rlim_cur / 4);
}

// For a node that stalls the bus (Peer::behind): the time at which its arrears reach the limit, if the node
// reads no frame until then.
std::int64_t overdue_ns(const Peer& peer, const HubRules& rules) {
  return peer.behind_since_ns + rules.reading_limit_ns - peer.arrears_ns;
}

}  // namespace

Gate::Gate(Descriptor listener, HubRules rules, std::string bus)
    : listener_(std::move(listener)), rules_(std::move(rules)), bus_(std::move(bus)) {
  rules_.most_nodes = most_nodes(rules_.most_nodes);
}

Gate::Admission Gate::admit(std::vector<Peer>& peers) {
  pollfd waiting{.fd = listener_.get(), .events = POLLIN, .revents = 0};
  if (::poll(&waiting, 1, 0) != 1)
    return Admission::none;  // poll() is far cheaper than an accept() that fails
  Descriptor socket(::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!socket) return Admission::none;
  const Process process = process_behind(socket.get());
  if (!is_of_this_user(process)) {
    report(fmt::format("a process ({})", to_text(process)), "is another user's and was refused");
    return Admission::refused;
  }
  if (peers.size() >= rules_.most_nodes) {
    report(fmt::format("a process ({})", to_text(process)),
           fmt::format("was refused: the bus has {} nodes, its limit", peers.size()));
    return Admission::refused;
  }
  Peer& peer = peers.emplace_back();
  peer.socket = std::move(socket);
  peer.process = process;
  peer.came_ns = clock_ns(CLOCK_MONOTONIC);
  strangers_ = true;
  set_alarm(peers);
  return Admission::admitted;
}

void Gate::drop_silent(std::vector<Peer>& peers, bool fd_bus) {
  if (!strangers_) return;
  strangers_ = false;
  const std::int64_t now_ns = clock_ns(CLOCK_MONOTONIC);
  std::erase_if(peers, [&](Peer& peer) {
    if (peer.joined) return false;
    if (now_ns < peer.came_ns + rules_.hello_limit_ns) {
      strangers_ = true;
      return false;
    }
    Datagram none;
    Frame no_frame;
    const Reading last = read(peer, fd_bus, none, no_frame);
    if (last == Reading::joined) return false;  // the Hello arrived in time, but the hub reads it late
    if (last == Reading::nothing) report(to_text(peer), "sent no Hello and was dropped");
    if (last == Reading::nonsense) report_nonsense(peer);
    return true;
  });
  set_alarm(peers);
}

bool Gate::has_waited_enough(const Peer& peer, std::int64_t now_ns) const {
  return now_ns >= overdue_ns(peer, rules_);
}

void Gate::report_dropped_reader(const Peer& peer) {
  report(to_text(peer), "did not read its frames and was dropped");
}

void Gate::report_nonsense(const Peer& peer) {
  report(to_text(peer), peer.joined ? "sent an invalid frame and was dropped"
                                    : "sent an invalid Hello (another version?) and was dropped");
}

void Gate::count(const std::vector<Peer>& peers) const {
  if (rules_.on_nodes)
    rules_.on_nodes(static_cast<std::size_t>(std::ranges::count(peers, true, &Peer::joined)));
}

void Gate::set_alarm(const std::vector<Peer>& peers) {
  std::int64_t at_ns = 0;
  for (const Peer& peer : peers) {
    if (peer.joined && !peer.behind) continue;
    const std::int64_t end_ns = peer.behind ? overdue_ns(peer, rules_) : peer.came_ns + rules_.hello_limit_ns;
    at_ns = at_ns == 0 ? end_ns : std::min(at_ns, end_ns);
  }
  alarm_.set(at_ns);
}

void Gate::report(std::string_view who, std::string_view what) {
  if (rules_.on_turned_away && ++reported_ <= most_reports)
    rules_.on_turned_away(fmt::format("bus '{}': {} {}", bus_, who, what));
}

}  // namespace canhil::local
