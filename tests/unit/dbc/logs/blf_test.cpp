// Vector's binary logs: objects that canhil does not write, containers, and damage.
#include <zlib.h>

#include <fstream>

#include "dbc/logs/blf.hpp"
#include "dbc/logs/little_endian.hpp"
#include "tests/log_writer.hpp"
#include "tests/own_folder.hpp"
#include "tests/unit/dbc/logs/reading.hpp"

namespace canhil {
namespace {

using namespace std::string_literals;
using logs::append;
using test::read_log;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string blf_object(std::uint32_t type, const std::string& body, std::uint64_t time = 1'500'000'000,
                       std::uint32_t unit = 2, std::uint16_t version = 1) {
  const std::size_t header_size = version == 1 ? 32 : 40;
  std::string bytes = "LOBJ";
  append(bytes, static_cast<std::uint16_t>(header_size));
  append(bytes, version);
  append(bytes, static_cast<std::uint32_t>(header_size + body.size()));
  append(bytes, type);
  append(bytes, unit);
  append(bytes, std::uint32_t{0});
  append(bytes, time);
  bytes.resize(header_size, '\0');
  return bytes + body + std::string(body.size() % 4, '\0');
}

std::string blf_container(const std::string& content, bool compressed) {
  std::string packed = content;
  if (compressed) {
    uLongf size = compressBound(content.size());
    packed.resize(size);
    compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(content.data()),
             content.size());
    packed.resize(size);
  }
  std::string bytes = "LOBJ\x10\0\1\0"s;
  append(bytes, static_cast<std::uint32_t>(32 + packed.size()));
  append(bytes, std::uint32_t{10});
  append(bytes, std::uint16_t{static_cast<std::uint16_t>(compressed ? 2 : 0)});
  bytes.append(6, '\0');
  append(bytes, static_cast<std::uint32_t>(content.size()));
  bytes.append(4, '\0');
  return bytes + packed + std::string(packed.size() % 4, '\0');
}

std::string blf_header() {
  std::string bytes = "LOGG\x90\0\0\0"s;
  bytes.resize(144, '\0');
  return bytes;
}

const std::string can_message_body = "\2\0\1\2\x23\1\0\0\xAA\xBB\0\0\0\0\0\0"s;  // channel 2, sent

TEST(Blf, ObjectsWithFramesAreRead) {
  const std::string classic_remote = "\1\0\x80\4\x23\1\0\x80\0\0\0\0\0\0\0\0"s;
  const std::string fd = "\1\0\0\x09\x23\1\0\0\0\0\0\0\0\7\x0C\0\0\0\0\0\1\2\3\4\5\6\7\x08\x09\x0A\x0B\x0C"s;
  std::string fd_64 = "\3\2\2\0\x23\1\0\0"s;  // channel 3
  append(fd_64, std::uint32_t{0});
  append(fd_64, std::uint32_t{0x5000});
  fd_64.resize(34, '\0');
  fd_64 += "\1\0\0\0\0\0\xAA\xBB"s;
  std::string request = fd_64;
  request[34] = 2;
  std::string classic_64 = fd_64;
  classic_64[13] = 0;
  classic_64[34] = 0;
  std::string remote_64 = classic_64;
  remote_64[12] = 0x10;
  std::string error_ext = "\1\0\0\0\0\0\0\0\0\0\x08\0\0\0\0\0\4\0\0\0\0\0\0\0\1\2\3\4\5\6\7\x08"s;
  std::string error_of_canoe = error_ext;
  error_of_canoe[4] = 1;
  const auto read = read_log(
      blf_header() + blf_object(1, can_message_body) +
      blf_object(86, can_message_body + std::string(8, '\0'), 250'000, 1) + blf_object(1, classic_remote) +
      blf_object(100, fd) + blf_object(101, fd_64) + blf_object(101, request) + blf_object(101, classic_64) +
      blf_object(101, remote_64) + blf_object(73, error_ext) + blf_object(73, error_of_canoe) +
      blf_object(2, "\2\0\0\0\0\0\0\0"s) + blf_object(104, "\4\0"s) +
      blf_object(1, can_message_body, 1, 2, 2) + blf_object(71, "x") +
      blf_object(71, std::string(70'000, 'x')) + blf_object(4, "x"));
  EXPECT_THAT(read.error, IsEmpty());
  EXPECT_THAT(read.lines,
              ElementsAre("(1.500000) can1 123#AABB T", "(2.500000) can1 123#AABB T",
                          "(1.500000) can0 00000123#R4 R", "(1.500000) can0 123##70102030405060708090A0B0C R",
                          "(1.500000) can2 123##6AABB T", "(1.500000) can2 123#AABB R",
                          "(1.500000) can2 123#R2 R", "(1.500000) can0 20000004#0102030405060708 R",
                          "(1.500000) can0 20000080#0000000000000000 R",
                          "(1.500000) can1 20000080#0000000000000000 R",
                          "(1.500000) can3 20000080#0000000000000000 R", "(0.000000) can1 123#AABB T"));
  EXPECT_THAT(
      read.remarks,
      ElementsAre(
          HasSubstr("1 left out: requests to send; the first is log: object 6 of type 101"),
          HasSubstr("2 left out: objects other than frames of CAN; the first is log: object 14 of type 71"),
          HasSubstr("1 left out: bus statistics")));
}

TEST(Blf, ObjectsMayExtendOverContainers) {
  std::string content;
  for (int i = 0; i < 1000; ++i) content += blf_object(1, can_message_body);
  for (const bool compressed : {false, true}) {
    std::string file = blf_header();
    for (std::size_t at = 0; at < content.size(); at += 1001)
      file += blf_container(content.substr(at, 1001), compressed);
    EXPECT_EQ(read_log(file).lines.size(), 1000U) << compressed;
    EXPECT_THAT(read_log(file.substr(0, file.size() - 10)).error, HasSubstr("its last object is cut"))
        << compressed;
  }
}

TEST(Blf, ChannelsHaveTheNamesOfTheirNetworks) {
  std::string text = "\1\0\0\0\0\2\1\0\x0A\0\0\0\0\0\0\0a.dbc;bo y"s;
  EXPECT_THAT(read_log(blf_header() + blf_object(65, text) + blf_object(1, can_message_body)).lines,
              ElementsAre("(1.500000) bo_y 123#AABB T"));
}

// The header of an object states where the next one begins, so only the object itself is lost.
TEST(Blf, ObjectsThatAreNotValidAreCounted) {
  const auto read =
      read_log(blf_header() + blf_object(1, "\1\0"s) + blf_object(1, "\1\0\0\1\0\x08\0\0........"s) +
               blf_object(1, can_message_body, std::uint64_t{1} << 63U) + blf_object(1, can_message_body) +
               std::string(24, '\0'));
  EXPECT_THAT(read.lines, ElementsAre("(1.500000) can1 123#AABB T"));
  EXPECT_THAT(read.remarks,
              ElementsAre("log 'log': 1 left out: objects that are not valid, expected an object with all of "
                          "its fields; the first is log: object "
                          "1 of type 1",
                          HasSubstr("expected an id"), HasSubstr("expected a time of at most 1e9 s")));
}

TEST(Blf, WhatIsWrongIsSaid) {
  const auto said = [](const std::string& content) { return read_log(content).error; };
  EXPECT_THAT(said("LOGG\x90\0\0\0"s), HasSubstr("its header is wrong"));
  EXPECT_THAT(said(blf_header() + "not an object"), HasSubstr("expected an object, which begins with LOBJ"));
  std::string damaged = blf_container(blf_object(1, can_message_body), true);
  damaged[34] ^= 0x55;
  EXPECT_THAT(said(blf_header() + damaged), HasSubstr("compressed data are damaged"));
  std::string unknown = blf_container(blf_object(1, can_message_body), true);
  unknown[16] = 7;
  EXPECT_THAT(said(blf_header() + unknown), HasSubstr("compression method 7, expected 0 (none) or 2 (zlib)"));
}

TEST(Blf, OfSeveralContainersIsWrittenAndRead) {
  const std::string path = test::own_folder() + "/many.blf";
  std::vector<LogEntry> entries;
  for (std::uint32_t i = 0; i < 10'000; ++i) {
    LogEntry entry{.t_ns = 1'790'000'000'123'456'789 + 1'000'001 * std::int64_t{i},
                   .interface = i % 3 == 0 ? "can0" : "vcan1",
                   .frame = {}};
    entry.frame = {.id = i, .size = 64, .extended = true, .fd = true, .brs = i % 2 == 0, .esi = i % 5 == 0};
    if (i % 7 == 0) entry.frame = {.id = 4, .size = 8, .error = true};
    entry.frame.data[0] = static_cast<std::uint8_t>(i);
    entry.remote = i % 11 == 0;
    if (entry.remote) entry.frame = {.id = i & 0x7FFU, .size = 5};
    entry.transmitted = i % 2 == 0 && !entry.frame.error;
    entries.push_back(entry);
  }
  auto writer = test::log_writer(path);
  for (const LogEntry& entry : entries) writer.write(entry);
  ASSERT_TRUE(writer.close());
  std::ifstream file(path, std::ios::binary);
  const auto read = read_log(std::string(std::istreambuf_iterator<char>(file), {}));
  EXPECT_THAT(read.remarks, IsEmpty());
  ASSERT_EQ(read.entries.size(), entries.size());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    ASSERT_EQ(read.lines[i], format_log_line(entries[i])) << i;
    ASSERT_EQ(read.entries[i].t_ns, entries[i].t_ns) << i;
  }
}

}  // namespace
}  // namespace canhil
