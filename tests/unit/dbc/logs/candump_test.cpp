#include "dbc/logs/candump.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "tests/log_writer.hpp"
#include "tests/own_folder.hpp"
#include "tests/unit/dbc/ports/frames.hpp"

namespace canhil {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;

/// A file that is removed at the end of the test.
class Log : public ::testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }
  void write(const std::string& text) const { std::ofstream(path_) << text; }
  [[nodiscard]] std::string text() const {
    std::ifstream file(path_);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  [[nodiscard]] std::string why_not(const PortOptions& options = {}) const {
    const auto port = open_port("log:" + path_, options);
    return port ? "opened" : port.error().message;
  }

  const std::string path_ = test::own_folder() + "/a.log";
};

Frame parsed(const std::string& what) {
  const auto entry = parse_log_line("(1.000000) vcan0 " + what, "x");
  EXPECT_TRUE(entry) << entry.error().message;
  return entry ? entry->frame : Frame{};
}

std::string complaint(const std::string& line) {
  const auto entry = parse_log_line(line, "a.log:7");
  return entry ? "accepted" : entry.error().message;
}

TEST(LogLine, OfCandumpIsRead) {
  const auto entry = parse_log_line("(1436509052.249713) vcan0 044#2A366C2BBA", "x");
  ASSERT_TRUE(entry);
  EXPECT_EQ(entry->t_ns, 1'436'509'052'249'713'000);
  EXPECT_EQ(entry->interface, "vcan0");
  EXPECT_EQ(entry->frame, frame_of(0x44, {0x2A, 0x36, 0x6C, 0x2B, 0xBA}));
  EXPECT_FALSE(entry->transmitted);
}

TEST(LogLine, TimesHaveMicrosecondsOrNanoseconds) {
  EXPECT_EQ(parse_log_line("(1.000001) c 001#", "x")->t_ns, 1'000'001'000);
  EXPECT_EQ(parse_log_line("(1.000000001) c 001#", "x")->t_ns, 1'000'000'001);
}

TEST(LogLine, DistinguishesDirections) {
  EXPECT_TRUE(parse_log_line("(1.000000) c 001#00 T", "x")->transmitted);
  EXPECT_FALSE(parse_log_line("(1.000000) c 001#00 R", "x")->transmitted);
}

TEST(LogLine, OfEveryKindOfFrameIsRead) {
  Frame extended = frame_of(0x12345678, {0xFF});
  extended.extended = true;
  EXPECT_EQ(parsed("12345678#ff"), extended);
  extended.id = 0x44;
  EXPECT_EQ(parsed("00000044#FF"), extended) << "8 digits are an extended id, however small";
  Frame error = frame_of(0x40, {0, 1, 2, 3, 4, 5, 6, 7});
  error.error = true;
  EXPECT_EQ(parsed("20000040#0001020304050607"), error);
  Frame fd = frame_of(0x7FF, {1, 2});
  fd.fd = true;
  EXPECT_EQ(parsed("7FF##00102"), fd);
  EXPECT_EQ(parsed("7FF##40102"), fd);
  fd.esi = true;
  EXPECT_EQ(parsed("7FF##60102"), fd);
  fd.esi = false;
  fd.brs = true;
  EXPECT_EQ(parsed("7FF##10102"), fd);
  EXPECT_EQ(parsed("7FF##50102"), fd);
}

TEST(LogLine, ThatIsWrongIsExplainedWithItsColumn) {
  EXPECT_EQ(complaint(""), "a.log:7:1: expected '(' and the time in seconds");
  EXPECT_EQ(complaint("(x"), "a.log:7:2: expected the time, seconds up to 9223372035");
  EXPECT_EQ(complaint("(9436509052.249713) c 001#"),
            "a.log:7:2: expected the time, seconds up to 9223372035");
  EXPECT_EQ(complaint("(1)"), "a.log:7:3: expected '.' and 6 or 9 digits of the second");
  EXPECT_EQ(complaint("(1.12345) c 001#"), "a.log:7:9: expected 6 or 9 digits of the second");
  EXPECT_EQ(complaint("(1.123456 c 001#"), "a.log:7:10: expected ')' after the time");
  EXPECT_EQ(complaint("(1.123456)  001#"), "a.log:7:12: expected the interface's name");
  EXPECT_THAT(complaint("(1.123456) c 800#"),
              HasSubstr("a.log:7:14: expected an id of 3 hex digits up to 7FF"));
  EXPECT_THAT(complaint("(1.123456) c 44#"), HasSubstr("a.log:7:14: expected an id"));
  EXPECT_THAT(complaint("(1.123456) c 40000000#"), HasSubstr("a.log:7:14: expected an id"));
  EXPECT_EQ(complaint("(1.123456) c 001"), "a.log:7:17: expected '#' after the id");
  EXPECT_EQ(complaint("(1.123456) c 001#1"), "a.log:7:19: expected two hex digits a byte");
  EXPECT_EQ(complaint("(1.123456) c 001#112233445566778899"), "a.log:7:18: expected 0 to 8 bytes");
  EXPECT_EQ(complaint("(1.123456) c 001##0112233445566778899"),
            "a.log:7:20: expected 0-8, 12, 16, 20, 24, 32, 48 or 64 bytes");
  EXPECT_EQ(complaint("(1.123456) c 001##"), "a.log:7:19: expected a hex digit of FD flags");
  EXPECT_EQ(complaint("(1.123456) c 20000001##0"), "a.log:7:25: expected no FD error frame");
  EXPECT_EQ(complaint("(1.123456) c 001#R9"), "a.log:7:19: expected a size of 0 to 8 bytes");
  EXPECT_EQ(complaint("(1.123456) c 001#Q"),
            "a.log:7:18: expected data as hex digits, then ' T', ' R' or the end of the line");
  EXPECT_EQ(complaint("(1.123456) c 001#00 X"), "a.log:7:21: expected 'T' or 'R'");
  EXPECT_EQ(complaint("(1.123456) c 001#00 T "),
            "a.log:7:22: expected data as hex digits, then ' T', ' R' or the end of the line");
}

TEST(LogLine, WrittenIsReadBack) {
  for (const char* line :
       {"(0.000000) vcan0 000# R", "(1436509052.249713) can1 1FFFFFFF#DEADBEEF T",
        "(1.000002) vcan1 123##5000102030405060708090A0B R", "(1.000002) vcan1 00000001##400 T",
        "(1.000002) vcan1 00000001##600 T", "(1.000002) vcan1 001#R R", "(1.000002) vcan1 00000001#R8 T",
        "(1.000003) c 2000000C#0000000000000000 R"}) {
    const auto entry = parse_log_line(line, "x");
    ASSERT_TRUE(entry) << entry.error().message;
    EXPECT_EQ(format_log_line(*entry), line);
  }
}

TEST(LogLine, RoundsTimesDownToMicroseconds) {
  EXPECT_EQ(format_log_line({.t_ns = 1'999'999'999, .interface = "c", .frame = frame_of(1)}),
            "(1.999999) c 001# R");
}

TEST_F(Log, IsWrittenAndReplayed) {
  auto writer = test::log_writer(path_);
  for (std::uint32_t n = 0; n < 3; ++n) {
    writer.write({.t_ns = std::int64_t{1'000} * n,
                  .interface = "vcan0",
                  .frame = frame_of(0x100 + n),
                  .transmitted = n == 1});
  }
  ASSERT_TRUE(writer.close());
  EXPECT_EQ(text(), "(0.000000) vcan0 100# R\n(0.000001) vcan0 101# T\n(0.000002) vcan0 102# R\n");

  auto opened = open_port("log:" + path_, {});
  ASSERT_TRUE(opened) << opened.error().message;
  Port& port = **opened;
  EXPECT_TRUE(wait(port, WaitFor::frame, 0));
  EXPECT_EQ(port.send(frame_of(1)), SendOutcome::sent);
  std::vector<std::pair<std::uint32_t, std::int64_t>> seen;
  while (const auto received = port.receive()) {
    EXPECT_FALSE(received->own) << "this port has not sent it";
    seen.emplace_back(received->frame.id, received->t_ns);
  }
  EXPECT_THAT(seen, ElementsAre(std::pair(0x100U, 0), std::pair(0x101U, 1000), std::pair(0x102U, 2000)));
  EXPECT_TRUE(port.closed());
  EXPECT_EQ(port.counters().received, 3U);
}

TEST_F(Log, IsFiltered) {
  write("(0.000000) c 001#\n(0.000000) c 00000002#\n(0.000000) c 002#\n(0.000000) c 20000002#\n");
  const auto port = open_port("log:" + path_, {.only_ids = {2}});
  ASSERT_TRUE(port);
  EXPECT_EQ((*port)->receive()->frame, frame_of(2));
  EXPECT_TRUE((*port)->receive()->frame.error);
  EXPECT_FALSE((*port)->receive());
}

TEST_F(Log, ThatWentThroughWindowsIsReadAndRemoteFramesAreNone) {
  write("(0.000000) c 001#\r\n(0.000000) c 003#R8 R\r\n(0.000000) c 004#R\r\n(0.000000) c 002#11 R\r\n");
  const auto port = open_port("log:" + path_, {});
  ASSERT_TRUE(port) << port.error().message;
  EXPECT_EQ((*port)->receive()->frame, frame_of(1));
  EXPECT_EQ((*port)->receive()->frame.id, 2U);
  EXPECT_FALSE((*port)->receive());
}

TEST_F(Log, IsCheckedOnOpening) {
  write("(0.000000) c 001#\n(0.000000) c 001#0\n");
  EXPECT_EQ(why_not(), path_ + ":2:19: expected two hex digits a byte");
  write("(0.000000) c 001#\n(0.000000) c 001#01");
  EXPECT_EQ(why_not(), path_ + ":2:20: expected the end of the line: the log is cut");
  write("(0.000000) c 001##0\n");
  EXPECT_THAT(why_not(), EndsWith("holds CAN FD frames: open it with FD"));
  EXPECT_EQ(why_not({.fd = true}), "opened");
  std::filesystem::remove(path_);
  EXPECT_EQ(why_not(), "cannot read log '" + path_ + "': No such file or directory");
}

TEST(LogReading, ALineWithoutEndIsRefused) {
  const std::string path = test::own_folder() + "/canhil_endless.log";
  std::ofstream(path) << "(0.000000) vcan0 123#00 R\n(0.000000) " << std::string(1'000'000, 'x');
  auto reader = LogReader::open(path);
  ASSERT_TRUE(reader);
  ASSERT_TRUE(reader->next());
  EXPECT_EQ(reader->next().error().message,
            path + ":2: is longer than 4096 characters, expected a line of a log");
}

TEST(LogReading, LinesUpToTheLimitAreRead) {
  const std::string path = test::own_folder() + "/canhil_long_lines.log";
  const std::string head = "(0.000000) ", tail = " 123#00 R";
  for (const std::size_t length : {4096U, 4097U}) {
    std::ofstream(path) << head << std::string(length - head.size() - tail.size(), 'x') << tail << '\n';
    auto reader = LogReader::open(path);
    ASSERT_TRUE(reader);
    EXPECT_EQ(reader->next().has_value(), length == 4096);
  }
}

TEST(LogWriting, ReportsAFullDisk) {
  auto writer = test::log_writer("/dev/full");
  writer.write({.interface = "c", .frame = frame_of(1)});
  const auto closed = writer.close();
  ASSERT_FALSE(closed);
  EXPECT_EQ(closed.error().message, "cannot write log '/dev/full': No space left on device");
  auto unfinished = test::log_writer("/dev/full", "x.log");
  unfinished.write({.interface = "c", .frame = frame_of(1)});
  EXPECT_EQ(unfinished.close().error().message, "cannot write log 'x.log': No space left on device");
}

}  // namespace
}  // namespace canhil
