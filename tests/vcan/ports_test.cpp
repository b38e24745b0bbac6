// The SocketCAN port on vcan0 and vcan1 of a real kernel (tests/vcan/run.sh provides them), alone and with
// can-utils on the same interface.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <linux/net_tstamp.h>
#include <sys/socket.h>
#include <fstream>
#include <sstream>
#include <thread>

#include "dbc/logs/log.hpp"
#include "dbc/ports/can_interface.hpp"
#include "dbc/ports/socketcan.hpp"
#include "tests/log_writer.hpp"
#include "tests/vcan/interface.hpp"

namespace canhil {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

Frame fd_frame(std::uint32_t id, std::uint8_t size, bool brs) {
  Frame frame = frame_of(id);
  frame.fd = true;
  frame.brs = brs;
  frame.esi = !brs;
  frame.size = size;
  for (std::uint8_t i = 0; i < size; ++i) frame.data[i] = static_cast<std::uint8_t>(i * 7 + size);
  return frame;
}

TEST(SocketCan, CarriesClassicFrames) {
  const auto a = open("vcan0");
  const auto b = open("vcan0");
  Frame extended = frame_of(0x1ABCDEF0, {0xFF});
  extended.extended = true;
  const auto frames = {frame_of(0x7FF, {1, 2, 3, 4, 5, 6, 7, 8}), frame_of(0), extended};
  for (const Frame& frame : frames) ASSERT_EQ(a->send(frame), SendOutcome::sent);
  for (const Frame& frame : frames) {
    const auto received = next_frame(*b);
    ASSERT_TRUE(received);
    EXPECT_EQ(received->frame, frame);
  }
  ASSERT_EQ(b->send(frame_of(0x10, {9})), SendOutcome::sent);
  EXPECT_EQ(next_frame(*a)->frame, frame_of(0x10, {9}));
  EXPECT_EQ(a->counters().sent, 3U);
  EXPECT_EQ(b->counters().received, 3U);
}

TEST(SocketCan, TheKernelTellsWhetherAProgramHasJoined) {
  const auto before = receivers_on("vcan0");
  ASSERT_TRUE(before);
  const auto other = receivers_on("vcan1");
  {
    const auto port = open("vcan0");
    EXPECT_GT(*receivers_on("vcan0"), *before);
    EXPECT_EQ(receivers_on("vcan1"), other);
  }
  EXPECT_EQ(receivers_on("vcan0"), before);
}

// The system call in which the port waits has a much shorter time-out, so the port must call it again.
TEST(SocketCan, AWaitThatHearsNothingLastsToItsDeadline) {
  const auto port = open("vcan0");
  const std::int64_t deadline_ns = clock_ns(CLOCK_MONOTONIC) + 200'000'000;
  EXPECT_FALSE(wait(*port, WaitFor::frame, deadline_ns));
  EXPECT_GE(clock_ns(CLOCK_MONOTONIC), deadline_ns);
}

TEST(SocketCan, CarriesFdFramesOfEverySize) {
  const auto a = open("vcan1", {.fd = true});
  const auto b = open("vcan1", {.fd = true});
  const auto classic = open("vcan1");
  for (const int size : {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64}) {
    const Frame frame = fd_frame(0x123, static_cast<std::uint8_t>(size), size % 2 == 0);
    ASSERT_EQ(a->send(frame), SendOutcome::sent);
    EXPECT_EQ(next_frame(*b)->frame, frame);
  }
  a->send(frame_of(0x7));
  EXPECT_EQ(next_frame(*classic)->frame, frame_of(0x7)) << "a classic port sees classic frames only";
  EXPECT_EQ(classic->send(fd_frame(1, 8, false)), SendOutcome::refused);
}

TEST(SocketCan, GivesTheKernelsStamps) {
  const auto a = open("vcan0");
  const auto b = open("vcan0");
  bool stamping = false;  // the kernel begins to stamp frames a moment after the request
  for (const std::int64_t deadline = in_seconds(5); !stamping && clock_ns(CLOCK_MONOTONIC) < deadline;) {
    a->send(frame_of(1));
    stamping = next_frame(*b)->source == StampSource::kernel;
  }
  ASSERT_TRUE(stamping);
  EXPECT_EQ(b->stamp_clock(), CLOCK_REALTIME);
  std::int64_t last = clock_ns(CLOCK_REALTIME);
  for (int n = 0; n < 1000; ++n) {
    ASSERT_EQ(send_all(*a, frame_of(1)), SendOutcome::sent);
    const std::int64_t sent = clock_ns(CLOCK_REALTIME);
    std::this_thread::yield();
    const auto received = next_frame(*b);
    ASSERT_TRUE(received);
    ASSERT_EQ(received->source, StampSource::kernel);
    ASSERT_GE(received->t_ns, last);
    ASSERT_LE(received->t_ns, clock_ns(CLOCK_REALTIME));
    last = std::min(received->t_ns, sent);
  }
}

TEST(SocketCan, AFrameWithoutAStampCostsNoLaterOneItsOwn) {
  const auto a = open("vcan0");
  const auto b = open("vcan0");
  const int none = 0;
  const int software = SOF_TIMESTAMPING_RX_SOFTWARE | SOF_TIMESTAMPING_SOFTWARE;
  ASSERT_EQ(::setsockopt(b->descriptor(), SOL_SOCKET, SO_TIMESTAMPING, &none, sizeof none), 0);
  for (int n = 0; n < 40; ++n) a->send(frame_of(1));
  for (int n = 0; n < 40; ++n) ASSERT_EQ(next_frame(*b)->source, StampSource::process);
  ASSERT_EQ(::setsockopt(b->descriptor(), SOL_SOCKET, SO_TIMESTAMPING, &software, sizeof software), 0);
  bool stamping = false;
  for (const std::int64_t deadline = in_seconds(5); !stamping && clock_ns(CLOCK_MONOTONIC) < deadline;) {
    a->send(frame_of(1));
    stamping = next_frame(*b)->source == StampSource::kernel;
  }
  EXPECT_TRUE(stamping);
}

TEST(SocketCan, EchoesOwnFramesOnRequest) {
  const auto a = open("vcan0", {.own_echo = true});
  const auto b = open("vcan0");
  a->send(frame_of(1));
  b->send(frame_of(2));
  const auto own = next_frame(*a);
  const auto other = next_frame(*a);
  ASSERT_TRUE(own && other);
  EXPECT_EQ(own->frame.id, 1U);
  EXPECT_TRUE(own->own);
  EXPECT_EQ(other->frame.id, 2U);
  EXPECT_FALSE(other->own);
  EXPECT_EQ(next_frame(*b)->frame.id, 1U);
  EXPECT_FALSE(b->receive()) << "an echo that was not asked for";
}

TEST(SocketCan, FiltersStandardIds) {
  const auto a = open("vcan0");
  const auto b = open("vcan0", {.only_ids = {0x100, 0x7FF}});
  Frame extended = frame_of(0x100);
  extended.extended = true;
  for (const Frame& frame : {frame_of(0x101), extended, frame_of(0x7FF), frame_of(0), frame_of(0x100)})
    a->send(frame);
  EXPECT_EQ(next_frame(*b)->frame, frame_of(0x7FF));
  EXPECT_EQ(next_frame(*b)->frame, frame_of(0x100));
  EXPECT_FALSE(b->receive());
  EXPECT_EQ(why_not("vcan0", {.only_ids = {0x800}}), "only_ids: 0x800 is not a standard id (0 to 0x7FF)");
}

TEST(SocketCan, ExplainsWhatItCannotOpen) {
  EXPECT_EQ(why_not("can7"), "no CAN interface 'can7' on this machine; it has: vcan0, vcan1");
  EXPECT_THAT(why_not("a-name-too-long-for-an-interface"), StartsWith("no CAN interface 'a-name-too-long"));
  EXPECT_EQ(why_not("lo"), "'lo' is not a CAN interface of this machine; it has: vcan0, vcan1");
  const Interface classic("canhil8", 16);
  EXPECT_THAT(
      why_not("canhil8", {.fd = true}),
      AllOf(StartsWith("CAN interface 'canhil8' is classic (mtu 16)"), HasSubstr("ip link set canhil8")));
  EXPECT_TRUE(open("canhil8"));
}

/// Runs candump (of can-utils), which listens on vcan1 and writes a log.
class Candump {
 public:
  Candump(int frames, const std::string& arguments) : path_("/tmp/candump-test.log") {
    started_ = std::thread([=, path = path_] {
      run(fmt::format("timeout 20 candump -L -r 4000000 -n {} {} > {}", frames, arguments, path));
    });
    const std::int64_t deadline = in_seconds(10);
    while (!listening() && clock_ns(CLOCK_MONOTONIC) < deadline) std::this_thread::yield();
    EXPECT_TRUE(listening());
  }
  Candump(const Candump&) = delete;
  Candump& operator=(const Candump&) = delete;
  ~Candump() {
    if (started_.joinable()) started_.join();
  }
  std::string path() {  // waits until candump has received all frames; returns the path of its log
    started_.join();
    return path_;
  }

 private:
  static bool listening() {
    std::ifstream list("/proc/net/can/rcvlist_all");
    std::stringstream text;
    text << list.rdbuf();
    return text.str().find("  raw") != std::string::npos;
  }
  std::string path_;
  std::thread started_;
};

std::vector<LogEntry> read_log(const std::string& path) {
  std::vector<LogEntry> entries;
  auto reader = LogReader::open(path);
  EXPECT_TRUE(reader) << reader.error().message;
  while (reader) {
    auto entry = reader->next();
    EXPECT_TRUE(entry) << entry.error().message;
    if (!entry || !*entry) break;
    entries.push_back(**entry);
  }
  return entries;
}

/// The lines of a log. The stamp and the direction (R, T) of each line are left out.
std::vector<std::string> contents(const std::string& path) {
  std::vector<std::string> lines;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    line = line.substr(line.find(' ') + 1);
    if (line.ends_with(" R") || line.ends_with(" T")) line.resize(line.size() - 2);
    lines.push_back(line);
  }
  return lines;
}

std::vector<Frame> mixed_frames(int count) {
  constexpr std::array<std::uint8_t, 7> long_sizes{12, 16, 20, 24, 32, 48, 64};
  std::vector<Frame> frames;
  for (int n = 0; n < count; ++n) {
    const auto u = static_cast<std::uint32_t>(n);
    Frame frame = fd_frame(u * 7 % 0x800, static_cast<std::uint8_t>(u % 9), false);
    frame.fd = n % 3 == 0;
    frame.brs = frame.fd && n % 2 == 0;
    frame.esi = frame.fd && n % 2 != 0;
    if (frame.fd && n % 5 == 0) frame.size = long_sizes[u / 15 % long_sizes.size()];
    if (n % 4 == 1) frame.id = u * 0x1234567 & 0x1FFF'FFFF;
    frame.extended = n % 4 == 1;
    if (n % 50 == 10) frame = frame_of(0x40, {0, 1, 2, 3, 4, 5, 6, 7});
    frame.error = n % 50 == 10;
    frames.push_back(frame);
  }
  return frames;
}

void write_log(const std::string& path, const std::vector<Frame>& frames) {
  auto writer = test::log_writer(path);
  for (std::size_t n = 0; n < frames.size(); ++n) {
    writer.write({.t_ns = static_cast<std::int64_t>(1'000'000'000'123'456'789 + n * 1'000'000),
                  .interface = "vcan1",
                  .frame = frames[n],
                  .transmitted = n % 2 == 0});
  }
  ASSERT_TRUE(writer.close());
}

TEST(CanUtils, CandumpRecordsWhatOurWriterWrites) {
  const auto frames = mixed_frames(1000);
  write_log("/tmp/ours.log", frames);
  Candump candump(1000, "vcan1,0:0,#FFFFFFFF");
  const auto port = open("vcan1", {.fd = true});
  for (const Frame& frame : frames) ASSERT_EQ(send_all(*port, frame), SendOutcome::sent);
  const std::string theirs = candump.path();
  EXPECT_EQ(contents(theirs), contents("/tmp/ours.log"));
  const auto entries = read_log(theirs);
  ASSERT_EQ(entries.size(), frames.size());
  for (std::size_t n = 0; n < frames.size(); ++n) ASSERT_EQ(entries[n].frame, frames[n]) << n;
}

TEST(CanUtils, CanplayerPlaysOurLog) {
  const auto frames = mixed_frames(100);
  write_log("/tmp/ours.log", frames);
  const auto port = open("vcan1", {.fd = true});
  run("canplayer -t -I /tmp/ours.log 2>/tmp/canplayer.err && ! grep . /tmp/canplayer.err");
  for (const Frame& frame : frames) {
    const auto received = next_frame(*port);
    ASSERT_TRUE(received);
    ASSERT_EQ(received->frame, frame);
  }
}

TEST(CanUtils, Log2ascConvertsOurLogWithDirections) {
  write_log("/tmp/ours.log",
            mixed_frames(30));  // 15 transmitted; one is an error frame, which has no direction in ASC
  run("log2asc -I /tmp/ours.log -O /tmp/ours.asc vcan1 && [ $(grep -c Tx /tmp/ours.asc) = 14 ]");
}

TEST(CanUtils, CangensFramesAreReceived) {
  const auto port = open("vcan1", {.fd = true});
  run("cangen vcan1 -g 0 -n 60 -I i -L i -D i && cangen vcan1 -g 0 -n 40 -I i -L i -D i -f -b");
  const auto first = next_frame(*port);
  ASSERT_TRUE(first);
  int count = 1;
  int fd = first->frame.fd ? 1 : 0;
  while (const auto received = port->receive()) {
    ++count;
    fd += received->frame.fd ? 1 : 0;
  }
  EXPECT_EQ(count, 100);
  EXPECT_EQ(fd, 40);
  EXPECT_EQ(port->counters().overflowed, 0U);
}

}  // namespace
}  // namespace canhil
