// Checksums of vehicle manufacturers, each with a message that was computed by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "dbc/protection/protection.hpp"

namespace canhil::protection {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr Place last_byte{56, 8, false};
const AddedByte id_low{Source::message_id, 0, 0};
const AddedByte id_high{Source::message_id, 0, 1};
const AddedByte length{Source::length, 0, 0};

Bytes summed(const Checksum& checksum, Bytes data, std::uint32_t id = 0) {
  Settings settings;
  settings.checksum = checksum;
  const Result<Protection> protection =
      Protection::make(settings, {.id = id, .size = static_cast<unsigned>(data.size())});
  if (!protection) throw std::runtime_error(protection.error().message);
  protection->protect(data, 0);
  EXPECT_EQ(Receiver().check(*protection, data), Check::ok);
  for (std::size_t bit = 0; bit < 8 * data.size();
       ++bit) {  // each sum detects one flipped bit in the covered bytes
    const unsigned byte = static_cast<unsigned>(bit / 8);
    const auto covered = covered_bytes(checksum, static_cast<unsigned>(data.size()));
    const bool own = (bits_of(checksum.place)[byte] >> (bit % 8) & 1) != 0;
    const bool seen = own || std::ranges::find(covered, byte) != covered.end();
    data[byte] ^= static_cast<std::uint8_t>(1U << (bit % 8));
    EXPECT_EQ(Receiver().check(*protection, data), seen ? Check::wrong_checksum : Check::ok) << "bit " << bit;
    data[byte] ^= static_cast<std::uint8_t>(1U << (bit % 8));
  }
  return data;
}

// In hexadecimal: 01 ^ 02 ^ 04 ^ 08 ^ 10 ^ 20 = 3F, and 3F ^ 41 = 7E.
TEST(Sums, XorOfAllOtherBytes) {
  Checksum checksum;
  checksum.place = {0, 8, false};
  checksum.rule = Sum{.addition = Addition::xor_of_bytes};
  EXPECT_EQ(summed(checksum, {0, 0x01, 0x02, 0x04, 0x08, 0x10, 0x20, 0x41})[0], 0x7E);
}

// In hexadecimal: F0 + 20 + 03 = 113, and the lowest 8 bits of this sum are 13. Bytes 3 to 6 are not covered.
TEST(Sums, SumOfAListOfBytes) {
  Checksum checksum;
  checksum.place = last_byte;
  checksum.rule = Sum{};
  checksum.bytes = {0, 1, 2};
  EXPECT_EQ(summed(checksum, {0xF0, 0x20, 0x03, 9, 9, 9, 9, 0})[7], 0x13);
}

// In hexadecimal: F0 + 20 + 03 = 113; the complement of the lowest 8 bits of this sum is FF - 13 = EC.
TEST(Sums, ComplementOfASum) {
  Checksum checksum;
  checksum.place = last_byte;
  checksum.rule = Sum{.final_xor = 0xFF};
  EXPECT_EQ(summed(checksum, {0xF0, 0x20, 0x03, 0, 0, 0, 0, 0})[7], 0xEC);
}

// In hexadecimal: the start value 7 and the bytes give 07 + F0 + 20 + 03 = 11A. The two's complement of the
// lowest 8 bits, 1A, is 100 - 1A = E6.
TEST(Sums, NegatedSumWithAStart) {
  Checksum checksum;
  checksum.place = last_byte;
  checksum.rule = Sum{.start = 7, .negated = true};
  EXPECT_EQ(summed(checksum, {0xF0, 0x20, 0x03, 0, 0, 0, 0, 0})[7], 0xE6);
}

// The sum has two bytes in Motorola byte order. In hexadecimal: FF + FF + FF = 2FD, sent as 02 FD.
TEST(Sums, SumOfSixteenBits) {
  Checksum checksum;
  checksum.place = {55, 16, true};
  checksum.rule = Sum{};
  EXPECT_EQ(summed(checksum, {0xFF, 0xFF, 0xFF, 0, 0, 0, 0, 0}),
            (Bytes{0xFF, 0xFF, 0xFF, 0, 0, 0, 0x02, 0xFD}));
}

// The sum includes the CAN id, as in messages of Tesla. In hexadecimal: the id 488 gives 88 + 04 = 8C, the
// data give 10 + 80 = 90, and 8C + 90 = 11C. The lowest 8 bits of this sum are 1C.
TEST(Sums, SumWithTheMessageId) {
  Checksum checksum;
  checksum.place = {24, 8, false};
  checksum.rule = Sum{};
  checksum.before = {id_low, id_high};
  EXPECT_EQ(summed(checksum, {0x10, 0x80, 0x00, 0x00}, 0x488)[3], 0x1C);
}

// The sum includes the length and the CAN id, as in messages of Toyota. In hexadecimal: length and id give
// 05 + 02 + E4 = EB, the data give 80 + 0A = 8A, and EB + 8A = 175. The lowest 8 bits of this sum are 75.
TEST(Sums, SumWithLengthAndMessageId) {
  Checksum checksum;
  checksum.place = {32, 8, false};
  checksum.rule = Sum{};
  checksum.before = {length, id_low, id_high};
  EXPECT_EQ(summed(checksum, {0x80, 0x00, 0x0A, 0x00, 0xEE}, 0x2E4)[4], 0x75);
}

// The checksum of Honda is 8 minus the sum of all other nibbles of the CAN id and of the data, modulo 16. In
// decimal: the nibbles of the id E4 give 14 + 4 = 18, and the nibbles of the data 12 34 56 79 2_ give 39.
// Modulo 16, 8 - 18 - 39 = -49 is equal to 15, the nibble F. The test uses a negated sum with the start value
// 8: -(8 + 18 + 39) = -65 is also equal to 15 modulo 16.
TEST(Sums, NibblesInANibble) {
  Checksum checksum;
  checksum.place = {32, 4, false};
  checksum.rule = Sum{.addition = Addition::nibbles, .start = 8, .negated = true};
  checksum.before = {id_low, id_high};
  EXPECT_EQ(summed(checksum, {0x12, 0x34, 0x56, 0x79, 0x2B}, 0xE4), (Bytes{0x12, 0x34, 0x56, 0x79, 0x2F}));
}

// The checksum is the high nibble of the last byte, and covers all other nibbles, including the low nibble A
// of the last byte: 1 ^ 2 ^ 3 ^ 4 ^ 5 ^ 6 = 7, and 7 ^ A = D.
TEST(Sums, XorOfNibbles) {
  Checksum checksum;
  checksum.place = {28, 4, false};
  checksum.rule = Sum{.addition = Addition::xor_of_nibbles};
  EXPECT_EQ(summed(checksum, {0x12, 0x34, 0x56, 0x0A}), (Bytes{0x12, 0x34, 0x56, 0xDA}));
}

// A CRC over the whole message with 0 in the checksum's byte. The CRC-8/SMBUS of the byte 0x01 is the
// remainder of x^8. This remainder is the polynomial without its term x^8: 0x07. A following zero byte
// multiplies by x^8 again: 0x07 times 0x07 without carries is 0x15.
TEST(Sums, CrcWithItsOwnByteAsZero) {
  Checksum checksum;
  checksum.place = {8, 8, false};
  checksum.rule = published_crc("CRC-8/SMBUS").value();
  EXPECT_EQ(summed(checksum, {0x01, 0xEE})[1], 0x07);
  checksum.own_bytes_as_zero = true;
  EXPECT_EQ(summed(checksum, {0x01, 0xEE})[1], 0x15);
}

// As in messages of Volkswagen, the counter selects a data id from a list, and the CRC-8/AUTOSAR covers the
// data and this data id. If one entry of the list changes, the checksum changes only for the counter that
// selects this entry.
TEST(Sums, DataIdOfTheCounter) {
  const auto crc_with = [](std::uint8_t entry, std::uint64_t counter) {
    Settings settings;
    settings.counter = Counter{.place = {8, 4, false}, .modulo = 0, .skipped = {}, .shared_as = {}};
    settings.checksum = Checksum{};
    settings.checksum->place = {0, 8, false};
    settings.checksum->rule = published_crc("CRC-8/AUTOSAR").value();
    settings.checksum->after = {{Source::data_id_of_counter, 0, 0}};
    settings.data_id_list.assign(16, 0xC0);
    settings.data_id_list[5] = entry;
    Bytes data(8);
    Protection::make(settings, {.id = 1, .size = 8}).value().protect(data, counter);
    return data[0];
  };
  EXPECT_NE(crc_with(0xC0, 5), crc_with(0xC1, 5));
  EXPECT_EQ(crc_with(0xC0, 4), crc_with(0xC1, 4));
}

}  // namespace
}  // namespace canhil::protection
