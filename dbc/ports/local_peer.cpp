#include "dbc/ports/local_peer.hpp"

#include <fmt/format.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>

namespace canhil::local {
namespace {

Reading read_hello(Peer& peer) {
  Hello hello;
  const ssize_t bytes = ::recv(peer.socket.get(), &hello, sizeof hello, MSG_TRUNC);
  if (bytes < 0 && (errno == EAGAIN || errno == EINTR)) return Reading::nothing;
  if (bytes <= 0) return Reading::gone;
  if (bytes != sizeof hello || hello.magic != Hello::expected_magic) return Reading::nonsense;
  hello.node_name.back() = '\0';
  peer.name = hello.node_name.data();
  // The name will be printed. Therefore all characters that could be part of line breaks or terminal escape
  // sequences are replaced.
  std::ranges::replace_if(
      peer.name, [](char c) { return c < ' ' || c > '~'; }, '?');
  peer.own_echo = (hello.wishes & Hello::own_echo) != 0;
  peer.together = (hello.wishes & Hello::together) != 0;
  peer.only_some = hello.only_some != 0;
  for (std::size_t id = 0; id < peer.wanted.size(); ++id)
    peer.wanted[id] = (hello.wanted[id / 8] >> (id % 8) & 1) != 0;
  peer.joined = true;
  return Reading::joined;
}

}  // namespace

std::string to_text(const Peer& peer) {
  return fmt::format("{} ({})", peer.joined ? fmt::format("node '{}'", peer.name) : "a process",
                     to_text(peer.process));
}

Reading read(Peer& peer, bool fd_bus, Datagram& datagram, Frame& frame) {
  if (!peer.joined) return read_hello(peer);
  ssize_t bytes = 0;
  do {
    bytes = ::recv(peer.socket.get(), &datagram, sizeof datagram, MSG_TRUNC);
  } while (bytes < 0 && (errno == EINTR || errno == ECONNRESET));
  if (bytes < 0 && errno == EAGAIN) return Reading::nothing;
  if (bytes <= 0) return Reading::gone;
  const bool one_of_ours = decode(datagram, static_cast<std::size_t>(bytes), fd_bus, frame);
  return one_of_ours ? Reading::frame : Reading::nonsense;
}

Reading read_all(const Peer& peer, DatagramBatch& batch, bool fd_bus,
                 const std::function<void(const Frame&)>& each) {
  if (!batch.fetch(peer.socket.get(), MSG_DONTWAIT))
    return errno == EAGAIN || errno == EINTR ? Reading::nothing : Reading::gone;
  while (!batch.empty()) {
    const auto [datagram, bytes] = batch.take();
    if (bytes == 0) return Reading::gone;
    Frame frame;
    if (!decode(datagram, bytes, fd_bus, frame)) return Reading::nonsense;
    each(frame);
  }
  return Reading::frame;
}

std::vector<std::string> names(const std::vector<Peer>& peers) {
  std::vector<std::string> names;
  for (const Peer& peer : peers) {
    if (peer.joined) names.push_back(peer.name);
  }
  return names;
}

std::string first_behind(const std::vector<Peer>& peers) {
  const auto slow = std::ranges::find(peers, true, &Peer::behind);
  return slow == peers.end() ? std::string() : slow->name;
}

bool offer(Peer& peer, Datagram& datagram, bool own) {
  if (!peer.joined || peer.mute || (own && !peer.own_echo)) return true;
  const bool selectable = (datagram.flags & (Datagram::error | Datagram::extended)) == 0;
  const bool error = (datagram.flags & Datagram::error) != 0;
  if (peer.only_some && !error && !(selectable && peer.wanted.test(datagram.id))) return true;
  const auto flags = static_cast<std::uint8_t>(datagram.flags & ~Datagram::own);
  datagram.flags = static_cast<std::uint8_t>(flags | (own ? Datagram::own : 0));
  if (::send(peer.socket.get(), &datagram, datagram.bytes(), MSG_NOSIGNAL) >= 0) {
    peer.arrears_ns = std::max<std::int64_t>(peer.arrears_ns - worked_off_ns, 0);
    return true;
  }
  if (errno == EAGAIN || errno == ENOBUFS || errno == EINTR) return false;
  peer.mute = true;  // the peer has ended; the next read() from the peer reports that
  return true;
}

bool gets_all(const Peer& peer) { return peer.joined && !peer.mute && !peer.only_some; }

std::size_t offer_all(Peer& peer, std::span<const Frame> frames, bool fd_bus, std::int64_t t_ns) {
  const auto send = peer.together ? send_together : send_frames;
  const std::size_t sent = send(peer.socket.get(), frames, fd_bus, t_ns);
  peer.arrears_ns =
      std::max<std::int64_t>(peer.arrears_ns - static_cast<std::int64_t>(sent) * worked_off_ns, 0);
  return sent;
}

}  // namespace canhil::local
