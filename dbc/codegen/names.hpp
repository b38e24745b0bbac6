// Names of the DBC as C++ names, and the C++ types of signals.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// A C++ identifier close to the text: "fault (hot)" -> fault_hot, "3" -> _3, "class" -> class_.
std::string identifier(std::string_view text);

/// The name of a message's struct: the message's name, with "_" appended if the header uses that name
/// already.
std::string type_name(const Message& message);

/// The name of a signal's member: the signal's name, with "_" appended if the struct uses that name already.
std::string member_name(const Message& message, const Signal& signal);

struct EnumType {
  std::string name;
  std::string underlying;  ///< std::uint8_t ...
  std::vector<ValueName> values;
  std::vector<std::string> identifiers;  ///< of the values, unique
};

/// The enumeration types. All signals whose named values equal a value table share the type of that table.
/// Each other signal with named values has a type of its own. Signals with a scale or an offset, and the E2E
/// counter and CRC, have none.
class Enums {
 public:
  explicit Enums(const Database& database);
  [[nodiscard]] const std::vector<EnumType>& all() const { return types_; }
  /// Name of the signal's enumeration type; empty: the signal has none.
  [[nodiscard]] std::string_view name_of(const Message& message, const Signal& signal) const;

 private:
  std::vector<EnumType> types_;
  std::map<std::string, std::size_t> of_signal_;  ///< "Message.signal" -> index
};

/// True if raw and physical values are equal: scale 1, offset 0.
bool is_plain(const Signal& signal);
/// The smallest std::intN_t or std::uintN_t of at least this many bits.
std::string integer_type(unsigned bits, bool is_signed);
/// The type of the signal's member. Enumerations get the prefix "types::": a member may have its type's name.
std::string member_type(const Enums& enums, const Message& message, const Signal& signal);
/// True for the E2E counter and CRC, which are not members.
bool is_protection(const Message& message, const Signal& signal);
/// The message's signals that are members, in the order of the DBC.
std::vector<const Signal*> members_of(const Message& message);
/// A literal with exactly this value.
std::string literal(double value);
std::string in_quotes(std::string_view text);

}  // namespace canhil::dbc
