// Converts names of the DBC to C++ names, and determines the C++ types of signals.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// Converts the text to a C++ identifier: "fault (hot)" -> fault_hot, "3" -> _3, "class" -> class_.
std::string identifier(std::string_view text);

/// The name of the struct of a message: the name of the message. If the header uses this name for something
/// else, "_" is appended.
std::string type_name(const Message& message);

/// The name of the struct member of a signal: the name of the signal. If the struct uses this name for
/// something else, "_" is appended.
std::string member_name(const Message& message, const Signal& signal);

struct EnumType {
  std::string name;
  std::string underlying;  ///< integer type, such as std::uint8_t
  std::vector<ValueName> values;
  std::vector<std::string> identifiers;  ///< the C++ names of the values, each unique
};

/// The enumeration types of a database. If the named values of a signal equal a value table, the signal has
/// the type of this table, which other signals may share. Any other signal with named values has a type of
/// its own. Signals with a scale or an offset, and the E2E counter and CRC, have no enumeration type.
class Enums {
 public:
  explicit Enums(const Database& database);
  [[nodiscard]] const std::vector<EnumType>& all() const { return types_; }
  /// The name of the enumeration type of a signal; empty: the signal has no enumeration type.
  [[nodiscard]] std::string_view name_of(const Message& message, const Signal& signal) const;

 private:
  std::vector<EnumType> types_;
  std::map<std::string, std::size_t> of_signal_;  ///< "Message.signal" -> index in types_
};

/// True if the physical value equals the raw value: the scale is 1 and the offset is 0.
bool is_plain(const Signal& signal);
/// The name of the smallest integer type with at least `bits` bits: std::intN_t or std::uintN_t.
std::string integer_type(unsigned bits, bool is_signed);
/// The type of the struct member of a signal. An enumeration has the prefix "types::", because a member may
/// have the same name as its type.
std::string member_type(const Enums& enums, const Message& message, const Signal& signal);
/// True for the E2E counter and the E2E CRC: the struct has no members for them.
bool is_protection(const Message& message, const Signal& signal);
/// The signals for which the struct of the message has members, in the order of the DBC.
std::vector<const Signal*> members_of(const Message& message);
/// A C++ literal that has exactly the value `value`.
std::string literal(double value);
std::string in_quotes(std::string_view text);

}  // namespace canhil::dbc
