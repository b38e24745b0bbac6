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

/// What a profile leaves to the message. A place that is given replaces the profile's own.
struct ProfileChoice {
  std::uint32_t data_id = 0;
  std::vector<std::uint8_t> data_id_list;  ///< 16 entries, profiles 2 and 22 only
  unsigned offset_bits = 0;                ///< moves all of the profile's fields; whole bytes
  std::optional<Place> checksum;
  std::optional<Place> counter;
  std::optional<Place> data_id_nibble;  ///< variants 1C and 11C only
};

/// The names that profile() knows, as "autosar-e2e-11c".
std::span<const std::string_view> profile_names();

/// Settings of a profile for a message of `size` bytes. An error in one line for an unknown name, or for a
/// data id, a list or an offset that the profile cannot have; whether its fields fit the message says
/// Protection::make().
Result<Settings> profile(std::string_view name, const ProfileChoice& choice, unsigned size);

}  // namespace canhil::protection
