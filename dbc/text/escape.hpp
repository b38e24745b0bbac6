// Escapes text that comes from outside (titles, DBC files, reports, names on a bus), once for each medium.
// Without it, such text could control the terminal, reorder a line, break an XML file or start a formula.
//
// In every medium, these characters become visible escapes such as \x1b, \u202e or \xff:
//   control characters   C0 and C1 (U+0000 to U+001F, U+007F to U+009F)
//   invisible characters marks of direction (U+061C, U+200E ..., U+2066 ...), zero width, tags
//   line separators      U+2028, U+2029
//   what XML forbids     U+FFFE, U+FFFF and other noncharacters
//   bytes that are not UTF-8
#pragma once

#include <string>
#include <string_view>

namespace canhil {

/// Text of several lines for a terminal: line ends and tabs stay.
std::string for_terminal(std::string_view text);

/// A field for one line of a terminal, such as a title or a name: line ends and tabs are escaped too.
std::string one_line(std::string_view field);

/// Text for an element or a quoted attribute of HTML or XML: the characters & < > " become entities, line
/// ends and tabs become blanks.
std::string for_markup(std::string_view text);

/// A text cell of a CSV table (RFC 4180): in quotes if it contains a separator. A cell that a spreadsheet
/// would take for a formula, because it begins with = + - or @, begins with an apostrophe.
std::string for_csv(std::string_view cell);

}  // namespace canhil
