#include "dbc/codegen/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace canhil::dbc {
namespace {

constexpr std::array keywords{
    "alignas",     "alignof",  "and",        "and_eq",    "asm",       "auto",         "bitand",
    "bitor",       "bool",     "break",      "case",      "catch",     "char",         "char16_t",
    "char32_t",    "char8_t",  "class",      "co_await",  "co_return", "co_yield",     "compl",
    "concept",     "const",    "const_cast", "consteval", "constexpr", "constinit",    "continue",
    "decltype",    "default",  "delete",     "do",        "double",    "dynamic_cast", "else",
    "enum",        "explicit", "export",     "extern",    "false",     "float",        "for",
    "friend",      "goto",     "if",         "inline",    "int",       "long",         "mutable",
    "namespace",   "new",      "noexcept",   "not",       "not_eq",    "nullptr",      "operator",
    "or",          "or_eq",    "private",    "protected", "public",    "register",     "reinterpret_cast",
    "requires",    "return",   "short",      "signed",    "sizeof",    "static",       "static_assert",
    "static_cast", "struct",   "switch",     "template",  "this",      "thread_local", "throw",
    "true",        "try",      "typedef",    "typeid",    "typename",  "union",        "unsigned",
    "using",       "virtual",  "void",       "volatile",  "wchar_t",   "while",        "xor",
    "xor_eq",      "std",      "canhil",     "wire",      "linux",     "unix"};

constexpr std::array<std::string_view, 13> names_of_header{
    "all_messages", "AllMessages",  "dbc_hash",  "exchange_hash24", "detail",
    "enumerators",  "find_message", "from_name", "name_of",         "types",
    "wire",         "MessageInfo",  "SignalInfo"};

bool is_plain_letter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
}

std::vector<std::string> unique_identifiers(const std::vector<ValueName>& values) {
  std::vector<std::string> names;
  for (const ValueName& value : values) {
    std::string name = identifier(value.name);
    if (std::ranges::find(names, name) != names.end()) {
      name += value.value < 0 ? fmt::format("_minus_{}", -value.value) : fmt::format("_{}", value.value);
    }
    names.push_back(std::move(name));
  }
  return names;
}

std::vector<ValueName> sorted(std::vector<ValueName> values) {
  std::ranges::sort(values, {}, &ValueName::value);
  return values;
}

/// Describes the signals that share an enumeration type: the length [bits] of the longest unsigned signal and
/// the length of the longest signed signal. The type must be able to represent the raw values of both
/// signals.
struct Width {
  unsigned of_unsigned = 0;
  unsigned of_signed = 0;
};

void widen(Width& width, const Signal& signal) {
  unsigned& bits = signal.is_signed() ? width.of_signed : width.of_unsigned;
  bits = std::max(bits, signal.length);
}

std::string type_of(Width width) {
  if (width.of_signed == 0) return integer_type(width.of_unsigned, false);
  const unsigned with_sign = width.of_unsigned == 0 ? 0 : width.of_unsigned + 1;
  return integer_type(std::max(width.of_signed, with_sign), true);
}

}  // namespace

std::string identifier(std::string_view text) {
  std::string name;
  for (const char c : text) {
    if (is_plain_letter(c)) {
      name += c;
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  while (name.size() > 1 && name.back() == '_' && !text.ends_with('_')) name.pop_back();
  if (name.empty()) name = "value";
  if (name[0] >= '0' && name[0] <= '9') name.insert(0, "_");
  if (std::ranges::find(keywords, name) != keywords.end()) name += '_';
  return name;
}

std::string type_name(const Message& message) {
  std::string name = identifier(message.name);
  if (std::ranges::find(names_of_header, name) != names_of_header.end()) name += '_';
  return name;
}

std::string member_name(const Message& message, const Signal& signal) {
  constexpr std::array<std::string_view, 7> taken{"size", "info",   "signals", "scaled",
                                                  "pack", "unpack", "visit"};
  std::string name = identifier(signal.name);
  if (std::ranges::find(taken, name) != taken.end() || name == type_name(message)) name += '_';
  return name;
}

Enums::Enums(const Database& database) {
  std::set<std::string> names(names_of_header.begin(), names_of_header.end());
  for (const Message& message : database.messages) names.insert(type_name(message));
  const auto free_name = [&names](std::string name) {
    while (!names.insert(name).second) name += '_';
    return name;
  };
  std::map<std::string, std::size_t> of_table;
  std::map<std::size_t, Width> widths;
  for (const Message& message : database.messages) {
    for (const Signal& signal : message.signals) {
      if (signal.values.empty() || is_protection(message, signal) || !is_plain(signal)) continue;
      const auto values = sorted(signal.values);
      const auto table = std::ranges::find_if(
          database.value_tables, [&](const ValueTable& t) { return sorted(t.values) == values; });
      const bool shared = table != database.value_tables.end();
      std::size_t index = types_.size();
      if (shared && of_table.contains(table->name)) {
        index = of_table[table->name];
      } else {
        const std::string name =
            shared ? identifier(table->name) : identifier(message.name + "_" + signal.name);
        types_.push_back({free_name(name), {}, values, unique_identifiers(values)});
        if (shared) of_table[table->name] = index;
      }
      of_signal_[message.name + "." + signal.name] = index;
      widen(widths[index], signal);
    }
  }
  for (std::size_t i = 0; i < types_.size(); ++i) types_[i].underlying = type_of(widths[i]);
}

std::string_view Enums::name_of(const Message& message, const Signal& signal) const {
  const auto found = of_signal_.find(message.name + "." + signal.name);
  return found == of_signal_.end() ? std::string_view{} : types_[found->second].name;
}

bool is_plain(const Signal& signal) { return signal.scale == 1 && signal.offset == 0; }

std::string integer_type(unsigned bits, bool is_signed) {
  const unsigned width = bits <= 8 ? 8 : bits <= 16 ? 16 : bits <= 32 ? 32 : 64;
  return fmt::format("std::{}int{}_t", is_signed ? "" : "u", width);
}

std::string member_type(const Enums& enums, const Message& message, const Signal& signal) {
  if (const auto name = enums.name_of(message, signal); !name.empty()) return fmt::format("types::{}", name);
  if (!is_plain(signal) || signal.type == RawType::float64) return "double";
  if (signal.type == RawType::float32) return "float";
  return integer_type(signal.length, signal.is_signed());
}

bool is_protection(const Message& message, const Signal& signal) {
  return message.e2e_data_id != 0 && (signal.name == "e2e_crc" || signal.name == "e2e_counter");
}

std::vector<const Signal*> members_of(const Message& message) {
  std::vector<const Signal*> members;
  for (const Signal& signal : message.signals) {
    if (!is_protection(message, signal)) members.push_back(&signal);
  }
  return members;
}

std::string literal(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '\n') {
      out += "\\n";
    } else {
      if (c == '"' || c == '\\') out += '\\';
      out += c;
    }
  }
  return out + '"';
}

}  // namespace canhil::dbc
