// Names of the DBC as C++ names, and the C++ types of signals.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// A C++ identifier as close to the text as can be: "fault (hot)" -> fault_hot, "3" -> _3, "class" -> class_.
std::string identifier(std::string_view text);

/// The struct of a message: its name, with "_" behind it where the header has that name already.
std::string type_name(const Message& message);

/// The member of a signal: its name, with "_" behind it where the struct has that name already.
std::string member_name(const Message& message, const Signal& signal);

struct EnumType {
  std::string name;
  std::string underlying;  ///< std::uint8_t ...
  std::vector<ValueName> values;
  std::vector<std::string> identifiers;  ///< of the values, unique
};

/// One type per set of named values: signals whose values equal a value table's share the table's type.
class Enums {
 public:
  explicit Enums(const Database& database);
  [[nodiscard]] const std::vector<EnumType>& all() const { return types_; }
  /// Name of the signal's type; empty: the signal has no named values.
  [[nodiscard]] std::string_view name_of(const Message& message, const Signal& signal) const;

 private:
  std::vector<EnumType> types_;
  std::map<std::string, std::size_t> of_signal_;  ///< "Message.signal" -> index
};

/// True if raw values are the values: scale 1, offset 0.
bool is_plain(const Signal& signal);
/// The smallest std::intN_t or std::uintN_t of at least this many bits.
std::string integer_type(unsigned bits, bool is_signed);
/// The type of the signal's member. Enumerations with "types::" in front: members may be named as their type.
std::string member_type(const Enums& enums, const Message& message, const Signal& signal);
/// True if the signal is E2E's own and so no member.
bool is_protection(const Message& message, const Signal& signal);
/// The message's signals that are members, in the order of the DBC.
std::vector<const Signal*> members_of(const Message& message);
/// A literal of exactly this value.
std::string literal(double value);
std::string in_quotes(std::string_view text);

}  // namespace canhil::dbc
