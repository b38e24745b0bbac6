// One error line for each impossible setting.
#include "dbc/protection/settings.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "dbc/protection/protection.hpp"

namespace canhil::protection {
namespace {

/// A counter in the low nibble of byte 1, a CRC in byte 0.
Settings good() {
  Settings settings;
  settings.counter = Counter{.place = {8, 4, false}, .modulo = 15, .skipped = {}, .shared_as = {}};
  settings.checksum = Checksum{};
  settings.checksum->place = {0, 8, false};
  settings.checksum->rule = published_crc("CRC-8/SAE-J1850").value();
  return settings;
}

std::string error(const std::function<void(Settings&)>& change, unsigned size = 8) {
  Settings settings = good();
  change(settings);
  const Result<Protection> made = Protection::make(settings, {.id = 0x100, .size = size});
  return made ? "none" : made.error().message;
}

TEST(ProtectionSettings, GoodOnesAreTaken) {
  EXPECT_EQ(error([](Settings&) {}), "none");
  EXPECT_EQ(error([](Settings& s) { s.checksum->place = {7, 8, true}; }), "none");
  EXPECT_EQ(error([](Settings& s) { s.checksum->place = {511 - 7, 8, false}; }, 64), "none");
  EXPECT_EQ(error([](Settings& s) { s.checksum->place = {504, 8, false}; }, 64), "none");
  EXPECT_EQ(error([](Settings& s) { s.checksum.reset(); }), "none");
  EXPECT_EQ(error([](Settings& s) { s.counter.reset(); }), "none");
}

TEST(ProtectionSettings, PlacesBeyondTheMessage) {
  EXPECT_EQ(error([](Settings& s) {
              s.counter->place = {62, 4, false};
            }),
            "counter: 4 bits from bit 62 lie beyond the message, expected a place in its 8 bytes");
  EXPECT_EQ(error([](Settings& s) {
              s.checksum->place = {57, 8, true};
            }),
            "checksum: 8 bits from bit 57 lie beyond the message, expected a place in its 8 bytes");
  EXPECT_EQ(error([](Settings& s) {
              s.checksum->place = {4294967295U, 8, false};
            }),
            "checksum: 8 bits from bit 4294967295 lie beyond the message, expected a place in its 8 bytes");
  EXPECT_EQ(error([](Settings& s) { s.counter->place.length = 0; }), "counter: 0 bits, expected 1..32");
  EXPECT_EQ(error([](Settings& s) { s.counter->place.length = 33; }), "counter: 33 bits, expected 1..32");
  EXPECT_EQ(error([](Settings& s) { s.checksum->place.length = 65; }), "checksum: 65 bits, expected 1..64");
  EXPECT_EQ(error([](Settings& s) {
              s.constants = {{{60, 8, false}, 0}};
            }),
            "constant: 8 bits from bit 60 lie beyond the message, expected a place in its 8 bytes");
  EXPECT_EQ(error([](Settings&) {}, 0), "message: 0 bytes, expected 1..64");
  EXPECT_EQ(error([](Settings&) {}, 65), "message: 65 bytes, expected 1..64");
}

TEST(ProtectionSettings, PlacesOverOneAnother) {
  EXPECT_EQ(error([](Settings& s) {
              s.counter->place = {7, 4, false};
            }),
            "counter: overlaps the checksum in byte 0, expected bits of its own");
  EXPECT_EQ(error([](Settings& s) {
              s.constants = {{{11, 4, false}, 0}};
            }),
            "constant: overlaps the counter in byte 1, expected bits of its own");
}

TEST(ProtectionSettings, Counters) {
  EXPECT_EQ(error([](Settings& s) { s.counter->modulo = 17; }),
            "counter: modulo 17, expected at most 16: it has 4 bits");
  EXPECT_EQ(error([](Settings& s) { s.counter->modulo = 1; }),
            "counter: 1 values remain (modulo 1, 0 skipped), expected at least 2");
  EXPECT_EQ(error([](Settings& s) { s.counter->skipped = {15}; }),
            "counter: skips 15, expected values below its modulo 15");
  EXPECT_EQ(error([](Settings& s) {
              s.counter->skipped = {3, 7, 3};
            }),
            "counter: skips 3 twice, expected each value once");
}

TEST(ProtectionSettings, Checksums) {
  EXPECT_EQ(error([](Settings& s) { s.checksum->rule = Crc{.width = 0, .polynomial = 1}; }),
            "CRC: width 0 bits, expected 4..64");
  EXPECT_EQ(error([](Settings& s) { s.checksum->rule = Crc{.width = 8, .polynomial = 0x12F}; }),
            "CRC: polynomial 0x12F, expected at most 0xFF, as wide as the CRC (8 bits)");
  EXPECT_EQ(error([](Settings& s) { s.checksum->rule = published_crc("CRC-16/ARC").value(); }),
            "checksum: a CRC of 16 bits in a place of 8, expected a place as wide");
  EXPECT_EQ(error([](Settings& s) { s.checksum->rule = Sum{.start = 0x100}; }),
            "checksum: start 0x100, expected at most 0xFF");
  EXPECT_EQ(error([](Settings& s) { s.checksum->rule = Sum{.final_xor = 0x1FF}; }),
            "checksum: final_xor 0x1FF, expected at most 0xFF");
  EXPECT_EQ(error([](Settings& s) {
              s.checksum->bytes = {0, 1};
            }),
            "checksum: covers itself in byte 0, expected other bytes, or own_bytes_as_zero = true");
  EXPECT_EQ(error([](Settings& s) {
              s.checksum->bytes = {0, 1};
              s.checksum->own_bytes_as_zero = true;
            }),
            "none");
  EXPECT_EQ(error([](Settings& s) {
              s.checksum->bytes = {1, 8};
            }),
            "checksum: covers byte 8, expected 0..7: the message has 8");
  EXPECT_EQ(error([](Settings& s) {
              s.checksum->bytes = {1, 2, 1};
            }),
            "checksum: covers byte 1 twice, expected each byte once");
  EXPECT_EQ(error([](Settings& s) { s.counter.reset(); }, 1),
            "checksum: covers no byte of the message, expected at least one");
  EXPECT_EQ(error([](Settings& s) { s.checksum->before.resize(17); }),
            "checksum: 17 bytes before or after the data, expected at most 16");
  EXPECT_EQ(error([](Settings& s) {
              s.checksum->after = {{Source::data_id, 0, 4}};
            }),
            "checksum: byte 4 of an id, expected 0..3");
}

TEST(ProtectionSettings, WhatDependsOnTheCounter) {
  EXPECT_EQ(error([](Settings& s) {
              s.checksum->after = {{Source::data_id_of_counter, 0, 0}};
            }),
            "data_id_list: 0 entries, expected 15: one for each value of the counter");
  EXPECT_EQ(error([](Settings& s) { s.data_id_list.resize(15); }),
            "data_id_list: not used, expected data_id_of_counter before or after the checksum's bytes");
  EXPECT_EQ(error([](Settings& s) {
              s.data_id_list.resize(15);
              s.checksum.reset();
            }),
            "data_id_list: not used, expected a checksum that covers it");
  EXPECT_EQ(error([](Settings& s) {
              s.checksum->before = {{Source::data_id_alternating, 0, 0}};
              s.counter.reset();
            }),
            "checksum: covers a byte that depends on the counter, expected a counter");
}

TEST(ProtectionSettings, Others) {
  EXPECT_EQ(error([](Settings& s) { s = {}; }),
            "protection: neither counter nor checksum, expected at least one");
  EXPECT_EQ(error([](Settings& s) {
              s.constants = {{{12, 4, false}, 16}};
            }),
            "constant: 0x10 in 4 bits, expected at most 0xF");
}

TEST(ProtectionWords, OfKinds) {
  EXPECT_EQ(std::get<Sum>(checksum_kind("sum").value()).addition, Addition::bytes);
  EXPECT_EQ(std::get<Sum>(checksum_kind("nibble_sum").value()).addition, Addition::nibbles);
  EXPECT_EQ(std::get<Sum>(checksum_kind("xor").value()).addition, Addition::xor_of_bytes);
  EXPECT_EQ(std::get<Sum>(checksum_kind("nibble_xor").value()).addition, Addition::xor_of_nibbles);
  EXPECT_EQ(std::get<Crc>(checksum_kind("crc8").value()).width, 8U);
  EXPECT_EQ(std::get<Crc>(checksum_kind("crc64").value()).width, 64U);
  for (const std::string_view word :
       {"", "crc", "crc0", "crc3", "crc65", "crc08", "crc8x", "crc-8", "crc99999999999", "add"}) {
    const auto kind = checksum_kind(word);
    ASSERT_FALSE(kind) << word;
    EXPECT_EQ(kind.error().message,
              "checksum kind '" + std::string(word) +
                  "', expected sum, nibble_sum, xor, nibble_xor or crcN with N = 4..64");
  }
}

TEST(ProtectionSettings, RangesOfBytes) {
  EXPECT_EQ(byte_range(1, 3).value(), (std::vector<unsigned>{1, 2, 3}));
  EXPECT_EQ(byte_range(63, 63).value(), (std::vector<unsigned>{63}));
  for (const auto& [first, last] : {std::pair(2, 1), std::pair(-1, 3), std::pair(0, 64)}) {
    const auto bytes = byte_range(first, last);
    ASSERT_FALSE(bytes);
    EXPECT_EQ(bytes.error().message, "bytes " + std::to_string(first) + " to " + std::to_string(last) +
                                         ", expected the first and the last of 0..63");
  }
}

TEST(ProtectionWords, OfAddedBytes) {
  EXPECT_EQ(added_byte("data_id_1").value(), (AddedByte{Source::data_id, 0, 1}));
  EXPECT_EQ(added_byte("data_id_alternating").value(), (AddedByte{Source::data_id_alternating, 0, 0}));
  EXPECT_EQ(added_byte("data_id_of_counter").value(), (AddedByte{Source::data_id_of_counter, 0, 0}));
  EXPECT_EQ(added_byte("message_id_3").value(), (AddedByte{Source::message_id, 0, 3}));
  EXPECT_EQ(added_byte("length").value(), (AddedByte{Source::length, 0, 0}));
  ASSERT_FALSE(added_byte("data_id"));
  EXPECT_EQ(
      added_byte("data_id").error().message,
      "'data_id' beside the data, expected data_id_0..data_id_3, data_id_alternating, data_id_of_counter, "
      "message_id_0..message_id_3, length or a number 0..255");
}

}  // namespace
}  // namespace canhil::protection
