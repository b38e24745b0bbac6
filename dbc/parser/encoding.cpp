#include "dbc/parser/encoding.hpp"

#include <fmt/format.h>
#include <iconv.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <optional>

namespace canhil::dbc {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF", replacement = "\xEF\xBF\xBD";

/// A conversion to UTF-8 by iconv.
class Converter {
 public:
  explicit Converter(const std::string& from) : handle_(iconv_open("UTF-8", from.c_str())) {}
  Converter(const Converter&) = delete;
  Converter& operator=(const Converter&) = delete;
  ~Converter() {
    if (is_open()) iconv_close(handle_);
  }
  [[nodiscard]] bool is_open() const {
    return handle_ != iconv_t(-1);  // NOLINT(performance-no-int-to-ptr): this is how iconv_open() fails
  }

  /// Converts as many bytes of `text` as possible, removes them from `text`, and appends their characters to
  /// `out`. True: `text` is empty now; false: it begins with bytes that are no character.
  bool convert(std::string_view& text, std::string& out) {
    char* in = const_cast<char*>(text.data());  // iconv does not write there
    std::size_t left = text.size();
    std::array<char, 1 << 14> part;
    std::size_t result = 0;
    do {
      char* next = part.data();
      std::size_t room = part.size();
      result = iconv(handle_, left > 0 ? &in : nullptr, &left, &next, &room);
      out.append(part.data(), next);
    } while (result == static_cast<std::size_t>(-1) && errno == E2BIG);
    text.remove_prefix(text.size() - left);
    return left == 0;
  }

 private:
  iconv_t handle_;
};

Position end_of(std::string_view utf8) {
  const std::size_t line_begin = utf8.rfind('\n') + 1;  // npos + 1 is 0
  const auto begins_character = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };
  return {1 + static_cast<int>(std::ranges::count(utf8, '\n')),
          1 + static_cast<int>(std::ranges::count_if(utf8.substr(line_begin), begins_character))};
}

struct Converted {
  std::string text;
  std::optional<Position> first_replaced;  ///< position of the first bytes that are no character
};

Converted converted(std::string_view text, const std::string& encoding) {
  Converter converter(encoding);
  Converted result;
  if (!converter.is_open()) return {{}, Position{}};
  while (!text.empty() && !converter.convert(text, result.text)) {
    if (!result.first_replaced) result.first_replaced = end_of(result.text);
    result.text += replacement;
    text.remove_prefix(1);
  }
  converter.convert(text, result.text);  // some encodings keep a character until the end of the text is known
  if (result.text.starts_with(byte_order_mark)) result.text.erase(0, byte_order_mark.size());
  return result;
}

}  // namespace

bool is_encoding(const std::string& name) {
  // iconv reads what follows a '/' as an option of the conversion.
  return !name.empty() && name.find('/') == std::string::npos && Converter(name).is_open();
}

std::string to_utf8(std::string_view text, const std::string& encoding, Findings& findings) {
  const bool is_utf16 = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
  const std::string assumed = !encoding.empty() ? encoding : is_utf16 ? "UTF-16" : "UTF-8";
  Converted result = converted(text, assumed);
  if (!result.first_replaced) return std::move(result.text);
  if (!encoding.empty() || is_utf16) {
    findings.add(Rule::text_encoding, *result.first_replaced,
                 fmt::format("bytes that are no character of {}, expected a text in this encoding", assumed));
    return std::move(result.text);
  }
  Converted windows = converted(text, "CP1252");
  if (windows.first_replaced) {
    findings.add(
        Rule::text_encoding, *windows.first_replaced,
        "the text is neither UTF-8 nor Windows-1252, expected one of them, or the option --encoding");
  } else {
    findings.add(Rule::windows_1252, *result.first_replaced, "the text is not UTF-8, expected UTF-8");
  }
  return std::move(windows.text);
}

std::string with_two_byte_characters(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (i > 0 && static_cast<unsigned char>(text[i - 1]) > 0x7F && text.substr(i).starts_with("\\\""))
      result += '\\';
    result += text[i];
  }
  return result;
}

}  // namespace canhil::dbc
