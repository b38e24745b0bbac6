// Settings for published protection profiles, namely AUTOSAR's end-to-end profiles (AUTOSAR FO PRS
// E2EProtocol, R23-11).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "dbc/protection/settings.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::protection {

/// Those parameters of a profile that depend on the message. If `checksum`, `counter` or `data_id_nibble` has
/// a value, this place is used instead of the profile's default.
struct ProfileChoice {
  std::uint32_t data_id = 0;
  std::vector<std::uint8_t> data_id_list;  ///< 16 entries; only for profiles 2 and 22
  unsigned offset_bits = 0;                ///< offset of all fields of the profile; a multiple of 8
  std::optional<Place> checksum;
  std::optional<Place> counter;
  std::optional<Place> data_id_nibble;  ///< only for variants 1C and 11C
};

/// The names that profile() accepts, such as "autosar-e2e-11c".
std::span<const std::string_view> profile_names();

/// The settings of a profile for a message of `size` bytes. Returns an error of one line if the name is
/// unknown, or if the profile does not allow the data id, the data id list or the offset. Protection::make()
/// checks whether the fields fit the message.
Result<Settings> profile(std::string_view name, const ProfileChoice& choice, unsigned size);

}  // namespace canhil::protection
