// Text that goes into HTML and XML.
#pragma once

#include <string>
#include <string_view>

namespace canhil::report {

/// UTF-8 text for an element or a quoted attribute. Control characters, most of which XML forbids, become
/// blanks.
inline std::string escaped(std::string_view plain) {
  std::string safe;
  for (const char c : plain) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return safe;
}

}  // namespace canhil::report
