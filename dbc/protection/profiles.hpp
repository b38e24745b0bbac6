// Published protection profiles as settings: AUTOSAR's end-to-end profiles (AUTOSAR FO PRS E2EProtocol,
// R23-11).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "dbc/protection/settings.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::protection {

/// The parameters of a profile that depend on the message. A place given here replaces the profile's default.
struct ProfileChoice {
  std::uint32_t data_id = 0;
  std::vector<std::uint8_t> data_id_list;  ///< 16 entries, profiles 2 and 22 only
  unsigned offset_bits = 0;                ///< of all the profile's fields; whole bytes
  std::optional<Place> checksum;
  std::optional<Place> counter;
  std::optional<Place> data_id_nibble;  ///< variants 1C and 11C only
};

/// The names that profile() accepts, such as "autosar-e2e-11c".
std::span<const std::string_view> profile_names();

/// Settings of a profile for a message of `size` bytes. Error: one line for an unknown name, or for a data
/// id, list or offset that the profile does not allow. Protection::make() checks that the fields fit the
/// message.
Result<Settings> profile(std::string_view name, const ProfileChoice& choice, unsigned size);

}  // namespace canhil::protection
