#include "dbc/wire/bit_length.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <algorithm>
#include <charconv>
#include <fstream>
#include <string>

namespace canhil::wire {
namespace {

std::uint32_t hex(const std::string& digits) {
  return static_cast<std::uint32_t>(std::stoul(digits, nullptr, 16));
}

/// A frame as cansend writes it, "123#0102": three digits of id are a standard id, eight an extended id.
Frame classic(const std::string& text) {
  const std::size_t mark = text.find('#');
  Frame frame{.id = hex(text.substr(0, mark)), .extended = mark == 8};
  for (std::size_t i = mark + 1; i + 1 < text.size(); i += 2)
    frame.data.at(frame.size++) = static_cast<std::uint8_t>(hex(text.substr(i, 2)));
  return frame;
}

Frame filled(std::uint32_t id, unsigned size, std::uint8_t byte, bool fd = false, bool brs = false) {
  Frame frame{.id = id, .size = static_cast<std::uint8_t>(size), .fd = fd, .brs = brs};
  std::fill_n(frame.data.begin(), size, byte);
  return frame;
}

TEST(BitLength, IsWhatCanbusloadCounts) {
  std::ifstream file(TEST_DATA_DIR "/bit_length/canbusload.txt");
  int compared = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("//")) continue;
    const std::size_t gap = line.find(' ');
    EXPECT_EQ(bit_length(classic(line.substr(0, gap))), (BitLength{.nominal = std::stoi(line.substr(gap))}))
        << line;
    ++compared;
  }
  EXPECT_EQ(compared, 50);
}

// Davis, Burns, Bril, Lukkien 2007, section 3.1: 8 bytes take at most 135 bits with an 11-bit id, 160 with a
// 29-bit id.
TEST(BitLength, AtWorst) {
  static_assert(worst_case_length(8, false).bits() == 135);
  static_assert(worst_case_length(8, true).bits() == 160);
  static_assert(worst_case_length(0, false).bits() == 55);
}

TEST(BitLength, AStuffBitOpensTheNextRun) {
  BitStream wire;
  wire.put(0b0'0000'1111, 9);
  EXPECT_EQ(wire.length(), 10);  // 00000i1111: stuff bit i and four ones, a run of five
  wire.close();
  EXPECT_EQ(wire.length(), 11);
}

// By hand: the 14 bits before FDF are zeros; here, stuff bits follow only bits 5 and 10. FDF is 1, res is 0,
// and BRS is 1. Then ESI and DLC are five zeros, but the first fixed stuff bit replaces the stuff bit that
// would follow these zeros.
TEST(BitLength, OfAnFdFrameByHand) {
  EXPECT_EQ(bit_length(filled(0, 0, 0, true, true)),
            (BitLength{.nominal = 14 + 2 + 3 + 12, .data = 5 + 4 + 17 + 6 + 1}));
  EXPECT_EQ(bit_length(filled(0, 0, 0, true, false)), (BitLength{.nominal = 31 + 33 + 1}));
}

// ISO 11898-1:2015, 10.4.2.6: frames of up to 16 bytes have CRC 17 with 6 fixed stuff bits; longer frames
// have CRC 21 with 7 fixed stuff bits.
TEST(BitLength, FdFramesChangeTheCrcAbove16Bytes) {
  static_assert(fd_crc_field_bits(16) == 4 + 17 + 6 + 1);
  static_assert(fd_crc_field_bits(20) == 4 + 21 + 7 + 1);
  // 0x55 needs no stuff bit; id 0x555 and IDE 0 need none either.
  const auto data_bits = [](unsigned size) { return bit_length(filled(0x555, size, 0x55, true, true)).data; };
  EXPECT_EQ(data_bits(16), 5 + 8 * 16 + 28);
  EXPECT_EQ(data_bits(20), 5 + 8 * 20 + 33);
  EXPECT_EQ(data_bits(64), 5 + 8 * 64 + 33);
}

TEST(BitLength, DataLengthCodes) {
  constexpr std::array<unsigned, 16> sizes{0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};
  for (unsigned code = 0; code < sizes.size(); ++code) EXPECT_EQ(data_length_code(sizes.at(code)), code);
}

RC_GTEST_PROP(BitLength, LiesBetweenTheBareAndTheWorst,
              (std::uint32_t id, bool extended, bool fd, bool brs, bool esi)) {
  const auto sizes = fd ? std::vector<unsigned>{0, 1, 5, 8, 12, 16, 20, 24, 32, 48, 64}
                        : std::vector<unsigned>{0, 1, 2, 3, 4, 5, 6, 7, 8};
  Frame frame{.id = extended ? id & 0x1FFF'FFFFU : id & 0x7FFU,
              .extended = extended,
              .fd = fd,
              .brs = fd && brs,
              .esi = fd && esi};
  frame.size = static_cast<std::uint8_t>(*rc::gen::elementOf(sizes));
  // About half of the bytes are arbitrary; the others consist of long runs of equal bits.
  for (std::size_t i = 0; i < frame.size; ++i)
    frame.data.at(i) =
        *rc::gen::oneOf(rc::gen::arbitrary<std::uint8_t>(),
                        rc::gen::element<std::uint8_t>(0x00, 0xFF, 0x0F, 0xF0, 0x3C, 0xC3, 0x87, 0x78));
  const BitLength length = bit_length(frame);
  const BitLength worst =
      fd ? worst_case_fd_length(frame.size, extended, frame.brs) : worst_case_length(frame.size, extended);
  RC_ASSERT(length.nominal <= worst.nominal);
  RC_ASSERT(length.data <= worst.data);
  const int stuffable = (fd ? (extended ? 41 : 22) : (extended ? 54 : 34)) + 8 * frame.size;
  RC_ASSERT(length.bits() >= stuffable + (fd ? fd_crc_field_bits(frame.size) + 12 : 13));
}

// The bits are ESI 0, DLC 1111, and the data 1 0000 1111 0000 ... A stuff bit follows the first data bit, and
// then every group of four data bits. The bound has one more bit, for error passive senders.
TEST(BitLength, TheWorstOfTheFdDataPhaseIsMet) {
  EXPECT_EQ(bit_length(filled(0x555, 64, 0x87, true, true)).data,
            worst_case_fd_length(64, false, true).data - 1);
}

TEST(BitLength, ErrorFramesCountForNothing) {
  EXPECT_EQ(bit_length(Frame{.id = 0x40, .size = 8, .error = true}), BitLength{});
}

TEST(BusLoad, IsTheShareOfTheInterval) {
  BitLength sum;
  for (int i = 0; i < 100; ++i) sum += worst_case_length(8, false);
  EXPECT_DOUBLE_EQ(bus_load(sum, 0.1, {.nominal = 500'000}), 0.27);
  EXPECT_DOUBLE_EQ(bus_load(sum, 0.1, {.nominal = 1'000'000}), 0.135);
}

TEST(BusLoad, CountsTheDataPhaseAtItsOwnRate) {
  const BitLength sum{.nominal = 500, .data = 4000};
  EXPECT_DOUBLE_EQ(duration_s(sum, {.nominal = 500'000, .data = 4'000'000}), 0.002);
  EXPECT_DOUBLE_EQ(duration_s(sum, {.nominal = 500'000}), 0.009);
}

}  // namespace
}  // namespace canhil::wire
