// Converts the text of a DBC to UTF-8. A DBC does not state its encoding. This header is internal to the
// parser, except for is_encoding().
#pragma once

#include <string>
#include <string_view>

#include "dbc/parser/finding.hpp"

namespace canhil::dbc {

/// Whether iconv can convert from the encoding with this name, such as "shift_jis".
bool is_encoding(const std::string& name);

/// Returns the text as UTF-8, without a byte order mark. With an empty `encoding`, reads UTF-16 if the text
/// begins with its byte order mark, else UTF-8, and a text that is not UTF-8 as Windows-1252. Bytes that are
/// no character become U+FFFD. Adds a finding if the text is not UTF-8 or has such bytes. `encoding` must be
/// empty, or a name that is_encoding() accepts.
std::string to_utf8(std::string_view text, const std::string& encoding, Findings& findings);

/// Returns a text that is not UTF-8 with a backslash before each backslash that follows a byte above 0x7F and
/// precedes a quote. In Shift-JIS, GBK and Big5, such a backslash is the second half of a character and does
/// not escape the quote.
std::string with_two_byte_characters(std::string_view text);

}  // namespace canhil::dbc
