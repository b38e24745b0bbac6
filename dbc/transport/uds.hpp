// Negative responses of diagnostics (UDS, ISO 14229-1): 0x7F, the service, a code.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace canhil::transport {

/// The code of the negative response to a request; none: the answer is no such response.
std::optional<std::uint8_t> negative_code(std::span<const std::uint8_t> request,
                                          std::span<const std::uint8_t> answer);

/// The code for "request correctly received, response pending": the answer comes later.
inline constexpr std::uint8_t response_pending = 0x78;

/// The name of a code (table A.1); empty: it has none here.
std::string_view name_of_negative_code(std::uint8_t code);

}  // namespace canhil::transport
