// Long logs with frames of all kinds, converted between the formats by hil-bench and by other programs:
// python-can, tshark and editcap, log2asc, asc2log and log2long. No program of Debian writes the CSV of
// SavvyCAN.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>

#include "dbc/logs/candump.hpp"
#include "dbc/wire/frame_rules.hpp"
#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

constexpr std::size_t frames = 100'000;

// A frame as words, in the form of others.py; an error frame is only "error", because most formats keep no
// more.
struct Seen {
  std::int64_t t_us = 0;
  std::string frame;
};
using Log = std::vector<Seen>;

std::string words_of(const LogEntry& entry) {
  const Frame& frame = entry.frame;
  if (frame.error) return "error";
  std::string flags, data;
  for (const auto& [letter, there] :
       {std::pair('x', frame.extended), std::pair('r', entry.remote), std::pair('f', frame.fd),
        std::pair('b', frame.brs), std::pair('s', frame.esi)})
    if (there) flags += letter;
  for (const std::uint8_t byte : frame.payload()) data += fmt::format("{:02x}", byte);
  if (entry.remote) data = std::to_string(frame.size);
  return fmt::format("{:X} {} {}", frame.id, flags.empty() ? "-" : flags, data.empty() ? "-" : data);
}

std::string written_log() {
  std::mt19937 random(42);
  const auto below = [&](std::uint32_t most) { return static_cast<std::uint32_t>(random() % most); };
  std::ofstream file(scratch("all.log"));
  LogEntry entry{.t_ns = 1'790'000'000'123'000'000, .interface = "", .frame = {}};
  for (std::size_t i = 0; i < frames; ++i) {
    const std::uint32_t kind = below(10);
    Frame& frame = entry.frame;
    frame = {.size = static_cast<std::uint8_t>(below(9)), .extended = below(2) == 1};
    // Not 0: Wireshark knows another protocol for this id.
    frame.id = 1 + below(frame.extended ? max_extended_id : max_standard_id);
    entry.interface = fmt::format("can{}", below(2));
    entry.transmitted = below(2) == 1;
    entry.remote = kind == 0;
    if (kind == 1) {
      frame = {.id = 0x80U | below(0x80), .size = 8, .error = true};
      entry.transmitted = false;
    } else if (kind > 1 && kind < 6) {
      frame.fd = true;
      frame.brs = below(2) == 1;
      frame.esi = below(2) == 1;
      frame.size = size_of_dlc.at(below(16));
    }
    for (std::size_t byte = 0; !entry.remote && byte < frame.size; ++byte)
      frame.data.at(byte) = static_cast<std::uint8_t>(below(256));
    file << format_log_line(entry) << '\n';
    entry.t_ns += 1000 * (1 + std::int64_t{below(400)});
  }
  return scratch("all.log");
}

// The log that all tests of this process convert.
const std::string& all() {
  static const std::string path = written_log();
  return path;
}

Log seen_in(const std::string& log) {
  Log seen;
  auto reader = LogReader::open(log, RemoteFrames::kept);
  EXPECT_TRUE(reader) << reader.error().message;
  for (;;) {
    const auto entry = reader->next();
    EXPECT_TRUE(entry) << entry.error().message;
    if (!entry || !*entry) break;
    seen.push_back({(*entry)->t_ns / 1000, words_of(**entry)});
  }
  EXPECT_THAT(reader->remarks(), testing::IsEmpty());
  return seen;
}

// The frames of a log as python-can reads them.
Log seen_by_python_can(const std::string& log) {
  const Ended ended = shell(
      fmt::format("/usr/bin/python3 {}/tests/processes/recordings/others.py frames {}", SOURCE_DIR, log));
  EXPECT_EQ(ended.code, 0) << ended.err;
  Log seen;
  std::istringstream lines(ended.out);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t blank = line.find(' ');
    const std::string frame = line.substr(blank + 1), flags = frame.substr(frame.find(' ') + 1);
    const bool error = flags.substr(0, flags.find(' ')).find('e') != std::string::npos;
    seen.push_back({std::strtoll(line.c_str(), nullptr, 10), error ? "error" : frame});
  }
  return seen;
}

void run(const std::string& command) {
  const Ended ended = shell(command);
  ASSERT_EQ(ended.code, 0) << command << '\n' << ended.err;
}

std::string converted(const std::string& from, const std::string& name) {
  run(fmt::format("{} log convert {} {}", HIL_BENCH, from, scratch(name)));
  return scratch(name);
}

// Compares times, relative to the first frame if `relative`, and frames after `change`.
struct Manner {
  std::int64_t tolerance_us = 0;
  bool relative = false;
  std::function<std::string(const std::string&)> change = [](const std::string& frame) { return frame; };
};
void expect_same(const Log& got, const Log& expected, const Manner& manner = {}) {
  ASSERT_EQ(got.size(), expected.size());
  const std::int64_t shift_us = manner.relative ? got[0].t_us - expected[0].t_us : 0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    ASSERT_EQ(manner.change(got[i].frame), manner.change(expected[i].frame)) << i;
    ASSERT_NEAR(static_cast<double>(got[i].t_us - shift_us - expected[i].t_us), 0,
                static_cast<double>(manner.tolerance_us))
        << i;
  }
}

TEST(RoundTrip, ThroughBlfKeepsEveryLine) {
  EXPECT_EQ(read(converted(converted(all(), "a.blf"), "b.log")), read(all()));
}

TEST(RoundTrip, ThroughAscAndPcapKeepsFrames) {
  const Log expected = seen_in(all());
  ASSERT_EQ(expected.size(), frames);
  expect_same(seen_in(converted(all(), "a.asc")), expected);
  expect_same(seen_in(converted(all(), "a.pcap")), expected);
}

TEST(RoundTrip, PythonCanReadsWhatWeWrite) {
  const Log expected = seen_in(all());
  expect_same(seen_by_python_can(all()), expected);
  expect_same(seen_by_python_can(converted(all(), "a.blf")), expected);
  // python-can takes a CAN FD frame without data in an ASC log for a remote frame.
  const auto without_remote_fd = [](std::string frame) {
    const std::size_t remote = frame.find("rf");
    if (remote == std::string::npos || !frame.ends_with(" 0")) return frame;
    frame.back() = '-';
    return frame.erase(remote, 1);
  };
  expect_same(seen_by_python_can(converted(all(), "a.asc")), expected, {.change = without_remote_fd});
}

TEST(RoundTrip, WeReadWhatPythonCanWrites) {
  const Log expected = seen_in(all());
  const auto copied = [&](const std::string& name) {
    run(fmt::format("/usr/bin/python3 {}/tests/processes/recordings/others.py copy {} {}", SOURCE_DIR, all(),
                    scratch(name)));
    return scratch(name);
  };
  expect_same(seen_in(copied("python.asc")), expected, {.tolerance_us = 1});
  expect_same(seen_in(copied("python.blf")), expected, {.tolerance_us = 1});
  // python-can writes no size of a remote frame into a log of candump.
  const auto without_size = [](const std::string& frame) {
    const std::size_t flags = frame.find(' ') + 1, end = frame.find(' ', flags);
    return frame.find('r', flags) < end && frame != "error" ? frame.substr(0, end) : frame;
  };
  expect_same(seen_in(copied("python.log")), expected, {.tolerance_us = 1, .change = without_size});
}

TEST(RoundTrip, CanUtilsReadAndWriteOurLogs) {
  const Log expected = seen_in(all());
  run(fmt::format("log2asc -I {} -O {} can0 can1", all(), scratch("log2asc.asc")));
  expect_same(seen_in(scratch("log2asc.asc")), expected, {.relative = true});
  // asc2log needs the locale de_DE to understand the date; without it, the times count from the present. It
  // carries into the second only from 1000001 us on, so about one log in ten has the time "N.1000000".
  run(fmt::format("asc2log -I {} -O {} 2>/dev/null", converted(all(), "a.asc"), scratch("asc2log.log")));
  run(fmt::format("perl -i -pe 's/^\\((\\d+)\\.1000000\\)/\"(\" . ($1 + 1) . \".000000)\"/e' {}",
                  scratch("asc2log.log")));
  expect_same(seen_in(scratch("asc2log.log")), expected, {.relative = true});
}

// log2long writes what candump shows on the screen. This has neither BRS nor ESI.
TEST(RoundTrip, WeReadWhatCandumpShows) {
  run(fmt::format("log2long <{} >{}", all(), scratch("long.log")));
  const auto without_flags = [](std::string frame) {
    const std::size_t flags = frame.find(' ') + 1, end = frame.find(' ', flags);
    if (frame == "error") return frame;
    std::string kept = frame.substr(flags, end - flags);
    std::erase_if(kept, [](char flag) { return flag == 'b' || flag == 's'; });
    return frame.replace(flags, end - flags, kept);
  };
  expect_same(seen_in(scratch("long.log")), seen_in(all()), {.change = without_flags});
}

// The frames of classic CAN that carry data: python-can writes no others into a TRC log, and SavvyCAN's CSV
// has neither remote frames nor error frames.
const std::string& classic_data() {
  static const std::string path = [] {
    std::ofstream file(scratch("classic.log"));
    auto reader = LogReader::open(all());
    for (auto entry = reader->next(); entry && *entry; entry = reader->next()) {
      if (!(*entry)->frame.fd && !(*entry)->frame.error) file << format_log_line(**entry) << '\n';
    }
    return scratch("classic.log");
  }();
  return path;
}

TEST(RoundTrip, WeReadTheTrcOfPythonCan) {
  run(fmt::format("/usr/bin/python3 {}/tests/processes/recordings/others.py copy {} {}", SOURCE_DIR,
                  classic_data(), scratch("python.trc")));
  const Log expected = seen_in(classic_data());
  ASSERT_GT(expected.size(), frames / 4);
  expect_same(seen_in(scratch("python.trc")), expected, {.tolerance_us = 1, .relative = true});
}

TEST(RoundTrip, WeReadTheCsvOfSavvyCan) {
  std::ofstream file(scratch("savvy.csv"));
  file << "Time Stamp,ID,Extended,Dir,Bus,LEN,D1,D2,D3,D4,D5,D6,D7,D8\n";
  auto reader = LogReader::open(classic_data());
  ASSERT_TRUE(reader);
  for (auto entry = reader->next(); entry && *entry; entry = reader->next()) {
    const Frame& frame = (*entry)->frame;
    file << fmt::format("{},{:08X},{},{},{},{},", (*entry)->t_ns / 1000, frame.id, frame.extended,
                        (*entry)->transmitted ? "Tx" : "Rx", (*entry)->interface.back(), frame.size);
    for (const std::uint8_t byte : frame.payload()) file << fmt::format("{:02X},", byte);
    file << '\n';
  }
  file.close();
  EXPECT_EQ(read(converted(scratch("savvy.csv"), "of_csv.log")), read(classic_data()));
}

TEST(RoundTrip, TsharkReadsAndEditcapWritesOurCaptures) {
  const std::string capture = converted(all(), "a.pcap");
  for (const char* format : {"pcapng", "nsecpcap", "pcap"}) {
    const std::string theirs = scratch(fmt::format("editcap.{}", format));
    run(fmt::format("editcap -F {} {} {}", format, capture, theirs));
    expect_same(seen_in(theirs), seen_in(all()));
  }
  const Ended ended =
      shell(fmt::format("tshark -r {} -T fields -E separator=, -e can.id -e can.flags.xtd -e can.flags.rtr "
                        "-e can.flags.err -e canfd.flags.brs "
                        "-e canfd.flags.esi -e can.len -e data 2>/dev/null",
                        capture));
  ASSERT_EQ(ended.code, 0) << ended.err;
  auto reader = LogReader::open(all(), RemoteFrames::kept);
  ASSERT_TRUE(reader);
  std::istringstream lines(ended.out);
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const auto entry = reader->next();
    ASSERT_TRUE(entry && *entry);
    const Frame& frame = (*entry)->frame;
    std::string data;
    for (const std::uint8_t byte : frame.payload()) data += fmt::format("{:02x}", byte);
    const auto flag = [](bool there) { return there ? '1' : '0'; };
    if (frame.error)
      ASSERT_THAT(line, testing::StartsWith(",,,1,")) << count;
    else if (frame.fd)
      ASSERT_EQ(line, fmt::format("{},{},,,{},{},{},{}", frame.id, flag(frame.extended), flag(frame.brs),
                                  flag(frame.esi), frame.size, data));
    else
      ASSERT_EQ(line, fmt::format("{},{},{},0,,,{},{}", frame.id, flag(frame.extended),
                                  flag((*entry)->remote), frame.size, (*entry)->remote ? "" : data));
  }
  EXPECT_EQ(count, frames);
}

}  // namespace
}  // namespace canhil::test
