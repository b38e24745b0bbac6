// The profiles compared with the protected data in the standard: AUTOSAR FO PRS E2EProtocol (document 849),
// sections 'E2E Profile N Protocol Examples'. The numbers were taken from the tests of public libraries,
// which repeat these examples: autosar-e2e on PyPI, torsko/autosar-e2e and remotivelabs/autosar-e2e on
// GitHub.
#include "dbc/protection/profiles.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>
#include <string>

#include "dbc/protection/protection.hpp"

namespace canhil::protection {
namespace {

using Bytes = std::vector<std::uint8_t>;

Protection of_profile(std::string_view name, const ProfileChoice& choice, unsigned size) {
  const Result<Settings> settings = profile(name, choice, size);
  if (!settings) throw std::runtime_error(settings.error().message);
  const Result<Protection> protection = Protection::make(*settings, {.id = 0x100, .size = size});
  if (!protection) throw std::runtime_error(protection.error().message);
  return *protection;
}

ProfileChoice with_id(std::uint32_t data_id, unsigned offset_bits = 0) {
  ProfileChoice choice;
  choice.data_id = data_id;
  choice.offset_bits = offset_bits;
  return choice;
}

ProfileChoice with_list(unsigned first, unsigned offset_bits = 0) {
  ProfileChoice choice;
  choice.data_id_list.resize(16);
  std::iota(choice.data_id_list.begin(), choice.data_id_list.end(), static_cast<std::uint8_t>(first));
  choice.offset_bits = offset_bits;
  return choice;
}

/// A protected message of zeros.
Bytes zeros(std::string_view name, const ProfileChoice& choice, unsigned size, std::uint64_t counter) {
  Bytes data(size);
  of_profile(name, choice, size).protect(data, counter);
  return data;
}

/// These bytes at an offset, zeros elsewhere.
Bytes at(std::size_t offset, const Bytes& bytes, std::size_t size) {
  Bytes all(size);
  std::ranges::copy(bytes, all.begin() + static_cast<std::ptrdiff_t>(offset));
  return all;
}

// R20-11, section 6.3.5 (E2E Profile 1 Protocol Examples): data id 0x123, 8 bytes of zeros, counters 0 and 1.
TEST(E2eProfile1, HasThePublishedExamples) {
  const ProfileChoice id = with_id(0x123);
  EXPECT_EQ(zeros("autosar-e2e-1a", id, 8, 0), at(0, {0xCC, 0x00}, 8));
  EXPECT_EQ(zeros("autosar-e2e-1a", id, 8, 1), at(0, {0x91, 0x01}, 8));
  EXPECT_EQ(zeros("autosar-e2e-1b", id, 8, 0), at(0, {0xCE, 0x00}, 8));
  EXPECT_EQ(zeros("autosar-e2e-1b", id, 8, 1), at(0, {0x02, 0x01}, 8));
  EXPECT_EQ(zeros("autosar-e2e-1-low", id, 8, 0), at(0, {0xCE, 0x00}, 8));
  EXPECT_EQ(zeros("autosar-e2e-1-low", id, 8, 1), at(0, {0x93, 0x01}, 8));
  EXPECT_EQ(zeros("autosar-e2e-1c", id, 8, 0), at(0, {0x2A, 0x10}, 8));
  EXPECT_EQ(zeros("autosar-e2e-1c", id, 8, 1), at(0, {0x77, 0x11}, 8));
}

// torsko/autosar-e2e, E2E_P01Protect_tests: the last byte contains the CRC, the first byte contains the
// counter and the nibble.
TEST(E2eProfile1, TakesOtherPlaces) {
  ProfileChoice choice = with_id(0x123);
  choice.checksum = Place{56, 8, false};
  choice.counter = Place{0, 4, false};
  choice.data_id_nibble = Place{4, 4, false};
  EXPECT_EQ(zeros("autosar-e2e-1c", choice, 8, 0), (Bytes{0x10, 0, 0, 0, 0, 0, 0, 0x2A}));
  EXPECT_EQ(zeros("autosar-e2e-1c", choice, 8, 1), (Bytes{0x11, 0, 0, 0, 0, 0, 0, 0x77}));
}

// R23-11, section 6.12.5 (E2E Profile 11 Protocol Examples, table 6.86 and the following tables): data id
// 0x123.
TEST(E2eProfile11, HasThePublishedExamples) {
  const ProfileChoice id = with_id(0x123);
  EXPECT_EQ(zeros("autosar-e2e-11a", id, 8, 0), at(0, {0xCC, 0x00}, 8));
  EXPECT_EQ(zeros("autosar-e2e-11a", id, 8, 1), at(0, {0x91, 0x01}, 8));
  EXPECT_EQ(zeros("autosar-e2e-11c", id, 8, 0), at(0, {0x2A, 0x10}, 8));
  EXPECT_EQ(zeros("autosar-e2e-11c", id, 8, 1), at(0, {0x77, 0x11}, 8));
  EXPECT_EQ(zeros("autosar-e2e-11c", with_id(0x123, 64), 16, 0), at(8, {0x7D, 0x10}, 16));
}

// R23-11, tables 6.101 and 6.102 (E2E Profile 22 Protocol Examples): the data ids of the list are 0x01 to
// 0x10, and all data bytes are zeros.
constexpr std::array<std::uint8_t, 16> crc_of_counter{0x0E, 0x1B, 0x98, 0x31, 0x0D, 0x18, 0x9B, 0x65,
                                                      0x08, 0x1D, 0x9E, 0x37, 0x0B, 0x1E, 0x9D, 0xCD};

TEST(E2eProfile22, HasThePublishedExamples) {
  for (std::uint8_t counter = 0; counter < 16; ++counter)
    EXPECT_EQ(zeros("autosar-e2e-22", with_list(1), 8, counter),
              at(0, {crc_of_counter[counter], counter}, 8));
  EXPECT_EQ(zeros("autosar-e2e-22", with_list(1, 64), 16, 1), at(8, {0x14, 0x01}, 16));
}

// The text of the standard contains no example of profile 2. Profile 2 is bus-compatible with profile 22
// (R19-11, document change history: 'Fixed interoperability issues between P01 and P11, P02 and P22'), so the
// examples of profile 22 are used. The two examples with data id list 0, 1, .. 15 are from the tests of
// autosar-e2e on PyPI.
TEST(E2eProfile2, HasTheExamplesOfProfile22) {
  for (std::uint8_t counter = 0; counter < 16; ++counter)
    EXPECT_EQ(zeros("autosar-e2e-2", with_list(1), 8, counter), at(0, {crc_of_counter[counter], counter}, 8));
  const Protection protection = of_profile("autosar-e2e-2", with_list(0), 8);
  Bytes data{0, 0, 2, 3, 4, 5, 6, 7};
  protection.protect(data, 2);
  EXPECT_EQ(data, (Bytes{0xBC, 2, 2, 3, 4, 5, 6, 7}));
  protection.protect(data, 1);
  EXPECT_EQ(data, (Bytes{0x61, 1, 2, 3, 4, 5, 6, 7}));
}

// The test computes the CRC without the library, from the text of the standard. Profile 2 uses CRC-8H2F,
// which has the polynomial 0x2F; the start value and the final xor are 0xFF. The CRC covers the bytes after
// the CRC, and then the data id that belongs to the counter.
RC_GTEST_PROP(E2eProfile2, IsThatOfTheText, ()) {
  ProfileChoice choice;
  choice.data_id_list = *rc::gen::container<Bytes>(16, rc::gen::arbitrary<std::uint8_t>());
  const auto counter = *rc::gen::inRange<std::uint8_t>(0, 16);
  const auto size = *rc::gen::inRange<std::size_t>(2, 65);
  Bytes data = *rc::gen::container<Bytes>(size, rc::gen::arbitrary<std::uint8_t>());
  of_profile("autosar-e2e-2", choice, static_cast<unsigned>(size)).protect(data, counter);

  RC_ASSERT((data[1] & 0x0F) == counter);
  Bytes covered(data.begin() + 1, data.end());
  covered.push_back(choice.data_id_list[counter]);
  unsigned crc = 0xFF;
  for (const std::uint8_t byte : covered) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 0x80U) != 0 ? ((crc << 1U) ^ 0x12FU) : crc << 1U;
  }
  RC_ASSERT(data[0] == (crc ^ 0xFFU));
}

// R20-11, section 6.6.5, tables 6.47 and 6.48 (E2E Profile 5 Protocol Examples): data id 0x1234. The example
// with counter 1 is from the tests of autosar-e2e on PyPI.
TEST(E2eProfile5, HasThePublishedExamples) {
  EXPECT_EQ(zeros("autosar-e2e-5", with_id(0x1234), 8, 0), at(0, {0x1C, 0xCA, 0x00}, 8));
  EXPECT_EQ(zeros("autosar-e2e-5", with_id(0x1234), 8, 1), at(0, {0xCF, 0x8D, 0x01}, 8));
  EXPECT_EQ(zeros("autosar-e2e-5", with_id(0x1234, 64), 16, 0), at(8, {0x28, 0x91, 0x00}, 16));
  EXPECT_EQ(zeros("autosar-e2e-5", with_id(0x1234, 64), 16, 1), at(8, {0xFB, 0xD6, 0x01}, 16));
}

// With zeros as data, the CRC has the same value if it is stored in another place, because the same bytes are
// covered in the same order.
TEST(E2eProfile5, TakesOtherPlaces) {
  ProfileChoice choice = with_id(0x1234);
  choice.checksum = Place{48, 16, false};
  choice.counter = Place{0, 8, false};
  EXPECT_EQ(zeros("autosar-e2e-5", choice, 8, 1), (Bytes{0x01, 0, 0, 0, 0, 0, 0xCF, 0x8D}));
}

// E2E Profile 4, 6 and 7 Protocol Examples, from the tests of autosar-e2e on PyPI.
TEST(E2eProfile4, HasThePublishedExamples) {
  const std::uint32_t id = 0x0A0B0C0D;
  EXPECT_EQ(zeros("autosar-e2e-4", with_id(id), 16, 0),
            at(0, {0x00, 0x10, 0x00, 0x00, 0x0A, 0x0B, 0x0C, 0x0D, 0x86, 0x2B, 0x05, 0x56}, 16));
  EXPECT_EQ(zeros("autosar-e2e-4", with_id(id), 16, 1),
            at(0, {0x00, 0x10, 0x00, 0x01, 0x0A, 0x0B, 0x0C, 0x0D, 0xA5, 0x8E, 0x68, 0x07}, 16));
  EXPECT_EQ(zeros("autosar-e2e-4", with_id(id, 64), 24, 0),
            at(8, {0x00, 0x18, 0x00, 0x00, 0x0A, 0x0B, 0x0C, 0x0D, 0x69, 0xD7, 0x50, 0x2E}, 24));
}

TEST(E2eProfile6, HasThePublishedExamples) {
  EXPECT_EQ(zeros("autosar-e2e-6", with_id(0x1234), 8, 0), at(0, {0xB1, 0x55, 0x00, 0x08, 0x00}, 8));
  EXPECT_EQ(zeros("autosar-e2e-6", with_id(0x1234), 8, 1), at(0, {0xF4, 0xF5, 0x00, 0x08, 0x01}, 8));
  EXPECT_EQ(zeros("autosar-e2e-6", with_id(0x1234, 64), 16, 0), at(8, {0x4E, 0xB7, 0x00, 0x10, 0x00}, 16));
}

TEST(E2eProfile7, HasThePublishedExamples) {
  const std::uint32_t id = 0x0A0B0C0D;
  EXPECT_EQ(zeros("autosar-e2e-7", with_id(id), 24, 0),
            at(0, {0x1F, 0xB2, 0xE7, 0x37, 0xFC, 0xED, 0xBC, 0xD9, 0x00, 0x00,
                   0x00, 0x18, 0x00, 0x00, 0x00, 0x00, 0x0A, 0x0B, 0x0C, 0x0D},
               24));
  EXPECT_EQ(zeros("autosar-e2e-7", with_id(id, 64), 32, 1),
            at(8, {0x73, 0x9B, 0x5D, 0x48, 0x76, 0x3C, 0x65, 0x56, 0x00, 0x00,
                   0x00, 0x20, 0x00, 0x00, 0x00, 0x01, 0x0A, 0x0B, 0x0C, 0x0D},
               32));
}

bool has_list(std::string_view name) { return name == "autosar-e2e-2" || name == "autosar-e2e-22"; }

// Every bit of a protected message is part of the CRC, covered by it, or constant.
TEST(E2eProfiles, FindEveryFlippedBit) {
  for (const std::string_view name : profile_names()) {
    for (const unsigned size : {8U, 24U, 64U}) {
      const ProfileChoice choice = has_list(name) ? with_list(1) : with_id(0x123);
      const Result<Settings> settings = profile(name, choice, size);
      ASSERT_TRUE(settings) << settings.error().message;
      const Result<Protection> protection = Protection::make(*settings, {.id = 0x100, .size = size});
      if (size == 8 && (name == "autosar-e2e-4" || name == "autosar-e2e-7")) {
        ASSERT_FALSE(protection) << name;
        EXPECT_THAT(protection.error().message, testing::HasSubstr("lie beyond the message"));
        continue;
      }
      ASSERT_TRUE(protection) << name << ": " << protection.error().message;
      for (std::uint64_t i = 0, counter = protection->first();
           i < std::min<std::uint64_t>(protection->period(), 16); ++i, counter = protection->next(counter)) {
        Bytes data(size);
        std::iota(data.begin(), data.end(), static_cast<std::uint8_t>(0x35 + counter));
        protection->protect(data, counter);
        EXPECT_EQ(Receiver().check(*protection, data), Check::ok) << name;
        for (unsigned bit = 0; bit < 8 * size; ++bit) {
          data[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
          EXPECT_EQ(Receiver().check(*protection, data), Check::wrong_checksum) << name << ", bit " << bit;
          data[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
        }
      }
    }
  }
}

TEST(E2eProfiles, CountAsTheStandardSays) {
  for (const std::string_view name :
       {"autosar-e2e-1a", "autosar-e2e-1b", "autosar-e2e-1c", "autosar-e2e-11a", "autosar-e2e-11c"})
    EXPECT_EQ(of_profile(name, with_id(0x123), 8).period(), 15U) << name;
  EXPECT_EQ(of_profile("autosar-e2e-2", with_list(1), 8).period(), 16U);
  EXPECT_EQ(of_profile("autosar-e2e-4", with_id(1), 24).period(), 0x10000U);
  EXPECT_EQ(of_profile("autosar-e2e-5", with_id(1), 24).period(), 0x100U);
  EXPECT_EQ(of_profile("autosar-e2e-7", with_id(1), 24).period(), 0x100000000U);
}

TEST(E2eProfiles, RefuseWhatTheyCannotHave) {
  const auto error = [](std::string_view name, const ProfileChoice& choice) {
    const Result<Settings> settings = profile(name, choice, 8);
    return settings ? std::string() : settings.error().message;
  };
  EXPECT_EQ(error("autosar-e2e-12", {}),
            "profile 'autosar-e2e-12', expected one of autosar-e2e-1a, autosar-e2e-1b, autosar-e2e-1c, "
            "autosar-e2e-1-low, autosar-e2e-2, autosar-e2e-4, autosar-e2e-5, autosar-e2e-6, autosar-e2e-7, "
            "autosar-e2e-11a, autosar-e2e-11c, autosar-e2e-22");
  EXPECT_EQ(error("autosar-e2e-11c", with_id(0x1234)),
            "profile autosar-e2e-11c: data_id 0x1234, expected at most 0xFFF");
  EXPECT_EQ(error("autosar-e2e-11a", with_id(0x12345)),
            "profile autosar-e2e-11a: data_id 0x12345, expected at most 0xFFFF");
  EXPECT_EQ(error("autosar-e2e-11a", with_id(0x123, 4)),
            "profile autosar-e2e-11a: offset_bits 4, expected whole bytes, less than 512");
  EXPECT_EQ(error("autosar-e2e-11a", with_id(0x123, 4294967288U)),
            "profile autosar-e2e-11a: offset_bits 4294967288, expected whole bytes, less than 512");
  EXPECT_EQ(error("autosar-e2e-2", with_id(1)),
            "profile autosar-e2e-2: data_id 0x1, expected data_id_list in its place");
  EXPECT_EQ(error("autosar-e2e-2", {}), "profile autosar-e2e-2: data_id_list has 0 entries, expected 16");
  EXPECT_EQ(error("autosar-e2e-5", with_list(0)),
            "profile autosar-e2e-5: data_id_list, expected data_id in its place");
  ProfileChoice nibble = with_id(1);
  nibble.data_id_nibble = Place{12, 4, false};
  EXPECT_EQ(
      error("autosar-e2e-11a", nibble),
      "profile autosar-e2e-11a: a place for the data id's nibble, expected none: only variants 1c and 11c "
      "have one");
}

}  // namespace
}  // namespace canhil::protection
