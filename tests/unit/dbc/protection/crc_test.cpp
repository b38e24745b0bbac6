#include "dbc/protection/crc.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <array>
#include <boost/crc.hpp>
#include <string_view>

#include "dbc/wire/bits.hpp"

namespace canhil::protection {
namespace {

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

constexpr std::string_view digits = "123456789";

TEST(Crc, HasThePublishedCheckValues) {
  ASSERT_GE(published_crcs().size(), 30U);
  for (const PublishedCrc& known : published_crcs()) {
    ASSERT_TRUE(validate(known.crc)) << known.name;
    EXPECT_EQ(compute(known.crc, bytes_of(digits)), known.check) << known.name;
    ASSERT_TRUE(published_crc(known.name)) << known.name;
    EXPECT_EQ(*published_crc(known.name), known.crc) << known.name;
  }
}

// Boost defines the parameters of its table-driven CRC types, so this test does not depend on the project's
// table of CRC models.
TEST(Crc, AgreesWithTheTableDrivenOnesOfBoost) {
  const auto with = [](auto crc) {
    crc.process_bytes(digits.data(), digits.size());
    return std::uint64_t{crc.checksum()};
  };
  const auto ours = [](std::string_view name) {
    return compute(published_crc(name).value(), bytes_of(digits));
  };
  EXPECT_EQ(with(boost::crc_16_type()), ours("CRC-16/ARC"));
  EXPECT_EQ(with(boost::crc_ccitt_false_t()), ours("CRC-16/IBM-3740"));
  EXPECT_EQ(with(boost::crc_xmodem_t()), ours("CRC-16/XMODEM"));
  EXPECT_EQ(with(boost::crc_32_type()), ours("CRC-32/ISO-HDLC"));
}

/// The definition of a CRC: polynomial division bit by bit, in a register as wide as the CRC.
std::uint64_t by_division(const Crc& crc, std::span<const std::uint8_t> bytes) {
  std::uint64_t rest = crc.start;
  for (const std::uint8_t byte : bytes) {
    for (unsigned i = 0; i < 8; ++i) {
      const bool in = ((byte >> (crc.input_reflected ? i : 7 - i)) & 1U) != 0;
      const bool out = ((rest >> (crc.width - 1)) & 1U) != 0;
      rest = (rest << 1U) & wire::mask(crc.width);
      if (in != out) rest ^= crc.polynomial;
    }
  }
  std::uint64_t mirrored = 0;
  for (unsigned i = 0; i < crc.width; ++i) mirrored |= ((rest >> i) & 1U) << (crc.width - 1 - i);
  return (crc.output_reflected ? mirrored : rest) ^ crc.final_xor;
}

RC_GTEST_PROP(Crc, IsTheRestOfTheDivisionForAnyModel, ()) {
  Crc crc;
  crc.width = *rc::gen::inRange(Crc::narrowest, Crc::widest + 1);
  const std::uint64_t most = wire::mask(crc.width);
  crc.polynomial = (*rc::gen::arbitrary<std::uint64_t>() & most) | 1U;
  crc.start = *rc::gen::arbitrary<std::uint64_t>() & most;
  crc.final_xor = *rc::gen::arbitrary<std::uint64_t>() & most;
  crc.input_reflected = *rc::gen::arbitrary<bool>();
  crc.output_reflected = *rc::gen::arbitrary<bool>();
  const auto bytes = *rc::gen::arbitrary<std::vector<std::uint8_t>>();
  RC_ASSERT(bool(validate(crc)));
  RC_ASSERT(compute(crc, bytes) == by_division(crc, bytes));
}

TEST(Crc, OfNoBytesIsTheStart) {
  EXPECT_EQ(compute({.width = 16, .polynomial = 0x1021, .start = 0xABCD, .final_xor = 0xFFFF}, {}), 0x5432U);
}

TEST(Crc, RefusesWhatCannotBe) {
  const auto error = [](const Crc& crc) {
    const Result<void> valid = validate(crc);
    return valid ? std::string() : valid.error().message;
  };
  EXPECT_EQ(error({.width = 0, .polynomial = 1}), "CRC: width 0 bits, expected 4..64");
  EXPECT_EQ(error({.width = 65, .polynomial = 1}), "CRC: width 65 bits, expected 4..64");
  EXPECT_EQ(error({.width = 8, .polynomial = 0x11D}),
            "CRC: polynomial 0x11D, expected at most 0xFF, as wide as the CRC (8 bits)");
  EXPECT_EQ(error({.width = 8, .polynomial = 0x1D, .start = 0x100}),
            "CRC: start 0x100, expected at most 0xFF, as wide as the CRC (8 bits)");
  EXPECT_EQ(error({.width = 8, .polynomial = 0x1D, .final_xor = 0x1FF}),
            "CRC: final_xor 0x1FF, expected at most 0xFF, as wide as the CRC (8 bits)");
  EXPECT_EQ(error({.width = 8, .polynomial = 0}),
            "CRC: polynomial 0x0 is even, expected an odd one, without its highest term and not reflected");
  EXPECT_EQ(error({.width = 64, .polynomial = ~std::uint64_t{0}}), "");
  const Result<Crc> unknown = published_crc("CRC-8/NONE");
  ASSERT_FALSE(unknown);
  EXPECT_TRUE(unknown.error().message.starts_with("CRC model 'CRC-8/NONE', expected one of CRC-4/G-704, "));
}

}  // namespace
}  // namespace canhil::protection
