// Captures in the formats pcap and pcapng, with the link types SocketCAN, SLL and SLL2.
#include "dbc/logs/little_endian.hpp"
#include "dbc/logs/pcap.hpp"
#include "tests/unit/dbc/logs/reading.hpp"

namespace canhil {
namespace {

using namespace std::string_literals;
using logs::append;
using test::read_log;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string classic_packet = "\0\0\x01\x23\x02\0\0\0\xAA\xBB"s;
const std::string remote_packet = "\x40\0\x01\x23\x08\0\0\0"s;
const std::string fd_packet = "\x80\0\x01\x23\x02\x07\0\0\xAA\xBB"s;
const std::string xl_packet = "\0\0\0\x21\x81\x05\0\x04\0\0\0\0\xDE\xAD\xBE\xEF"s;

std::string sll(char packet_type, char protocol, const std::string& frame) {
  return "\0"s + packet_type + "\x01\x18\0\0\0\0\0\0\0\0\0\0\0"s + protocol + frame;
}
std::string sll2(char packet_type, char protocol, const std::string& frame) {
  return "\0"s + protocol + "\0\0\0\0\0\x07\x01\x18"s + packet_type + "\0\0\0\0\0\0\0\0\0"s + frame;
}

std::string pcap(std::uint32_t link, const std::vector<std::string>& packets) {
  std::string file = "\xD4\xC3\xB2\xA1\2\0\4\0\0\0\0\0\0\0\0\0\xFF\xFF\0\0"s;
  append(file, link);
  std::uint32_t t_s = 1;
  for (const std::string& packet : packets) {
    append(file, t_s++);
    append(file, std::uint32_t{500'000});
    append(file, static_cast<std::uint32_t>(packet.size()));
    append(file, static_cast<std::uint32_t>(packet.size()));
    file += packet;
  }
  return file;
}

TEST(Capture, OfSocketCanIsRead) {
  const auto read = read_log(pcap(227, {classic_packet, remote_packet, fd_packet, xl_packet}));
  EXPECT_THAT(read.lines, ElementsAre("(1.500000) can0 123#AABB R", "(2.500000) can0 123#R8 R",
                                      "(3.500000) can0 00000123##7AABB R"));
  EXPECT_THAT(read.remarks,
              ElementsAre("log 'log': 1 left out: frames of CAN XL; the first is log: packet 4"));
  EXPECT_THAT(read_log(pcap(227, {"\0\0\x01\x23\x02\0\0\0\xAA\xBB"s + std::string(62, '\0')})).lines,
              ElementsAre("(1.500000) can0 123##4AABB R"))
      << "by the size of the packet, as an old kernel sets no flag";
}

TEST(Capture, PacketsInPartAreLeftOut) {
  std::string file = pcap(227, {classic_packet.substr(0, 9), classic_packet});
  constexpr std::size_t size_on_the_wire = 24 + 12;
  file[size_on_the_wire] = 10;
  const auto read = read_log(file);
  EXPECT_THAT(read.lines, ElementsAre("(2.500000) can0 123#AABB R"));
  EXPECT_THAT(read.remarks,
              ElementsAre(HasSubstr("1 left out: packets that the capture contains only in part")));
}

TEST(Capture, OfAllInterfacesIsRead) {
  EXPECT_THAT(read_log(pcap(113, {sll(1, 0x0C, classic_packet), sll(4, 0x0D, fd_packet),
                                  sll(1, 0x0E, xl_packet), sll(1, 0, "")}))
                  .lines,
              ElementsAre("(1.500000) can0 123#AABB R", "(2.500000) can0 00000123##7AABB T"));
  const auto read = read_log(pcap(276, {sll2(1, 0x0C, classic_packet), sll2(4, 0x0D, fd_packet),
                                        sll2(1, 0x0E, xl_packet), sll2(1, 0, "")}));
  EXPECT_THAT(read.lines, ElementsAre("(1.500000) if7 123#AABB R", "(2.500000) if7 00000123##7AABB T"));
  EXPECT_THAT(read.remarks,
              ElementsAre(HasSubstr("frames of CAN XL"), HasSubstr("packets of other protocols than CAN")));
}

std::string option_bytes(std::uint16_t code, const std::string& value) {
  std::string bytes;
  append(bytes, code);
  append(bytes, static_cast<std::uint16_t>(value.size()));
  return bytes + value + std::string((4 - value.size() % 4) % 4, '\0');
}
std::string block_bytes(std::uint32_t type, const std::string& body) {
  std::string bytes;
  append(bytes, type);
  append(bytes, static_cast<std::uint32_t>(body.size() + 12));
  bytes += body;
  append(bytes, static_cast<std::uint32_t>(body.size() + 12));
  return bytes;
}
std::string section_block() {
  return block_bytes(0x0A0D0D0A, "\x4D\x3C\x2B\x1A\1\0\0\0\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF"s);
}
std::string interface_block(std::uint16_t link, const std::string& options) {
  std::string body;
  append(body, link);
  return block_bytes(1, body + "\0\0\0\0\4\0"s + options);
}
std::string packet_block(std::uint32_t index, std::uint64_t time, const std::string& bytes,
                         const std::string& options = "") {
  std::string body;
  for (const auto field :
       {index, static_cast<std::uint32_t>(time >> 32U), static_cast<std::uint32_t>(time),
        static_cast<std::uint32_t>(bytes.size()), static_cast<std::uint32_t>(bytes.size())})
    append(body, field);
  return block_bytes(6, body + bytes + std::string((4 - bytes.size() % 4) % 4, '\0') + options);
}

TEST(Pcapng, HasInterfacesWithNamesAndResolutionsInSections) {
  const std::string outbound = option_bytes(2, "\2\0\0\0"s);
  const auto read = read_log(
      section_block() + interface_block(227, option_bytes(2, "can1")) +
      interface_block(227, option_bytes(2, "vcan0") + option_bytes(9, "\x09")) +
      interface_block(1, option_bytes(2, "eth0")) + packet_block(0, 1'500'000, classic_packet, outbound) +
      packet_block(1, 2'000'000'001, fd_packet) + packet_block(2, 0, "x") +
      block_bytes(3, "\x0A\0\0\0"s + classic_packet + "\0\0"s) + block_bytes(5, "") + section_block() +
      interface_block(
          227, option_bytes(2, "can9") + option_bytes(9, "\x82") + option_bytes(14, "\x64\0\0\0\0\0\0\0"s)) +
      packet_block(0, 7, classic_packet));
  EXPECT_THAT(read.error, IsEmpty());
  EXPECT_THAT(read.lines, ElementsAre("(1.500000) can1 123#AABB T", "(2.000000) vcan0 00000123##7AABB R",
                                      "(101.750000) can9 123#AABB R"));
  EXPECT_EQ(read.entries[1].t_ns, 2'000'000'001);
  EXPECT_THAT(read.remarks, ElementsAre(HasSubstr("1 left out: packets of other link types than SocketCAN, "
                                                  "SLL and SLL2; the first is log: packet 3"),
                                        HasSubstr("1 left out: packets without a time stamp")));
}

TEST(Pcapng, IsReadInBigEndian) {
  EXPECT_THAT(
      read_log("\x0A\x0D\x0D\x0A\0\0\0\x1C\x1A\x2B\x3C\x4D\0\1\0\0\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF\0\0\0\x1C"s
               "\0\0\0\x01\0\0\0\x14\0\xE3\0\0\0\0\4\0\0\0\0\x14"s
               "\0\0\0\x06\0\0\0\x2C\0\0\0\0\0\0\0\0\0\x16\xE3\x60\0\0\0\x0A\0\0\0\x0A"s +
               classic_packet + "\0\0\0\0\0\x2C"s)
          .lines,
      ElementsAre("(1.500000) can0 123#AABB R"));
}

TEST(Pcapng, WhatIsWrongIsSaid) {
  const auto said = [](const std::string& content) { return read_log(content).error; };
  EXPECT_THAT(said(section_block() + interface_block(1, "") + packet_block(0, 0, "x")),
              HasSubstr("is not a log"));
  EXPECT_THAT(said(section_block() + packet_block(0, 0, classic_packet)),
              HasSubstr("log: packet 1: interface 0, expected one that is described"));
  const std::string whole = section_block() + interface_block(227, "") + packet_block(0, 0, classic_packet);
  EXPECT_THAT(said(whole.substr(0, whole.size() - 6)), HasSubstr("the file is cut"));
  EXPECT_THAT(said(section_block() + "\6\0\0\0\x0B\0\0\0"s), HasSubstr("a block of 11 bytes"));
}

}  // namespace
}  // namespace canhil
