// The content of a DBC file, resolved and checked. parse() fills it in; the codec and dbcgen read it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace canhil::dbc {

/// A position in the text. Lines and columns count from 1; columns count characters.
struct Position {
  int line = 1;
  int column = 1;
};

/// INT and HEX: int64; FLOAT: double; STRING and ENUM (its label): string.
using AttributeValue = std::variant<std::int64_t, double, std::string>;
using Attributes = std::map<std::string, AttributeValue, std::less<>>;

/// The kinds of objects that have attributes. The last three are relations between a node and another object.
enum class Owner : std::uint8_t {
  network,
  node,
  message,
  signal,
  variable,
  node_message,
  node_signal,
  node_variable
};

/// The type of an attribute: INT, HEX, FLOAT, STRING, ENUM.
enum class AttributeType : std::uint8_t { integer, hexadecimal, real, text, enumeration };

/// A definition of an attribute (BA_DEF_), with its default (BA_DEF_DEF_).
struct AttributeDefinition {
  std::string name;
  Owner owner = Owner::network;
  AttributeType type = AttributeType::integer;
  double minimum = 0;  ///< minimum and maximum both 0: no limits
  double maximum = 0;
  std::vector<std::string> labels;  ///< of an enumeration
  std::optional<AttributeValue> initial;
};

/// The name of one raw value.
struct ValueName {
  std::int64_t value = 0;
  std::string name;
  friend bool operator==(const ValueName&, const ValueName&) = default;
};

/// Names of raw values, in the order of the text.
struct ValueTable {
  std::string name;
  std::vector<ValueName> values;
};

/// A node of the bus (BU_).
struct Node {
  std::string name;
  std::string comment;
  Attributes attributes;
};

/// The order of a signal's bytes: Intel or Motorola.
enum class ByteOrder : std::uint8_t { little_endian, big_endian };
/// The type of a raw value.
enum class RawType : std::uint8_t { unsigned_integer, signed_integer, float32, float64 };

/// Raw values of a multiplexor, both ends included.
struct MuxRange {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
  friend bool operator==(const MuxRange&, const MuxRange&) = default;
};

/// physical = raw * scale + offset.
struct Signal {
  std::string name;
  std::string unit;
  std::string comment;
  unsigned start_bit = 0;  ///< DBC position of the least (Intel) or most (Motorola) significant bit
  unsigned length = 0;     ///< bits, 1..64
  ByteOrder byte_order = ByteOrder::little_endian;
  RawType type = RawType::unsigned_integer;
  double scale = 1;
  double offset = 0;
  double minimum = 0;  ///< minimum and maximum both 0: limited only by the raw value
  double maximum = 0;
  std::vector<std::string> receivers;
  std::vector<ValueName> values;
  bool multiplexor = false;
  std::string multiplexed_by;        ///< name of the multiplexor; empty: always present
  std::vector<MuxRange> mux_ranges;  ///< present if the multiplexor's raw value is in one of these
  Attributes attributes;
  Position at;

  /// From the attributes SensorSigma and CarriesRemainder.
  double sensor_sigma = 0;
  bool carries_remainder = false;

  /// True for two's complement integers.
  [[nodiscard]] bool is_signed() const { return type == RawType::signed_integer; }
  /// True for IEEE 754 numbers.
  [[nodiscard]] bool is_float() const { return type == RawType::float32 || type == RawType::float64; }
};

/// A group of signals of one message (SIG_GROUP_).
struct SignalGroup {
  std::string name;
  int repetitions = 1;
  std::vector<std::string> signals;
};

/// A message (BO_) with its signals.
struct Message {
  std::string name;
  std::uint32_t id = 0;  ///< without the flag of the extended format
  bool extended = false;
  unsigned size = 0;   ///< bytes
  std::string sender;  ///< empty: none (Vector__XXX)
  std::vector<std::string> further_senders;
  std::string comment;
  std::vector<Signal> signals;
  std::vector<SignalGroup> groups;
  Attributes attributes;
  Position at;

  /// From the attributes VFrameFormat, GenMsgCycleTime, E2eDataId, SampleGroup and Answers.
  bool fd = false;
  std::int64_t cycle_time_us = 0;
  std::uint16_t e2e_data_id = 0;
  std::string sample_group;
  std::vector<std::string> answers;  ///< sample groups, separated by spaces in the text
};

/// An environment variable (EV_).
struct EnvironmentVariable {
  std::string name;
  std::string unit;
  std::string comment;
  int type = 0;  ///< 0 integer, 1 float, 2 string
  double minimum = 0;
  double maximum = 0;
  double initial = 0;
  unsigned data_size = 0;  ///< ENVVAR_DATA_; 0: not a data variable
  std::vector<std::string> nodes;
  std::vector<ValueName> values;
  Attributes attributes;
};

/// An attribute of a node together with a message, a signal or an environment variable.
struct RelationAttribute {
  std::string attribute;
  Owner owner = Owner::node_message;
  std::string node;
  std::uint32_t message_id = 0;  ///< as in the text: bit 31 marks an extended id
  std::string target;            ///< signal or variable
  AttributeValue value;
};

/// All that a DBC file says.
struct Database {
  std::string version;
  std::string comment;
  std::vector<Node> nodes;
  std::vector<Message> messages;  ///< in the order of the text
  std::vector<ValueTable> value_tables;
  std::vector<EnvironmentVariable> variables;
  std::vector<AttributeDefinition> definitions;
  Attributes attributes;
  std::vector<RelationAttribute> relations;
  std::uint64_t hash = 0;  ///< of the text, see hash()
};

/// The message with this id, or none.
const Message* find_message(const Database& database, std::uint32_t id, bool extended = false);
/// The message with this name, or none.
const Message* find_message(const Database& database, std::string_view name);
/// The signal with this name, or none.
const Signal* find_signal(const Message& message, std::string_view name);
/// The value that `attributes` (those of an object) give to an attribute; otherwise the default of its
/// definition; none if there is no default.
const AttributeValue* find_attribute(const Database& database, const Attributes& attributes, Owner owner,
                                     std::string_view name);

/// True for a valid time in an attribute of a message: 0 (none), or 1 us to 1e9 ms. Negative or tiny times
/// would be mistaken for none; larger ones overflow in nanoseconds.
bool is_message_time_ms(double ms);
/// The range of is_message_time_ms(), for messages.
inline constexpr std::string_view message_time_range = "0 (none) or 0.001..1e9";

/// True if no frame can hold both signals: both depend on one multiplexor, and no value of it selects both.
bool mutually_exclusive(const Message& message, const Signal& a, const Signal& b);

/// The raw values that an integer signal can take: those that fit its bits and lie inside [minimum, maximum].
/// For an unsigned signal, `lowest` and `highest` hold the bits of a std::uint64_t.
struct RawRange {
  std::int64_t lowest = 0;
  std::int64_t highest = 0;
};
/// The raw range of an integer signal; none: no raw value lies inside [minimum, maximum].
std::optional<RawRange> raw_range(const Signal& signal);

/// Whether a signal can carry a physical value. For an integer signal, up to one step outside
/// its range is accepted.
bool holds(const Signal& signal, double value);

/// The raw values that a float signal can take: finite, and inside [minimum, maximum].
struct RealRange {
  double lowest = 0;
  double highest = 0;
};
/// The range of a float signal.
RealRange real_range(const Signal& signal);

}  // namespace canhil::dbc
