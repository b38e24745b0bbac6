// Checks that are possible only after the whole text has been read: the meaning of attributes, the
// multiplexing, and the layout of every message.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "dbc/parser/check.hpp"
#include "dbc/parser/reader.hpp"
#include "dbc/wire/bits.hpp"
#include "dbc/wire/j1939.hpp"

namespace canhil::dbc {
namespace {

/// Finds the same values as find_attribute(), but in logarithmic time, because a DBC may have tens of
/// thousands of messages, signals and definitions.
class Defaults {
 public:
  explicit Defaults(const Database& database) {
    for (const AttributeDefinition& definition : database.definitions) {
      if (definition.initial)
        values_.emplace(std::pair(definition.owner, definition.name), *definition.initial);
    }
  }
  [[nodiscard]] const AttributeValue* find(const Attributes& attributes, Owner owner,
                                           std::string_view name) const {
    if (const auto own = attributes.find(name); own != attributes.end()) return &own->second;
    const auto found = values_.find(std::pair(owner, std::string(name)));
    return found != values_.end() ? &found->second : nullptr;
  }

 private:
  std::map<std::pair<Owner, std::string>, AttributeValue> values_;
};

template <class Value>
Value attribute_or(const Defaults& defaults, const Attributes& attributes, Owner owner, std::string_view name,
                   Value otherwise) {
  const AttributeValue* value = defaults.find(attributes, owner, name);
  const Value* typed = value != nullptr ? std::get_if<Value>(value) : nullptr;
  return typed != nullptr ? *typed : otherwise;
}

/// The value of a numeric attribute as double; 0 if the attribute is absent or not a number.
double number_or_zero(const Defaults& defaults, const Attributes& attributes, Owner owner,
                      std::string_view name) {
  const AttributeValue* value = defaults.find(attributes, owner, name);
  if (value == nullptr) return 0;
  if (const auto* whole = std::get_if<std::int64_t>(value)) return static_cast<double>(*whole);
  const auto* real = std::get_if<double>(value);
  return real != nullptr ? *real : 0;
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  for (std::size_t at = text.find_first_not_of(' '); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    words.emplace_back(text.substr(at, end - at));
    at = text.find_first_not_of(' ', end);
  }
  return words;
}

/// Whether the frames of a message are those of SAE J1939. The format of the message itself has precedence
/// over the protocol of the network, and this over the default of the format.
bool is_j1939(const Defaults& defaults, const Database& database, const Message& message) {
  if (!message.extended) return false;
  const auto format =
      attribute_or<std::string>(defaults, message.attributes, Owner::message, "VFrameFormat", {});
  if (message.attributes.contains("VFrameFormat")) return format.starts_with("J1939");
  const auto protocol =
      attribute_or<std::string>(defaults, database.attributes, Owner::network, "ProtocolType", {});
  return protocol.find("J1939") != std::string::npos || format.starts_with("J1939");
}

void read_message_attributes(const Defaults& defaults, Findings& findings, Message& message) {
  const auto number = [&](std::string_view name) {
    return number_or_zero(defaults, message.attributes, Owner::message, name);
  };
  double cycle_ms = number("GenMsgCycleTime");
  if (!is_message_time_ms(cycle_ms)) {
    findings.add(Rule::cycle_time, message.at,
                 fmt::format("message {} has GenMsgCycleTime {} ms, expected {}", message.name, cycle_ms,
                             message_time_range));
    cycle_ms = 0;
  }
  message.cycle_time_us = std::llround(cycle_ms * 1000);
  double data_id = number("E2eDataId");
  if (data_id < 0 || data_id > 0xFFFF) {
    findings.add(Rule::data_id, message.at,
                 fmt::format("message {} has E2eDataId {}, expected 0..65535", message.name, data_id));
    data_id = 0;
  }
  message.e2e_data_id = static_cast<std::uint16_t>(data_id);
  message.sample_group =
      attribute_or<std::string>(defaults, message.attributes, Owner::message, "SampleGroup", {});
  const auto words = [&](std::string_view name) {
    return words_of(attribute_or<std::string>(defaults, message.attributes, Owner::message, name, {}));
  };
  message.answers = words("Answers");
  message.estimators = words("Estimators");
  const auto format =
      attribute_or<std::string>(defaults, message.attributes, Owner::message, "VFrameFormat", {});
  message.fd = format.ends_with("_FD");
  const bool says_extended = format.starts_with("Extended") || format.starts_with("J1939");
  if (message.attributes.contains("VFrameFormat") && says_extended != message.extended) {
    findings.add(Rule::frame_format, message.at,
                 fmt::format("message {} has the frame format {} and {} id, expected both the same",
                             message.name, format, message.extended ? "an extended" : "a standard"));
  }
}

void read_signal_attributes(const Defaults& defaults, Signal& signal) {
  signal.sensor_sigma = number_or_zero(defaults, signal.attributes, Owner::signal, "SensorSigma");
  signal.carries_remainder = attribute_or<std::string>(defaults, signal.attributes, Owner::signal,
                                                       "CarriesRemainder", "no") == "yes";
}

void check_size(Findings& findings, Message& message) {
  constexpr std::array fd_sizes{12U, 16U, 20U, 24U, 32U, 48U, 64U};
  if (message.size <= 8) return;
  if (!message.fd && wire::is_fast_packet(message.id, message.extended, message.size)) {
    message.fast_packet = true;
    return;
  }
  if (message.j1939_transport()) return;
  if (message.size > largest_frame) {
    findings.add(
        Rule::message_size, message.at,
        fmt::format(
            "message {} has {} bytes, expected at most {}, or a fast packet of NMEA 2000 or a message "
            "of SAE J1939",
            message.name, message.size, largest_frame));
    return;
  }
  if (!message.fd) {
    findings.add(Rule::fd_format_missing, message.at,
                 fmt::format("message {} has {} bytes, expected at most 8, or VFrameFormat StandardCAN_FD or "
                             "ExtendedCAN_FD",
                             message.name, message.size));
    message.fd = true;
  }
  if (std::ranges::find(fd_sizes, message.size) == fd_sizes.end()) {
    findings.add(Rule::fd_size, message.at,
                 fmt::format("message {} has {} bytes, expected 0..8, 12, 16, 20, 24, 32, 48 or 64",
                             message.name, message.size));
  }
}

/// Checks the length, the scale and the limits of a signal, and removes impossible limits. False: the length
/// is not 1..64 bits, so the signal cannot be decoded.
bool check_numbers(Findings& findings, const Message& message, Signal& signal) {
  const std::string name = full_name(message, signal);
  const auto find = [&](Rule rule, std::string what) { findings.add(rule, signal.at, std::move(what)); };
  const auto drop_limits = [&] { signal.minimum = signal.maximum = 0; };
  if (signal.length > 512) return false;  // a finding was added when the length was read
  if (signal.length == 0 || signal.length > 64) {
    find(Rule::signal_length, fmt::format("signal {} has {} bits, expected 1..64", name, signal.length));
    return false;
  }
  if (signal.scale == 0) {
    find(Rule::scale_zero, fmt::format("signal {} has scale 0, expected another", name));
    drop_limits();
  }
  if (signal.minimum > signal.maximum) {
    find(Rule::minimum_above_maximum,
         fmt::format("signal {} has minimum {} > maximum {}, expected minimum <= maximum", name,
                     signal.minimum, signal.maximum));
    drop_limits();
  }
  if (!signal.is_float() && !raw_range(signal)) {
    find(Rule::unreachable_range,
         fmt::format("signal {} cannot take any value in [{}|{}], expected a range that its bits, scale "
                     "and offset reach",
                     name, signal.minimum, signal.maximum));
    drop_limits();
  }
  return true;
}

void check_values(Findings& findings, const Message& message, const Signal& signal) {
  if (signal.is_float() && !signal.values.empty()) {
    findings.add(Rule::values_of_float, signal.at,
                 fmt::format("float signal {} has named values, expected an integer signal",
                             full_name(message, signal)));
  }
  const unsigned n = signal.length;
  const RawNumber end = RawNumber{1} << (signal.is_signed() ? n - 1 : n);
  const RawNumber first = signal.is_signed() ? -end : 0;
  for (const ValueName& value : signal.values) {
    if (value.value < first || value.value >= end) {
      findings.add(
          Rule::value_beyond_bits, signal.at,
          fmt::format("value {} \"{}\" of {} does not fit, expected one of {} {} bits", value.value,
                      value.name, full_name(message, signal), n, signal.is_signed() ? "signed" : "unsigned"));
    }
  }
}

using MessageBits = std::bitset<std::size_t{8} * largest_message>;

/// Sets those elements of `bits` (index: byte * 8 + bit) that the signal occupies. False: the signal reaches
/// beyond the message.
bool bits_of(const Message& message, const Signal& signal, MessageBits& bits) {
  for (unsigned i = 0; i < signal.length; ++i) {
    const unsigned bit = wire::bit_position(signal.start_bit, i, signal.byte_order == ByteOrder::big_endian);
    if (bit >= message.size * 8) return false;
    bits.set(bit);
  }
  return true;
}

void check_layout(Findings& findings, const Message& message, LeftOut& left_out) {
  std::vector<MessageBits> bits(message.signals.size());
  for (std::size_t i = 0; i < message.signals.size(); ++i) {
    const Signal& signal = message.signals[i];
    if (left_out[i]) continue;
    if (!bits_of(message, signal, bits[i])) {
      // For a start bit beyond the longest message, a finding was added when the start bit was read.
      if (signal.start_bit < bits[i].size()) {
        findings.add(
            Rule::signal_beyond_message, signal.at,
            fmt::format("signal {} reaches beyond the message, expected all {} bits inside of its {} bytes",
                        full_name(message, signal), signal.length, message.size));
      }
      left_out[i] = true;
      continue;
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (left_out[j] || !(bits[i] & bits[j]).any() ||
          mutually_exclusive(message, signal, message.signals[j]))
        continue;
      findings.add(Rule::overlap, signal.at,
                   fmt::format("signal {} overlaps {}, expected bits of its own", full_name(message, signal),
                               message.signals[j].name));
      break;
    }
  }
}

/// Removes the signals that are marked in `left_out` from the message and from the signal groups of the
/// message.
void leave_out(Message& message, const LeftOut& left_out) {
  if (std::ranges::find(left_out, true) == left_out.end()) return;
  std::vector<Signal> kept;
  for (std::size_t i = 0; i < left_out.size(); ++i) {
    if (!left_out[i]) kept.push_back(std::move(message.signals[i]));
  }
  message.signals = std::move(kept);
  for (SignalGroup& group : message.groups)
    std::erase_if(group.signals,
                  [&](const std::string& name) { return find_signal(message, name) == nullptr; });
}

/// Removes the messages that are longer than a frame and that no transport protocol carries.
void leave_out_long_messages(Database& database) {
  std::erase_if(database.messages, [](const Message& message) {
    return message.size > largest_frame && !message.fast_packet && !message.j1939_transport();
  });
}

/// Removes the messages that are marked in draft.left_out. They were kept until now, because later sections
/// of the text could refer to them.
void leave_out_messages(Draft& draft) {
  std::vector<Message> kept;
  for (std::size_t i = 0; i < draft.left_out.size(); ++i) {
    if (!draft.left_out[i]) kept.push_back(std::move(draft.database.messages[i]));
  }
  draft.database.messages = std::move(kept);
}

}  // namespace

std::string full_name(const Message& message, const Signal& signal) {
  return fmt::format("{}.{}", message.name, signal.name);
}

void finish(Draft& draft) {
  leave_out_messages(draft);
  use_long_symbols(draft.findings, draft.database);
  const Defaults defaults(draft.database);
  for (Message& message : draft.database.messages) {
    read_message_attributes(defaults, draft.findings, message);
    message.j1939 = is_j1939(defaults, draft.database, message);
    check_size(draft.findings, message);
    LeftOut left_out(message.signals.size());
    for (std::size_t i = 0; i < message.signals.size(); ++i) {
      Signal& signal = message.signals[i];
      read_signal_attributes(defaults, signal);
      left_out[i] = !check_numbers(draft.findings, message, signal);
      if (!left_out[i]) check_values(draft.findings, message, signal);
    }
    resolve_multiplexors(draft.findings, message, left_out);
    check_multiplexing(draft.findings, message, left_out);
    check_layout(draft.findings, message, left_out);
    leave_out_multiplexed(draft.findings, message, left_out);
    leave_out(message, left_out);
  }
  leave_out_long_messages(draft.database);
}

}  // namespace canhil::dbc
