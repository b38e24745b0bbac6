// The content of a DBC file after all checks. parse() returns a Database; the codec and dbcgen use it. An
// object with a long symbol (such as SystemSignalLongSymbol) has this name, not the short name of the text.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace canhil::dbc {

/// A position in the text of a DBC file. Lines and columns are counted from 1; a column is a character.
struct Position {
  int line = 1;
  int column = 1;
};

/// The value of an attribute. It is an int64 for the types INT and HEX, a double for FLOAT, and a string for
/// STRING and for ENUM (the label).
using AttributeValue = std::variant<std::int64_t, double, std::string>;
using Attributes = std::map<std::string, AttributeValue, std::less<>>;

/// The kinds of objects that have attributes. The last three kinds are relations between a node and another
/// object.
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

/// The type of an attribute. In a DBC, these types are called INT, HEX, FLOAT, STRING and ENUM, in the same
/// order.
enum class AttributeType : std::uint8_t { integer, hexadecimal, real, text, enumeration };

/// A definition of an attribute (BA_DEF_), with its default (BA_DEF_DEF_).
struct AttributeDefinition {
  std::string name;
  Owner owner = Owner::network;
  AttributeType type = AttributeType::integer;
  double minimum = 0;  ///< if minimum and maximum are both 0, there are no limits
  double maximum = 0;
  std::vector<std::string> labels;  ///< the labels of an enumeration
  std::optional<AttributeValue> initial;
};

/// A raw value as a number. It has more than 64 bits, because it must hold the values of signed and of
/// unsigned signals of 64 bits.
using RawNumber = __int128;

/// The name of one raw value.
struct ValueName {
  RawNumber value = 0;
  std::string name;
  friend bool operator==(const ValueName&, const ValueName&) = default;
};

/// A value table, which gives names to raw values. The entries are in the order of the text.
struct ValueTable {
  std::string name;
  std::vector<ValueName> values;
};

/// A node of the bus (BU_).
struct Node {
  std::string name;
  std::string comment;
  Attributes attributes;
  Position at;
};

/// The byte order of a signal: Intel (little-endian) or Motorola (big-endian).
enum class ByteOrder : std::uint8_t { little_endian, big_endian };
inline constexpr unsigned largest_frame = 64;      ///< the most bytes of a frame
inline constexpr unsigned largest_message = 1785;  ///< the most of a transport protocol (SAE J1939-21)

/// The type of a raw value.
enum class RawType : std::uint8_t { unsigned_integer, signed_integer, float32, float64 };

/// The type in words of a programming language: unsigned, signed, float or double.
constexpr std::string_view name(RawType type) {
  switch (type) {
    case RawType::unsigned_integer:
      return "unsigned";
    case RawType::signed_integer:
      return "signed";
    case RawType::float32:
      return "float";
    case RawType::float64:
      break;
  }
  return "double";
}

/// A range of raw values of a multiplexor; `first` and `last` are included.
struct MuxRange {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
  friend bool operator==(const MuxRange&, const MuxRange&) = default;
};

/// A signal (SG_). Its physical value is raw * scale + offset.
struct Signal {
  std::string name;
  std::string unit;
  std::string comment;
  /// The position, in the numbering of a DBC, of the least significant bit (Intel) or of the most significant
  /// bit (Motorola).
  unsigned start_bit = 0;
  unsigned length = 0;  ///< number of bits, 1..64
  ByteOrder byte_order = ByteOrder::little_endian;
  RawType type = RawType::unsigned_integer;
  double scale = 1;
  double offset = 0;
  double minimum = 0;  ///< if minimum and maximum are both 0, only the bits limit the value
  double maximum = 0;
  std::vector<std::string> receivers;
  std::vector<ValueName> values;
  bool multiplexor = false;
  std::string multiplexed_by;  ///< name of the multiplexor; empty: the signal is always present
  /// The signal is present if the raw value of its multiplexor is in one of these ranges.
  std::vector<MuxRange> mux_ranges;
  Attributes attributes;
  Position at;

  /// The values of the attributes SensorSigma and CarriesRemainder.
  double sensor_sigma = 0;
  bool carries_remainder = false;

  /// True if the raw value is a signed integer (two's complement).
  [[nodiscard]] bool is_signed() const { return type == RawType::signed_integer; }
  /// True if the raw value is a floating-point number (IEEE 754).
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
  std::uint32_t id = 0;  ///< the CAN id, without the flag that marks an extended id
  bool extended = false;
  unsigned size = 0;   ///< number of bytes
  std::string sender;  ///< empty: the text names no sender (Vector__XXX)
  std::vector<std::string> further_senders;
  std::string comment;
  std::vector<Signal> signals;
  std::vector<SignalGroup> groups;
  Attributes attributes;
  Position at;

  /// The values of the attributes VFrameFormat, GenMsgCycleTime, E2eDataId, SampleGroup, Answers and
  /// Estimators.
  bool fd = false;
  /// The id is that of a parameter group of SAE J1939: VFrameFormat is J1939PG, or the attribute ProtocolType
  /// of the network is J1939.
  bool j1939 = false;
  bool fast_packet =
      false;  ///< NMEA 2000 sends the message in several classic frames (wire::is_fast_packet())
  /// Whether SAE J1939-21 sends the message in several classic frames (transport::J1939Receiver).
  [[nodiscard]] bool j1939_transport() const { return j1939 && !fd && !fast_packet && size > 8; }
  std::int64_t cycle_time_us = 0;
  std::uint16_t e2e_data_id = 0;
  std::string sample_group;
  std::vector<std::string> answers;     ///< names of sample groups; in the text, spaces separate them
  std::vector<std::string> estimators;  ///< the estimators whose runs exchange the message; empty: every run
};

/// An environment variable (EV_).
struct EnvironmentVariable {
  std::string name;
  std::string unit;
  std::string comment;
  int type = 0;  ///< 0: integer, 1: float, 2: string
  double minimum = 0;
  double maximum = 0;
  double initial = 0;
  unsigned data_size = 0;  ///< from ENVVAR_DATA_; 0: not a data variable
  std::vector<std::string> nodes;
  std::vector<ValueName> values;
  Attributes attributes;
  Position at;
};

/// An attribute of the relation between a node and a message, a signal or an environment variable.
struct RelationAttribute {
  std::string attribute;
  Owner owner = Owner::node_message;
  std::string node;
  std::uint32_t message_id = 0;  ///< as in the text, where bit 31 marks an extended id
  std::string target;            ///< name of the signal or of the environment variable
  AttributeValue value;
};

/// The whole content of a DBC file.
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
  std::uint64_t hash = 0;  ///< hash() of the text
};

/// The message with this id; nullptr: there is none.
const Message* find_message(const Database& database, std::uint32_t id, bool extended = false);
/// The message with this name; nullptr: there is none.
const Message* find_message(const Database& database, std::string_view name);
/// The signal with this name; nullptr: there is none.
const Signal* find_signal(const Message& message, std::string_view name);
/// The value of the attribute `name` of an object. `attributes` are those of the object. If they do not
/// contain the attribute, returns the default of its definition; nullptr: there is no default.
const AttributeValue* find_attribute(const Database& database, const Attributes& attributes, Owner owner,
                                     std::string_view name);

/// True if `ms` is a valid time in an attribute of a message: 0 (no time), or 1 us to 1e9 ms. A negative
/// time, or a time below 1 us, would be taken for 0. A time above 1e9 ms could overflow when it is converted
/// to nanoseconds.
bool is_message_time_ms(double ms);
/// The times that is_message_time_ms() accepts, as text for error messages.
inline constexpr std::string_view message_time_range = "0 (none) or 0.001..1e9";

/// True if no frame can contain both signals: both depend on the same multiplexor, and no value of this
/// multiplexor selects both.
bool mutually_exclusive(const Message& message, const Signal& a, const Signal& b);

/// The range of the raw values that an integer signal can have: they fit the bits of the signal and lie
/// inside [minimum, maximum]. For an unsigned signal, `lowest` and `highest` contain the bits of a
/// std::uint64_t.
struct RawRange {
  std::int64_t lowest = 0;
  std::int64_t highest = 0;
};
/// The range of the raw values of an integer signal; nullopt: no raw value lies inside [minimum, maximum].
std::optional<RawRange> raw_range(const Signal& signal);

/// Whether a signal can carry a physical value. Also true for a value that is outside the range of an integer
/// signal by at most one raw step.
bool holds(const Signal& signal, double value);

/// The range of the raw values that a float signal can have: they are finite and inside [minimum, maximum].
struct RealRange {
  double lowest = 0;
  double highest = 0;
};
/// The range of the raw values of a float signal.
RealRange real_range(const Signal& signal);

}  // namespace canhil::dbc
