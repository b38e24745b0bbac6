// Access to an embedded bus: only for processes of the same user, and only while they send and read.
#include "dbc/ports/local_gate.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <functional>

#include "tests/unit/dbc/ports/frames.hpp"

namespace canhil {
namespace {

using local::Format;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr uid_t nobody = 65534;
constexpr std::int64_t ns_per_ms = 1'000'000;

/// Runs a function in a process of the user `nobody` and returns its result.
int as_nobody(const std::function<int()>& what) {
  const pid_t pid = ::fork();
  if (pid == 0) ::_exit(::setgid(nobody) == 0 && ::setuid(nobody) == 0 ? what() : 99);
  int status = 0;
  ::waitpid(pid, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Buses that only this test uses.
class LocalGate : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_NE(::mkdtemp(runtime_.data()), nullptr);
    ASSERT_EQ(::setenv("XDG_RUNTIME_DIR", runtime_.c_str(), 1), 0);
  }
  void TearDown() override {
    EXPECT_EQ(std::system(fmt::format("rm -rf {}", runtime_).c_str()), 0);
    before_.empty() ? ::unsetenv("XDG_RUNTIME_DIR") : ::setenv("XDG_RUNTIME_DIR", before_.c_str(), 1);
  }
  std::unique_ptr<LocalHub> host(HubRules rules = {}) {
    rules.on_turned_away = [this](const std::string& line) { refusals_.push_back(line); };
    auto hub = host_local_bus("local:x", {}, std::move(rules));
    EXPECT_TRUE(hub) << hub.error().message;
    return hub ? std::move(*hub) : nullptr;
  }
  static std::unique_ptr<Port> join(Port& hub, const std::string& name = "node") {
    auto node = open_port("local:x", {.node_name = name});
    EXPECT_TRUE(node) << node.error().message;
    for (int twice = 0; twice < 2; ++twice) EXPECT_FALSE(hub.receive());
    return node ? std::move(*node) : nullptr;
  }
  /// Runs the hub as its host does, until done() is true. Returns false if that takes more than 10 s.
  static bool serve(Port& hub, const std::function<bool()>& done) {
    const std::int64_t deadline = in_seconds(10);
    while (!done()) {
      if (clock_ns(CLOCK_MONOTONIC) >= deadline) return false;
      wait(hub, WaitFor::frame, deadline);
      while (hub.receive()) {
      }
    }
    return true;
  }
  [[nodiscard]] std::string directory() const { return runtime_ + "/canhil"; }
  /// The name that the hub gives to this process.
  static std::string us() { return fmt::format("pid {} of uid {}", ::getpid(), ::geteuid()); }

  const std::string before_ = std::getenv("XDG_RUNTIME_DIR") == nullptr ? "" : std::getenv("XDG_RUNTIME_DIR");
  std::string runtime_ = "/tmp/canhil-test-XXXXXX";
  std::vector<std::string> refusals_;
};

TEST_F(LocalGate, BusesAreInAPrivateDirectory) {
  auto hub = host();
  EXPECT_EQ(local::directory().value(), directory());
  struct stat entry {};
  ASSERT_EQ(::stat(directory().c_str(), &entry), 0);
  EXPECT_EQ(entry.st_mode & 07777U, 0700U);
  EXPECT_EQ(::access((directory() + "/x.classic").c_str(), F_OK), 0);
  std::ifstream sockets("/proc/net/unix");
  const std::string all(std::istreambuf_iterator<char>(sockets), {});
  EXPECT_THAT(all, HasSubstr(directory() + "/x.classic"));
  hub.reset();
  EXPECT_EQ(::rmdir(directory().c_str()), 0) << "the host left something behind";
}

TEST_F(LocalGate, ARuntimeDirectoryThatOthersMayEnterIsNotTaken) {
  const std::string own = fmt::format("/tmp/canhil-uid-{}", ::geteuid());
  ASSERT_EQ(::chmod(runtime_.c_str(), 0750), 0);
  EXPECT_EQ(local::directory().value(), own);
  ASSERT_EQ(::setenv("XDG_RUNTIME_DIR", "/nowhere/at/all", 1), 0);
  EXPECT_EQ(local::directory().value(), own);
  ASSERT_EQ(::setenv("XDG_RUNTIME_DIR", "relative", 1), 0);
  EXPECT_EQ(local::directory().value(), own);
}

TEST_F(LocalGate, WhatStandsInThePlaceOfTheDirectoryIsNamed) {
  const auto why = [](std::string_view bus) {
    const auto hub = host_local_bus(bus, {});
    const auto node = open_port(bus, {});
    if (hub || node) return std::string("somebody was let in");
    EXPECT_EQ(hub.error().message, node.error().message);
    return hub.error().message;
  };
  const std::string expected = fmt::format(
      "bus 'local:x': '{}': expected a directory of uid {} with mode 0700, is ", directory(), ::geteuid());
  ASSERT_EQ(::mkdir(directory().c_str(), 0700), 0);
  ASSERT_EQ(::chmod(directory().c_str(), 0755), 0);
  EXPECT_THAT(why("local:x"),
              HasSubstr(expected + fmt::format("a directory of uid {} with mode 0755;", ::geteuid())));
  ASSERT_EQ(::rename(directory().c_str(), (runtime_ + "/aside").c_str()), 0);
  ASSERT_EQ(::chmod((runtime_ + "/aside").c_str(), 0700), 0);
  ASSERT_EQ(::symlink("aside", directory().c_str()), 0);
  EXPECT_THAT(why("local:x"), HasSubstr(expected + "a symbolic link of"));
  ASSERT_EQ(::unlink(directory().c_str()), 0);
  std::ofstream(directory()) << "a file";
  EXPECT_THAT(why("local:x"), HasSubstr(expected + "a file of"));
}

TEST_F(LocalGate, TheSocketsOfADeadHostAreInNobodysWay) {
  const pid_t pid = ::fork();
  if (pid == 0) {
    const auto hub = host_local_bus("local:x", {.fd = true});
    ::_exit(hub ? 0 : 1);  // without destructors, so the sockets remain
  }
  int status = -1;
  ::waitpid(pid, &status, 0);
  ASSERT_EQ(status, 0);
  ASSERT_EQ(::access((directory() + "/x.fd").c_str(), F_OK), 0);
  const auto alone = open_port("local:x", {.fd = true});
  ASSERT_FALSE(alone);
  EXPECT_THAT(alone.error().message, HasSubstr("nobody hosts it"));
  const auto hub = host();
  ASSERT_TRUE(hub);
  EXPECT_NE(::access((directory() + "/x.fd").c_str(), F_OK), 0);
  const auto node = join(*hub);
  node->send(frame_of(1));
  EXPECT_EQ(next_frame(*hub)->frame.id, 1U);
  EXPECT_FALSE(host_local_bus("local:x", {}));
}

class AnotherUser : public LocalGate {
 protected:
  void SetUp() override {
    if (::geteuid() != 0) GTEST_SKIP() << "only root can be another user for a while";
    LocalGate::SetUp();
  }
  void TearDown() override {
    if (::geteuid() == 0) LocalGate::TearDown();
  }
  /// Opens the bus's files to all users, so that only the credentials keep other users out.
  void open_to_all() const {
    for (const std::string& path : {runtime_, directory(), directory() + "/x.classic"})
      ::chmod(path.c_str(), 0777);
  }
  /// Connects without checking the host, sends Hello and a frame. Returns 0, or errno of the connection.
  [[nodiscard]] int intrude() const {
    const Descriptor socket = local::connect_to(directory(), "x", Format::classic);
    if (!socket) return errno;
    const local::Hello hello;
    ::send(socket.get(), &hello, sizeof hello, MSG_NOSIGNAL);
    local::Datagram datagram;
    local::encode(frame_of(0x10), datagram);
    ::send(socket.get(), &datagram, datagram.bytes(), MSG_NOSIGNAL);
    return 0;
  }
};

TEST_F(AnotherUser, CannotReachTheBus) {
  const auto hub = host();
  EXPECT_EQ(as_nobody([this] { return intrude(); }), EACCES);
  EXPECT_FALSE(hub->receive());
  EXPECT_THAT(refusals_, IsEmpty());
}

TEST_F(AnotherUser, IsRefusedByItsCredentialsToo) {
  const auto hub = host();
  const auto node = join(*hub);
  open_to_all();
  EXPECT_EQ(as_nobody([this] { return intrude(); }), 0);
  ASSERT_TRUE(serve(*hub, [this] { return !refusals_.empty(); }));
  EXPECT_THAT(
      refusals_,
      ElementsAre(testing::MatchesRegex(
          "bus 'local:x': a process \\(pid [0-9]+ of uid 65534\\) is another user's and was refused")));
  EXPECT_FALSE(node->receive()) << "what it sent has reached a node";
  EXPECT_EQ(hub->nodes().size(), 1U);
}

TEST_F(AnotherUser, IsNoHostToJoin) {
  ASSERT_TRUE(host());  // makes the directory
  for (const std::string& path : {runtime_, directory()}) ::chmod(path.c_str(), 0777);
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  const pid_t pid = ::fork();
  if (pid == 0) {
    if (::setuid(nobody) != 0) ::_exit(1);
    const Descriptor socket(::socket(AF_UNIX, SOCK_SEQPACKET, 0));
    sockaddr_un at{};
    at.sun_family = AF_UNIX;
    (directory() + "/x.classic").copy(at.sun_path, sizeof at.sun_path - 1);
    if (::bind(socket.get(), reinterpret_cast<const sockaddr*>(&at), sizeof at) != 0) ::_exit(2);
    ::listen(socket.get(), 5);
    [[maybe_unused]] const auto ready = ::write(ends[1], "", 1);
    for (;;) ::pause();
  }
  char ready = 0;
  ::close(ends[1]);
  EXPECT_EQ(::read(ends[0], &ready, 1), 1);
  for (const std::string& path : {runtime_, directory()}) ::chmod(path.c_str(), 0700);
  const auto node = open_port("local:x", {});
  ::kill(pid, SIGKILL);
  ::waitpid(pid, nullptr, 0);
  ::close(ends[0]);
  ASSERT_FALSE(node);
  EXPECT_EQ(node.error().message,
            fmt::format("bus 'local:x': its host is pid {} of uid 65534, expected a process of uid 0", pid));
}

TEST_F(AnotherUser, CannotTakeTheDirectorysName) {
  ASSERT_EQ(::mkdir(directory().c_str(), 0700), 0);
  ASSERT_EQ(::chown(directory().c_str(), nobody, nobody), 0);
  const auto hub = host_local_bus("local:x", {});
  ASSERT_FALSE(hub);
  EXPECT_THAT(hub.error().message, HasSubstr("is a directory of uid 65534 with mode 0700; remove it"));
}

TEST_F(LocalGate, WhoSaysNothingIsDroppedAndNamed) {
  const auto hub = host({.hello_limit_ns = 20 * ns_per_ms});
  const auto node = join(*hub);
  const Descriptor silent = local::connect_to(directory(), "x", Format::classic);
  ASSERT_TRUE(serve(*hub, [this] { return !refusals_.empty(); }));
  EXPECT_THAT(refusals_,
              ElementsAre(fmt::format("bus 'local:x': a process ({}) sent no Hello and was dropped", us())));
  char none = 0;
  EXPECT_EQ(::recv(silent.get(), &none, 1, 0), 0) << "its connection is open still";
  EXPECT_THAT(hub->nodes(), ElementsAre("node"));
  EXPECT_FALSE(wait(*hub, WaitFor::frame, 0)) << "nobody is left to wake the host";
}

TEST_F(LocalGate, ASilentHostHoldsItAgainstNobody) {
  const auto hub = host({.hello_limit_ns = 1});
  const auto node = open_port("local:x", {.node_name = "node"}).value();
  ASSERT_TRUE(serve(*hub, [&] { return !hub->nodes().empty(); }));
  EXPECT_THAT(refusals_, IsEmpty());
}

TEST_F(LocalGate, WhoNeverReadsIsDroppedAndTheOthersGetEveryFrame) {
  const auto hub = host({.reading_limit_ns = 20 * ns_per_ms});
  const auto reader = join(*hub, "reader");
  const auto stuck = join(*hub, "stuck\n\033[2J");
  std::uint32_t sent = 0;
  std::uint32_t read = 0;
  for (const std::int64_t deadline = in_seconds(10); refusals_.empty() || read < sent;) {
    ASSERT_LT(clock_ns(CLOCK_MONOTONIC), deadline) << "the bus stands still for good";
    if (refusals_.empty() && hub->send(numbered(1, sent)) == SendOutcome::sent) ++sent;
    while (const auto got = reader->receive()) ASSERT_EQ(number_of(got->frame), read++);
    hub->receive();
  }
  EXPECT_THAT(refusals_,
              ElementsAre(fmt::format(
                  "bus 'local:x': node 'stuck??[2J' ({}) did not read its frames and was dropped", us())));
  EXPECT_THAT(hub->nodes(), ElementsAre("reader"));
  EXPECT_EQ(hub->held_up_by(), "");
}

TEST_F(LocalGate, AHostThatOnlyWaitsForRoomIsWokenToDropWhoDoesNotRead) {
  const auto hub = host({.reading_limit_ns = 20 * ns_per_ms});
  const auto stuck = join(*hub, "stuck");
  while (hub->send(frame_of(1)) == SendOutcome::sent) {
  }
  ASSERT_TRUE(wait(*hub, WaitFor::room, in_seconds(10)));
  EXPECT_EQ(hub->send(frame_of(1)), SendOutcome::sent);
  EXPECT_EQ(refusals_.size(), 1U);
}

TEST_F(LocalGate, WhoReadsSoSlowlyThatItDragsTheBusAlongIsDropped) {
  const auto hub = host({.reading_limit_ns = 100 * ns_per_ms});
  const auto slow = join(*hub, "slow");
  std::uint32_t sent = 0;
  for (const std::int64_t deadline = in_seconds(60); refusals_.empty();) {
    ASSERT_LT(clock_ns(CLOCK_MONOTONIC), deadline) << "dragged along for good";
    while (refusals_.empty() && hub->send(numbered(1, sent)) == SendOutcome::sent) ++sent;
    ::usleep(5000);
    slow->receive();  // one frame every 5 ms, so the node never blocks the hub for long
  }
  EXPECT_THAT(refusals_.front(), HasSubstr("node 'slow'"));
}

TEST_F(LocalGate, WhoSendsWhatIsNoFrameIsDroppedAndNamed) {
  const auto hub = host();
  const auto node = join(*hub);
  const Descriptor stranger = local::connect_to(directory(), "x", Format::classic);
  ASSERT_EQ(::send(stranger.get(), "hello", 5, MSG_NOSIGNAL), 5);
  ASSERT_TRUE(serve(*hub, [this] { return !refusals_.empty(); }));
  const Descriptor joined = local::connect_to(directory(), "x", Format::classic);
  local::Hello hello;
  hello.node_name = {'o', 'd', 'd'};
  ASSERT_EQ(::send(joined.get(), &hello, sizeof hello, MSG_NOSIGNAL), sizeof hello);
  ASSERT_EQ(::send(joined.get(), "frame", 5, MSG_NOSIGNAL), 5);
  ASSERT_TRUE(serve(*hub, [this] { return refusals_.size() > 1; }));
  EXPECT_THAT(
      refusals_,
      ElementsAre(
          fmt::format(
              "bus 'local:x': a process ({}) sent an invalid Hello (another version?) and was dropped", us()),
          fmt::format("bus 'local:x': node 'odd' ({}) sent an invalid frame and was dropped", us())));
  EXPECT_THAT(hub->nodes(), ElementsAre("node"));
}

// Together, three nodes have more frames waiting than the hub accepts at once.
TEST_F(LocalGate, FramesThatTheHostDoesNotWantKeepItNoLongerThanOthers) {
  const auto hub = host_local_bus("local:x", {.only_ids = {1}}).value();
  std::vector<std::unique_ptr<Port>> senders;
  int waiting = 0;
  for (int n = 0; n < 3; ++n) senders.push_back(join(*hub));
  for (const auto& sender : senders)
    while (sender->send(frame_of(2)) == SendOutcome::sent) ++waiting;
  ASSERT_GT(waiting, 600);
  EXPECT_FALSE(hub->receive());
  int room = 0;
  for (const auto& sender : senders)
    while (sender->send(frame_of(2)) == SendOutcome::sent) ++room;
  EXPECT_GT(room, 0);
  EXPECT_LE(room, 256);
  EXPECT_TRUE(wait(*hub, WaitFor::frame, 0)) << "the rest wakes the host";
}

TEST_F(LocalGate, TakesSoManyNodesAndNoMore) {
  const auto hub = host({.most_nodes = 2});
  const auto a = join(*hub, "a");
  auto b = join(*hub, "b");
  const auto third = open_port("local:x", {}).value();
  ASSERT_TRUE(serve(*hub, [this] { return !refusals_.empty(); }));
  EXPECT_THAT(refusals_,
              ElementsAre(fmt::format(
                  "bus 'local:x': a process ({}) was refused: the bus has 2 nodes, its limit", us())));
  EXPECT_FALSE(next_frame(*third));
  EXPECT_TRUE(third->closed());
  b.reset();
  EXPECT_FALSE(hub->receive());
  const auto again = join(*hub, "c");
  EXPECT_THAT(hub->nodes(), ElementsAre("a", "c"));
}

}  // namespace
}  // namespace canhil
