#include "dbc/protection/crc.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/crc.hpp>
#include <string>

#include "dbc/wire/bits.hpp"

namespace canhil::protection {
namespace {

// Source: Greg Cook, Catalogue of parametrised CRC algorithms (reveng.sourceforge.io/crc-catalogue). The
// columns are: name, {width, polynomial, start, input reflected, output reflected, final xor}, check.
constexpr std::uint64_t ones = ~std::uint64_t{0};
constexpr std::array catalogue{
    PublishedCrc{"CRC-4/G-704", {4, 0x3, 0, true, true, 0}, 0x7},
    PublishedCrc{"CRC-4/INTERLAKEN", {4, 0x3, 0xF, false, false, 0xF}, 0xB},
    PublishedCrc{"CRC-5/USB", {5, 0x05, 0x1F, true, true, 0x1F}, 0x19},
    PublishedCrc{"CRC-7/MMC", {7, 0x09, 0, false, false, 0}, 0x75},
    PublishedCrc{"CRC-8/AUTOSAR", {8, 0x2F, 0xFF, false, false, 0xFF}, 0xDF},
    PublishedCrc{"CRC-8/BLUETOOTH", {8, 0xA7, 0, true, true, 0}, 0x26},
    PublishedCrc{"CRC-8/DVB-S2", {8, 0xD5, 0, false, false, 0}, 0xBC},
    PublishedCrc{"CRC-8/GSM-A", {8, 0x1D, 0, false, false, 0}, 0x37},
    PublishedCrc{"CRC-8/MAXIM-DOW", {8, 0x31, 0, true, true, 0}, 0xA1},
    PublishedCrc{"CRC-8/NRSC-5", {8, 0x31, 0xFF, false, false, 0}, 0xF7},
    PublishedCrc{"CRC-8/OPENSAFETY", {8, 0x2F, 0, false, false, 0}, 0x3E},
    PublishedCrc{"CRC-8/SAE-J1850", {8, 0x1D, 0xFF, false, false, 0xFF}, 0x4B},
    PublishedCrc{"CRC-8/SMBUS", {8, 0x07, 0, false, false, 0}, 0xF4},
    PublishedCrc{"CRC-12/UMTS", {12, 0x80F, 0, false, true, 0}, 0xDAF},
    PublishedCrc{"CRC-15/CAN", {15, 0x4599, 0, false, false, 0}, 0x059E},
    PublishedCrc{"CRC-16/ARC", {16, 0x8005, 0, true, true, 0}, 0xBB3D},
    PublishedCrc{"CRC-16/IBM-3740", {16, 0x1021, 0xFFFF, false, false, 0}, 0x29B1},
    PublishedCrc{"CRC-16/KERMIT", {16, 0x1021, 0, true, true, 0}, 0x2189},
    PublishedCrc{"CRC-16/MODBUS", {16, 0x8005, 0xFFFF, true, true, 0}, 0x4B37},
    PublishedCrc{"CRC-16/PROFIBUS", {16, 0x1DCF, 0xFFFF, false, false, 0xFFFF}, 0xA819},
    PublishedCrc{"CRC-16/XMODEM", {16, 0x1021, 0, false, false, 0}, 0x31C3},
    PublishedCrc{"CRC-17/CAN-FD", {17, 0x1685B, 0, false, false, 0}, 0x04F03},
    PublishedCrc{"CRC-21/CAN-FD", {21, 0x102899, 0, false, false, 0}, 0x0ED841},
    PublishedCrc{"CRC-24/OPENPGP", {24, 0x864CFB, 0xB704CE, false, false, 0}, 0x21CF02},
    PublishedCrc{"CRC-32/AUTOSAR", {32, 0xF4ACFB13, 0xFFFFFFFF, true, true, 0xFFFFFFFF}, 0x1697D06A},
    PublishedCrc{"CRC-32/ISCSI", {32, 0x1EDC6F41, 0xFFFFFFFF, true, true, 0xFFFFFFFF}, 0xE3069283},
    PublishedCrc{"CRC-32/ISO-HDLC", {32, 0x04C11DB7, 0xFFFFFFFF, true, true, 0xFFFFFFFF}, 0xCBF43926},
    PublishedCrc{"CRC-32/MPEG-2", {32, 0x04C11DB7, 0xFFFFFFFF, false, false, 0}, 0x0376E6E7},
    PublishedCrc{"CRC-40/GSM", {40, 0x0004820009, 0, false, false, 0xFFFFFFFFFF}, 0xD4164FC646},
    PublishedCrc{"CRC-64/ECMA-182", {64, 0x42F0E1EBA9EA3693, 0, false, false, 0}, 0x6C40DF5F0B497347},
    PublishedCrc{"CRC-64/GO-ISO", {64, 0x1B, ones, true, true, ones}, 0xB90956C775A41001},
    PublishedCrc{"CRC-64/XZ", {64, 0x42F0E1EBA9EA3693, ones, true, true, ones}, 0x995DC9BBDF1939FA},
};

}  // namespace

std::span<const PublishedCrc> published_crcs() { return catalogue; }

Result<Crc> published_crc(std::string_view name) {
  const auto found = std::ranges::find(catalogue, name, &PublishedCrc::name);
  if (found != catalogue.end()) return found->crc;
  std::string names;
  for (const PublishedCrc& known : catalogue)
    names += fmt::format("{}{}", names.empty() ? "" : ", ", known.name);
  return failure(fmt::format("CRC model '{}', expected one of {}", name, names));
}

Result<void> validate(const Crc& crc) {
  if (crc.width < Crc::narrowest || crc.width > Crc::widest)
    return failure(
        fmt::format("CRC: width {} bits, expected {}..{}", crc.width, Crc::narrowest, Crc::widest));
  const std::uint64_t most = wire::mask(crc.width);
  const auto too_wide = [&](std::string_view what, std::uint64_t value) {
    return failure(fmt::format("CRC: {} 0x{:X}, expected at most 0x{:X}, as wide as the CRC ({} bits)", what,
                               value, most, crc.width));
  };
  if (crc.polynomial > most) return too_wide("polynomial", crc.polynomial);
  if (crc.start > most) return too_wide("start", crc.start);
  if (crc.final_xor > most) return too_wide("final_xor", crc.final_xor);
  if (crc.polynomial % 2 == 0)
    return failure(fmt::format(
        "CRC: polynomial 0x{:X} is even, expected an odd one, without its highest term and not reflected",
        crc.polynomial));
  return {};
}

// Computes CRCs of all widths with a register of 64 bits. A narrower CRC is in the top bits of the register.
// If the output is reflected, mirroring the register moves the CRC down to bit 0.
std::uint64_t compute(const Crc& crc, std::span<const std::uint8_t> bytes) {
  const unsigned shift = Crc::widest - crc.width;
  boost::crc_basic<Crc::widest> top(crc.polynomial << shift, crc.start << shift, 0, crc.input_reflected,
                                    crc.output_reflected);
  top.process_bytes(bytes.data(), bytes.size());
  return (crc.output_reflected ? top.checksum() : top.checksum() >> shift) ^ crc.final_xor;
}

}  // namespace canhil::protection
