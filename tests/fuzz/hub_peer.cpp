// Tests the hub of the embedded bus against peers (connected programs) that send arbitrary bytes. The hub
// must forward valid frames unchanged, and disconnect peers that send anything else. A correct node may
// receive only frames that a peer or the host has sent. For each step, the input contains one byte that
// selects a peer and an action, and then the data of the action.
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "dbc/ports/local_bus.hpp"
#include "dbc/ports/local_place.hpp"
#include "dbc/ports/local_wire.hpp"
#include "dbc/wire/frame_rules.hpp"
#include "tests/fuzz/expect.hpp"
#include "tests/fuzz/script.hpp"

namespace {

using namespace canhil;
using fuzz::Script;
using local::Datagram;

// A temporary folder for the sockets of this process's buses.
class Folder {
 public:
  Folder() {
    std::filesystem::create_directory(path_);
    ::chmod(path_.c_str(), 0700);
    ::setenv("XDG_RUNTIME_DIR", path_.c_str(), 1);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

 private:
  std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("canhil-fuzz-" + std::to_string(::getpid()));
};

// The peers 0 to 2. The input decides when they connect and disconnect.
class Peers {
 public:
  explicit Peers(bool fd) : place_(fd ? local::Format::fd : local::Format::classic) {}

  void send(std::size_t peer, const void* bytes, std::size_t count) {
    Descriptor& socket = sockets_[peer];
    if (!socket) socket = local::connect_to(*local::directory(), "fuzz", place_);
    if (socket) static_cast<void>(::send(socket.get(), bytes, count, MSG_NOSIGNAL | MSG_DONTWAIT));
  }
  void hello(std::size_t peer, Script& script) {
    local::Hello hello;
    const std::uint8_t how = script.byte();
    hello.wishes = static_cast<std::uint8_t>((how & 1U) | (how >> 5U & 2U));
    hello.only_some = (how & 2U) != 0;
    if ((how & 4U) != 0) script.fill(hello.wanted);
    if ((how & 8U) != 0) script.fill({reinterpret_cast<std::uint8_t*>(hello.node_name.data()), 66});
    if ((how & 16U) != 0) hello.magic ^= script.byte();
    send(peer, &hello, (how & 32U) != 0 ? script.byte() : sizeof hello);
  }
  void leave(std::size_t peer) { sockets_[peer] = Descriptor(); }

 private:
  local::Format place_;
  std::array<Descriptor, 3> sockets_;
};

void run(Script& script) {
  const std::uint8_t how = script.byte();
  PortOptions options{.fd = (how & 1U) != 0, .own_echo = (how & 2U) != 0};
  if ((how & 4U) != 0) options.only_ids = {0x10, 0x20};
  HubRules rules;
  if ((how & 8U) != 0) rules.hello_limit_ns = 0;
  if ((how & 16U) != 0) rules.reading_limit_ns = 0;
  if ((how & 32U) != 0) rules.most_nodes = 2;
  rules.on_turned_away = [](const std::string& line) { fuzz::expect_one_line(line, "bus 'local:fuzz': "); };
  const auto hub = host_local_bus("local:fuzz", options, rules);
  fuzz::expect(hub.has_value());
  std::vector<Frame> sent;  // all valid frames that any peer or the host sent
  const auto was_sent = [&](const Received& received) {
    fuzz::expect(can_carry(received.frame, options.fd));
    fuzz::expect(std::ranges::find(sent, received.frame) != sent.end());
  };
  const auto look = [&](Port& port) {
    for (int n = 0; n < 300; ++n) {
      const auto received = port.receive();
      if (received) was_sent(*received);
      if (!received && n > 3) break;
    }
  };
  auto node = join_local_bus("local:fuzz", {.fd = options.fd, .own_echo = true, .node_name = "good"});
  fuzz::expect(node.has_value());
  Peers peers(options.fd);
  while (!script.over()) {
    const std::uint8_t what = script.byte();
    const std::size_t peer = what % 3;
    switch (what / 32) {
      case 0:
        peers.hello(peer, script);
        break;
      case 1:
      case 2:
      case 3: {  // a valid or almost valid frame
        Frame frame{.id = script.byte() * 8U};
        const std::uint8_t flags = script.byte();
        frame.extended = (flags & 1U) != 0;
        frame.fd = frame.brs = (flags & 2U) != 0;
        frame.error = (flags & 4U) != 0;
        frame.size = static_cast<std::uint8_t>((flags >> 3U) % (frame.fd ? 65 : 9));
        if (what / 32 == 3) frame.id = (frame.id << 18U) | frame.id;
        script.fill({frame.data.data(), frame.size});
        Datagram datagram;
        local::encode(frame, datagram);
        if (what / 32 == 2) datagram.flags ^= script.byte();
        Frame read;
        if (local::decode(datagram, datagram.bytes(), options.fd, read)) sent.push_back(read);
        peers.send(peer, &datagram, datagram.bytes());
        break;
      }
      case 4: {  // arbitrary bytes
        std::array<std::uint8_t, 100> bytes{};
        const std::size_t count = script.byte() % bytes.size();
        script.fill(std::span(bytes).first(count));
        Datagram datagram;
        std::memcpy(&datagram, bytes.data(), std::min(count, sizeof datagram));
        Frame read;
        if (local::decode(datagram, count, options.fd, read)) sent.push_back(read);
        peers.send(peer, bytes.data(), count);
        break;
      }
      case 5:
        peers.leave(peer);
        break;
      case 6: {  // a frame from the host or the correct node
        const Frame frame{.id = script.byte(), .size = 1, .data = {script.byte()}};
        sent.push_back(frame);
        static_cast<void>(peer == 0 ? (*hub)->send(frame) : (*node)->send(frame));
        break;
      }
      case 7:
        look(**hub);
        if (what % 2 == 0) look(**node);
        break;
    }
  }
  look(**hub);
  look(**node);
  fuzz::expect((*hub)->nodes().size() <= 4);
  for (const std::string& name : (*hub)->nodes())
    fuzz::expect(std::ranges::all_of(name, [](char c) { return c >= ' ' && c <= '~'; }));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  Script script({data, size});
  run(script);
  return 0;
}
