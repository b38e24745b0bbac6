#include "dbc/protection/profiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace canhil::protection {
namespace {

/// The way in which a profile includes the data id in the checksum.
enum class DataId : std::uint8_t { both, alternating, low, nibble, list };

/// A field of `bytes` whole bytes. `byte` counts from the first byte of the profile's header.
Place bytes_at(const ProfileChoice& choice, unsigned byte, unsigned bytes, bool big_endian) {
  return {.start_bit = choice.offset_bits + 8 * byte + (big_endian ? 7 : 0),
          .length = 8 * bytes,
          .big_endian = big_endian};
}

Place nibble_at(const ProfileChoice& choice, unsigned bit) {
  return {.start_bit = choice.offset_bits + bit, .length = 4, .big_endian = false};
}

Crc known(std::string_view name) { return published_crc(name).value(); }

// Settings for the profiles 1, 2, 11 and 22: the CRC is in byte 0, the counter is in the low nibble of byte
// 1. The CRC of profiles 1 and 11 has the polynomial of CRC-8/SAE-J1850, but starts with 0 and has no final
// xor.
Settings short_header(const ProfileChoice& choice, DataId mode) {
  const AddedByte low{Source::data_id, 0, 0};
  const AddedByte high{Source::data_id, 0, 1};
  const AddedByte zero{Source::constant, 0, 0};
  Settings settings;
  settings.data_id = choice.data_id;
  settings.data_id_list = choice.data_id_list;
  settings.counter = Counter{.place = choice.counter.value_or(nibble_at(choice, 8)),
                             .modulo = mode == DataId::list ? 16U : 15U,
                             .skipped = {},
                             .shared_as = {}};
  Checksum checksum;
  checksum.place = choice.checksum.value_or(bytes_at(choice, 0, 1, false));
  checksum.rule = known(mode == DataId::list ? "CRC-8/AUTOSAR" : "CRC-8/GSM-A");
  switch (mode) {
    case DataId::both:
      checksum.before = {low, high};
      break;
    case DataId::alternating:
      checksum.before = {{Source::data_id_alternating, 0, 0}};
      break;
    case DataId::low:
      checksum.before = {low};
      break;
    case DataId::nibble:
      checksum.before = {low, zero};
      settings.constants = {
          {choice.data_id_nibble.value_or(nibble_at(choice, 12)), (choice.data_id >> 8U) & 0x0FU}};
      break;
    case DataId::list:
      checksum.after = {{Source::data_id_of_counter, 0, 0}};
      break;
  }
  settings.checksum = std::move(checksum);
  return settings;
}

/// The header of a profile whose fields are whole bytes. A field is given by its first byte and its number of
/// bytes. A field with 0 bytes is not sent.
struct Header {
  struct Field {
    unsigned byte = 0;
    unsigned bytes = 0;
  };
  std::string_view crc;
  bool big_endian = true;
  Field checksum;
  Field counter;
  Field length;
  Field data_id;
  std::vector<AddedByte> after;
};

Settings long_header(const ProfileChoice& choice, const Header& header, unsigned size) {
  const auto place = [&](const Header::Field& field) {
    return bytes_at(choice, field.byte, field.bytes, header.big_endian);
  };
  Settings settings;
  settings.data_id = choice.data_id;
  settings.counter = Counter{
      .place = choice.counter.value_or(place(header.counter)), .modulo = 0, .skipped = {}, .shared_as = {}};
  Checksum checksum;
  checksum.place = choice.checksum.value_or(place(header.checksum));
  checksum.rule = known(header.crc);
  checksum.after = header.after;
  settings.checksum = std::move(checksum);
  if (header.length.bytes != 0) settings.constants.push_back(Constant{place(header.length), size});
  if (header.data_id.bytes != 0)
    settings.constants.push_back(Constant{place(header.data_id), choice.data_id});
  return settings;
}

Settings profile_1a(const ProfileChoice& choice, unsigned) { return short_header(choice, DataId::both); }
Settings profile_1b(const ProfileChoice& choice, unsigned) {
  return short_header(choice, DataId::alternating);
}
Settings profile_1c(const ProfileChoice& choice, unsigned) { return short_header(choice, DataId::nibble); }
Settings profile_1_low(const ProfileChoice& choice, unsigned) { return short_header(choice, DataId::low); }
Settings profile_2(const ProfileChoice& choice, unsigned) { return short_header(choice, DataId::list); }
Settings profile_4(const ProfileChoice& choice, unsigned size) {
  return long_header(choice, {"CRC-32/AUTOSAR", true, {8, 4}, {2, 2}, {0, 2}, {4, 4}, {}}, size);
}
Settings profile_5(const ProfileChoice& choice, unsigned size) {
  return long_header(
      choice,
      {"CRC-16/IBM-3740", false, {0, 2}, {2, 1}, {}, {}, {{Source::data_id, 0, 0}, {Source::data_id, 0, 1}}},
      size);
}
Settings profile_6(const ProfileChoice& choice, unsigned size) {
  return long_header(choice,
                     {"CRC-16/IBM-3740",
                      true,
                      {0, 2},
                      {4, 1},
                      {2, 2},
                      {},
                      {{Source::data_id, 0, 1}, {Source::data_id, 0, 0}}},
                     size);
}
Settings profile_7(const ProfileChoice& choice, unsigned size) {
  return long_header(choice, {"CRC-64/XZ", true, {0, 8}, {12, 4}, {8, 4}, {16, 4}, {}}, size);
}

struct Profile {
  std::string_view name;
  Settings (*settings)(const ProfileChoice&, unsigned size);
  unsigned data_id_bits = 0;  ///< length of the data id; 0: the profile uses a data id list
  bool nibble = false;
};

constexpr std::array profiles{
    Profile{"autosar-e2e-1a", profile_1a, 16, false}, Profile{"autosar-e2e-1b", profile_1b, 16, false},
    Profile{"autosar-e2e-1c", profile_1c, 12, true},  Profile{"autosar-e2e-1-low", profile_1_low, 16, false},
    Profile{"autosar-e2e-2", profile_2, 0, false},    Profile{"autosar-e2e-4", profile_4, 32, false},
    Profile{"autosar-e2e-5", profile_5, 16, false},   Profile{"autosar-e2e-6", profile_6, 16, false},
    Profile{"autosar-e2e-7", profile_7, 32, false},   Profile{"autosar-e2e-11a", profile_1a, 16, false},
    Profile{"autosar-e2e-11c", profile_1c, 12, true}, Profile{"autosar-e2e-22", profile_2, 0, false},
};

constexpr auto names = [] {
  std::array<std::string_view, profiles.size()> all;
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = profiles[i].name;
  return all;
}();

}  // namespace

std::span<const std::string_view> profile_names() { return names; }

Result<Settings> profile(std::string_view name, const ProfileChoice& choice, unsigned size) {
  const auto found = std::ranges::find(profiles, name, &Profile::name);
  if (found == profiles.end())
    return failure(fmt::format("profile '{}', expected one of {}", name, fmt::join(names, ", ")));
  const auto wrong = [&](std::string text) { return failure(fmt::format("profile {}: {}", name, text)); };
  if (choice.offset_bits % 8 != 0 || choice.offset_bits >= 8 * Frame::max_size)
    return wrong(fmt::format("offset_bits {}, expected whole bytes, less than {}", choice.offset_bits,
                             8 * Frame::max_size));
  if (choice.data_id_nibble && !found->nibble)
    return wrong("a place for the data id's nibble, expected none: only variants 1c and 11c have one");
  if (found->data_id_bits == 0 && choice.data_id != 0)
    return wrong(fmt::format("data_id 0x{:X}, expected data_id_list in its place", choice.data_id));
  if (found->data_id_bits == 0 && choice.data_id_list.size() != 16)
    return wrong(fmt::format("data_id_list has {} entries, expected 16", choice.data_id_list.size()));
  if (found->data_id_bits != 0 && !choice.data_id_list.empty())
    return wrong("data_id_list, expected data_id in its place");
  if (found->data_id_bits != 0 && (std::uint64_t{choice.data_id} >> found->data_id_bits) != 0)
    return wrong(fmt::format("data_id 0x{:X}, expected at most 0x{:X}", choice.data_id,
                             (std::uint64_t{1} << found->data_id_bits) - 1));
  return found->settings(choice, size);
}

}  // namespace canhil::protection
