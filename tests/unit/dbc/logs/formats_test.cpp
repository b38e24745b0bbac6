// The log formats: written frames are read back unchanged, and every error is one line.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "dbc/logs/asc.hpp"
#include "dbc/logs/log.hpp"
#include "dbc/logs/pcap.hpp"
#include "tests/log_writer.hpp"
#include "tests/own_folder.hpp"

namespace canhil {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr std::int64_t start_ns = 1'790'000'000'123'456'789;

Frame frame_of(std::uint32_t id, std::uint8_t size, bool extended = false) {
  Frame frame{.id = id, .size = size, .extended = extended};
  for (std::uint8_t i = 0; i < size; ++i) frame.data[i] = static_cast<std::uint8_t>(17 * i + 3);
  return frame;
}

std::vector<LogEntry> all_kinds() {
  std::vector<LogEntry> all;
  const auto add = [&](Frame frame, bool transmitted, const char* interface = "can0") {
    all.push_back({.t_ns = start_ns + 1'234'567 * static_cast<std::int64_t>(all.size()),
                   .interface = interface,
                   .frame = frame,
                   .transmitted = transmitted});
  };
  add(frame_of(0x7FF, 8), true);
  add(frame_of(0, 0), false, "vcan1");
  add(frame_of(0x1FFFFFFF, 3, true), false);
  Frame fd = frame_of(0x123, 48);
  fd.fd = fd.brs = true;
  add(fd, true);
  fd.brs = false;
  fd.esi = true;
  fd.size = 0;
  add(fd, false, "vcan1");
  fd = frame_of(0x12345, 64, true);
  fd.fd = true;
  add(fd, false);
  return all;
}

std::string path_of(const std::string& name) { return test::own_folder() + "/" + name; }

void write(const std::string& path, const std::vector<LogEntry>& entries) {
  auto writer = test::log_writer(path);
  for (const LogEntry& entry : entries) writer.write(entry);
  ASSERT_TRUE(writer.close());
}

std::vector<LogEntry> read(const std::string& path) {
  std::vector<LogEntry> entries;
  auto reader = LogReader::open(path);
  EXPECT_TRUE(reader) << reader.error().message;
  for (;;) {
    auto entry = reader->next();
    EXPECT_TRUE(entry) << entry.error().message;
    if (!entry || !*entry) return entries;
    entries.push_back(**entry);
  }
}

void expect_frames(const std::vector<LogEntry>& got, const std::vector<LogEntry>& expected) {
  ASSERT_EQ(got.size(), expected.size());
  for (std::size_t i = 0; i < got.size(); ++i) EXPECT_EQ(got[i].frame, expected[i].frame) << i;
}

std::string why_not(const std::string& path) {
  auto reader = LogReader::open(path);
  if (!reader) return reader.error().message;
  for (;;) {
    const auto entry = reader->next();
    if (!entry) return entry.error().message;
    if (!*entry) return "read";
  }
}

TEST(Formats, ACaptureKeepsFramesAndNanoseconds) {
  const std::string path = path_of("a.pcap");
  auto entries = all_kinds();
  entries.push_back(
      {.t_ns = start_ns + 99'000'000, .interface = "can0", .frame = {.id = 0x40, .size = 8, .error = true}});
  write(path, entries);
  const auto got = read(path);
  expect_frames(got, entries);
  for (std::size_t i = 0; i < got.size(); ++i) EXPECT_EQ(got[i].t_ns, entries[i].t_ns) << i;
}

TEST(Formats, AnAscKeepsFramesInterfacesDirectionsAndMicroseconds) {
  const std::string path = path_of("a.asc");
  const auto entries = all_kinds();
  write(path, entries);
  const auto got = read(path);
  expect_frames(got, entries);
  for (std::size_t i = 0; i < got.size(); ++i) {
    EXPECT_EQ(got[i].t_ns, entries[i].t_ns / 1000 * 1000) << i;
    EXPECT_EQ(got[i].interface, entries[i].interface) << i;
    EXPECT_EQ(got[i].transmitted, entries[i].transmitted) << i;
  }
}

TEST(Formats, ABlfKeepsEverything) {
  const std::string path = path_of("a.blf");
  auto entries = all_kinds();
  entries.push_back(
      {.t_ns = start_ns + 99'000'000, .interface = "can0", .frame = {.id = 0x40, .size = 8, .error = true}});
  write(path, entries);
  const auto got = read(path);
  expect_frames(got, entries);
  for (std::size_t i = 0; i < got.size(); ++i) {
    EXPECT_EQ(got[i].t_ns, entries[i].t_ns) << i;
    EXPECT_EQ(got[i].interface, entries[i].interface) << i;
    EXPECT_EQ(got[i].transmitted, entries[i].transmitted) << i;
  }
}

TEST(Formats, EachKeepsRemoteFrames) {
  for (const char* name : {"remote.pcap", "remote.asc", "remote.log", "remote.blf"}) {
    write(
        path_of(name),
        {{.t_ns = start_ns, .interface = "can0", .frame = {.id = 0x123, .size = 5}, .remote = true},
         {.t_ns = start_ns, .interface = "can0", .frame = {.id = 0x123, .extended = true}, .remote = true}});
    auto reader = LogReader::open(path_of(name), RemoteFrames::kept).value();
    for (const int size : {5, 0}) {
      const auto entry = reader.next().value();
      ASSERT_TRUE(entry) << name;
      EXPECT_TRUE(entry->remote) << name;
      EXPECT_EQ(entry->frame.size, size) << name;
    }
    EXPECT_TRUE(read(path_of(name)).empty()) << name;
  }
}

TEST(Formats, AnAscKeepsTheTimeOfAnErrorFrame) {
  const std::string path = path_of("error.asc");
  write(path, {{.t_ns = start_ns, .interface = "can0", .frame = {.id = 0x40, .size = 8, .error = true}}});
  const auto got = read(path);
  ASSERT_EQ(got.size(), 1U);
  EXPECT_TRUE(got[0].frame.error);
  EXPECT_EQ(got[0].t_ns, start_ns / 1000 * 1000);
}

TEST(Formats, AnEmptyLogIsOne) {
  for (const char* name : {"empty.pcap", "empty.asc", "empty.log", "empty.blf"}) {
    write(path_of(name), {});
    EXPECT_TRUE(read(path_of(name)).empty()) << name;
  }
}

TEST(Formats, AFullDiskIsReportedByEach) {
  for (const char* name : {"x.pcap", "x.asc", "x.log", "x.blf"}) {
    auto writer = test::log_writer("/dev/full", name);
    writer.write({.interface = "c", .frame = frame_of(1, 8)});
    const auto closed = writer.close();
    ASSERT_FALSE(closed) << name;
    EXPECT_EQ(closed.error().message,
              "cannot write log '" + std::string(name) + "': No space left on device");
  }
}

// Logs in the form in which Vector's tools and python-can write them.
TEST(Asc, OfOthersIsRead) {
  const std::string path = path_of("others.asc");
  std::ofstream(path)
      << "date Sat Sep 30 03:06:13.191 pm 2017\r\n"
         "base dec  timestamps relative\r\n"
         "no internal events logged\r\n"
         "// version 9.0.0\r\n"
         "Begin Triggerblock Sat Sep 30 03:06:13.191 pm 2017\r\n"
         "   0.000000 Start of measurement\r\n"
         "   0.500000 1  Statistic: D 0 R 0 XD 0 XR 0 E 0 O 0 B 0.00%\r\n"
         "   0.250000 2  291             Rx   d 2 17 255  Length = 0 BitCount = 67 ID = 291\r\n"
         "   0.250000 2  291             Rx   r\r\n"
         "   1.000000 CANFD   1 Tx        300  EngineData                       1 0 9 12 0 1 2 3 4 5 6 7 8 9 "
         "10 11 0 0 3000 0 0 0 0 0\r\n"
         "   1.000000 1  ErrorFrame\r\n"
         "   0.000000 log trigger event\r\n"
         "End TriggerBlock\r\n";
  const auto got = read(path);
  ASSERT_EQ(got.size(), 3U);
  EXPECT_EQ(got[0].frame.id, 291U);
  EXPECT_EQ(got[0].frame.size, 2);
  EXPECT_EQ(got[0].frame.data[1], 255);
  EXPECT_EQ(got[0].interface, "can1");
  EXPECT_EQ(got[1].frame.id, 300U);
  EXPECT_EQ(got[1].frame.size, 12);
  EXPECT_TRUE(got[1].frame.brs);
  EXPECT_TRUE(got[1].transmitted);
  EXPECT_TRUE(got[2].frame.error);
  EXPECT_EQ(got[1].t_ns - got[0].t_ns, 1'250'000'000);
  EXPECT_EQ(got[0].t_ns % 1'000'000'000, 941'000'000);
}

// python-can writes the year 2026 as "2" if the microseconds end with 026. The reader ignores such a date.
// Times are then relative to the next valid date in the file or, if there is none as here, to 0.
TEST(Asc, ADateThatCannotBeIsIgnored) {
  const std::string path = path_of("date.asc"), event = "0.5 1  123 Rx d 1 00\n";
  for (const char* date :
       {"Nov 25 08:36:00.193 AM 2", "Nov 25 08:36:00 2201", "Nov 32 08:36:00 2026", "Nov 25 25:36:00 2026",
        "Nov 2147483647 08:36:00 2026", "Nov 25 08:60:00 2026", "Nov 25 08:36:4294967295 2026"}) {
    std::ofstream(path) << "date Wed " << date << "\nbase hex  timestamps absolute\n" << event;
    const auto got = read(path);
    ASSERT_EQ(got.size(), 1U) << date;
    EXPECT_EQ(got[0].t_ns, 500'000'000) << date;
  }
}

TEST(Asc, TimesThatAreTooLongAreRejected) {
  const std::string path = path_of("long.asc"), event = "4294967295.0 1  123 Rx d 1 00\n";
  for (const char* kind : {"absolute", "relative"}) {
    std::ofstream(path) << "date Wed Nov 25 08:36:00 2200\nbase hex  timestamps " << kind << "\n" << event;
    EXPECT_THAT(why_not(path), StartsWith(path + ":3: expected a time of at most 1e9 s"));
  }
}

TEST(Asc, WhatIsWrongIsSaidInOneLine) {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"0.1 1  123 Rx d 2 01", "expected 2 bytes of data"},
      {"0.1 1  123 Rx d 2 01 100", "expected a byte in place of '100'"},
      {"0.1 1  800 Rx d 0", "expected an id"},
      {"0.1 1  20000000x Rx d 0", "expected an id"},
      {"0.1 1  123 Rx d x", "expected a data length code"},
      {"0.1 1  123 Rx q 1 00", "expected 'd' or 'r' after the direction"},
      {"0.1 CANFD 1 Rx 123 1 0 9 13 00", "expected 0-8, 12, 16, 20, 24, 32, 48 or 64 bytes"},
      {"0.1 CANFD 1 Rx 123 name", "expected BRS, ESI"},
  };
  for (const auto& [line, what] : wrong) {
    const std::string path = path_of("wrong.asc");
    std::ofstream(path) << "date Sat Sep 30 15:06:13 2017\nbase hex  timestamps absolute\n" << line << "\n";
    EXPECT_THAT(why_not(path), StartsWith(fmt::format("{}:3: {}", path, what))) << line;
  }
}

TEST(Pcap, WhatIsWrongIsSaidInOneLine) {
  const std::string path = path_of("whole.pcap"), cut = path_of("cut.pcap");
  write(path, all_kinds());
  std::filesystem::copy_file(path, cut, std::filesystem::copy_options::overwrite_existing);
  std::filesystem::resize_file(cut, std::filesystem::file_size(cut) - 3);
  EXPECT_THAT(why_not(cut), StartsWith(cut + ": packet 6: the file is cut"));
  std::string text = [&] {
    std::ifstream file(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  }();
  text[20] = 1;  // link type Ethernet
  std::ofstream(cut, std::ios::binary) << text;
  EXPECT_THAT(why_not(cut), HasSubstr("its link type is EN10MB, expected CAN_SOCKETCAN, LINUX_SLL"));
}

TEST(Pcap, APacketThatIsNoFrameIsRefused) {
  using Bytes = std::vector<std::uint8_t>;
  const auto said = [](const Bytes& bytes) {
    const auto frame = logs::frame_of_packet(logs::socketcan, bytes);
    return frame ? "read" : frame.error().message;
  };
  EXPECT_EQ(said({0, 0, 0, 1, 0, 0, 0}), "7 bytes, expected a header of 8");
  EXPECT_EQ(said({0, 0, 0, 1, 2, 0, 0, 0, 9}), "1 bytes of data, expected 2");
  EXPECT_THAT(said(Bytes{0, 0, 8, 0, 0, 0, 0, 0}), HasSubstr("id 800 with 0 bytes"));
  EXPECT_EQ(said({0, 0, 0, 1, 1, 0, 0, 0, 9}), "read");
  EXPECT_EQ(said({0x40, 0, 0, 1, 8, 0, 0, 0}), "read") << "a remote frame has no data";
}

}  // namespace
}  // namespace canhil
