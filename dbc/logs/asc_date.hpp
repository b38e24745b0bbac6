// The date in the header of an ASC log, in local time. Tools write it in the language of their Windows:
//     Tue Nov 24 08:12:13.500 2026        Tue Nov 24 08:12:13.500 pm 2026
//     Fre Okt 12 11:21:07 2007            mar. 24 nov. 08:12:13 2026
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace canhil::logs {

/// Converts a date, as its words, to ns since 1970. Names of months in English, German, French, Italian,
/// Spanish and Portuguese are known, and numbers such as 24.11.2026. Nullopt: the date is not understood, or
/// there is no such date.
std::optional<std::int64_t> date_of(std::span<const std::string_view> words);

}  // namespace canhil::logs
