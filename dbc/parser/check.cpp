// What only the whole text can tell: the meaning of attributes, multiplexing, and the layout of every
// message.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "dbc/parser/reader.hpp"
#include "dbc/wire/bits.hpp"

namespace canhil::dbc {
namespace {

std::string full_name(const Message& message, const Signal& signal) {
  return fmt::format("{}.{}", message.name, signal.name);
}

/// find_attribute() for every message and signal, of which there may be tens of thousands as of definitions.
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

/// A number of any type, as double.
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

void read_message_attributes(const Defaults& defaults, Message& message) {
  const auto number = [&](std::string_view name) {
    return number_or_zero(defaults, message.attributes, Owner::message, name);
  };
  const double cycle_ms = number("GenMsgCycleTime");
  if (!is_message_time_ms(cycle_ms)) {
    fail_at(message.at, fmt::format("message {} has GenMsgCycleTime {} ms, expected {}", message.name,
                                    cycle_ms, message_time_range));
  }
  message.cycle_time_us = std::llround(cycle_ms * 1000);
  const double data_id = number("E2eDataId");
  if (data_id < 0 || data_id > 0xFFFF) {
    fail_at(message.at, fmt::format("message {} has E2eDataId {}, expected 0..65535", message.name, data_id));
  }
  message.e2e_data_id = static_cast<std::uint16_t>(data_id);
  message.sample_group =
      attribute_or<std::string>(defaults, message.attributes, Owner::message, "SampleGroup", {});
  message.answers =
      words_of(attribute_or<std::string>(defaults, message.attributes, Owner::message, "Answers", {}));
  const auto format =
      attribute_or<std::string>(defaults, message.attributes, Owner::message, "VFrameFormat", {});
  message.fd = format.ends_with("_FD");
  const bool says_extended = format.starts_with("Extended") || format.starts_with("J1939");
  if (message.attributes.contains("VFrameFormat") && says_extended != message.extended) {
    fail_at(message.at, fmt::format("message {} has the frame format {} and {} id, expected both the same",
                                    message.name, format, message.extended ? "an extended" : "a standard"));
  }
}

void read_signal_attributes(const Defaults& defaults, Signal& signal) {
  signal.sensor_sigma = number_or_zero(defaults, signal.attributes, Owner::signal, "SensorSigma");
  signal.carries_remainder = attribute_or<std::string>(defaults, signal.attributes, Owner::signal,
                                                       "CarriesRemainder", "no") == "yes";
}

void check_size(const Message& message) {
  constexpr std::array fd_sizes{12U, 16U, 20U, 24U, 32U, 48U, 64U};
  if (message.size <= 8) return;
  if (!message.fd) {
    fail_at(message.at,
            fmt::format("message {} has {} bytes, expected at most 8, or VFrameFormat StandardCAN_FD or "
                        "ExtendedCAN_FD",
                        message.name, message.size));
  }
  if (std::ranges::find(fd_sizes, message.size) == fd_sizes.end()) {
    fail_at(message.at, fmt::format("message {} has {} bytes, expected 0..8, 12, 16, 20, 24, 32, 48 or 64",
                                    message.name, message.size));
  }
}

/// Simple multiplexing names no multiplexor: it is the message's only one.
void resolve_multiplexors(Message& message) {
  const auto is_root = [](const Signal& s) { return s.multiplexor && s.mux_ranges.empty(); };
  const auto root = std::ranges::find_if(message.signals, is_root);
  if (root != message.signals.end()) {
    const auto second = std::find_if(root + 1, message.signals.end(), is_root);
    const bool all_named = std::ranges::none_of(
        message.signals, [](const Signal& s) { return !s.mux_ranges.empty() && s.multiplexed_by.empty(); });
    if (second != message.signals.end() && !all_named) {
      fail_at(second->at,
              fmt::format("message {} has a second multiplexor {}, expected one, or SG_MUL_VAL_ for every "
                          "multiplexed signal",
                          message.name, second->name));
    }
  }
  for (Signal& signal : message.signals) {
    if (signal.mux_ranges.empty() || !signal.multiplexed_by.empty()) continue;
    if (root == message.signals.end()) {
      fail_at(signal.at,
              fmt::format("signal {} is multiplexed but {} has no multiplexor, expected a signal with the "
                          "indicator M",
                          full_name(message, signal), message.name));
    }
    signal.multiplexed_by = root->name;
  }
}

void check_multiplexing(const Message& message) {
  for (const Signal& signal : message.signals) {
    if (signal.multiplexor && (signal.is_float() || signal.is_signed())) {
      fail_at(signal.at, fmt::format("multiplexor {} is {}, expected an unsigned integer",
                                     full_name(message, signal), signal.is_float() ? "a float" : "signed"));
    }
    if (signal.multiplexed_by.empty()) continue;
    const Signal& multiplexor = *find_signal(message, signal.multiplexed_by);
    const std::uint64_t largest =
        multiplexor.length >= 64 ? UINT64_MAX : (std::uint64_t{1} << multiplexor.length) - 1;
    for (const MuxRange& range : signal.mux_ranges) {
      if (range.last > largest) {
        fail_at(signal.at,
                fmt::format("signal {} is there when {} is {}, expected a value of its {} bits: 0..{}",
                            full_name(message, signal), multiplexor.name, range.last, multiplexor.length,
                            largest));
      }
    }
    std::size_t depth = 0;
    for (const Signal* above = &signal; !above->multiplexed_by.empty(); ++depth) {
      if (depth > message.signals.size()) {
        fail_at(
            signal.at,
            fmt::format("signal {} is multiplexed in a circle, expected a multiplexor that is always there",
                        full_name(message, signal)));
      }
      above = find_signal(message, above->multiplexed_by);
    }
  }
}

void check_numbers(const Message& message, const Signal& signal) {
  const std::string name = full_name(message, signal);
  if (signal.length == 0 || signal.length > 64) {
    fail_at(signal.at, fmt::format("signal {} has {} bits, expected 1..64", name, signal.length));
  }
  if (signal.scale == 0) fail_at(signal.at, fmt::format("signal {} has scale 0, expected another", name));
  if (signal.minimum > signal.maximum) {
    fail_at(signal.at, fmt::format("signal {} has minimum {} > maximum {}, expected minimum <= maximum", name,
                                   signal.minimum, signal.maximum));
  }
  if (!signal.is_float() && !raw_range(signal)) {
    fail_at(signal.at,
            fmt::format("signal {} cannot take any value in [{}|{}], expected a range that its bits, scale "
                        "and offset reach",
                        name, signal.minimum, signal.maximum));
  }
}

void check_values(const Message& message, const Signal& signal) {
  if (signal.is_float() && !signal.values.empty()) {
    fail_at(signal.at, fmt::format("float signal {} has named values, expected an integer signal",
                                   full_name(message, signal)));
  }
  const unsigned n = signal.length;
  for (const ValueName& value : signal.values) {
    const bool fits = signal.is_signed()
                          ? n == 64 || (value.value >= -(std::int64_t{1} << (n - 1)) &&
                                        value.value < (std::int64_t{1} << (n - 1)))
                          : value.value >= 0 && (n >= 63 || value.value < (std::int64_t{1} << n));
    if (!fits) {
      fail_at(signal.at, fmt::format("value {} \"{}\" of {} does not fit, expected one of {} {} bits",
                                     value.value, value.name, full_name(message, signal), n,
                                     signal.is_signed() ? "signed" : "unsigned"));
    }
  }
}

/// Marks the signal's bits (byte * 8 + bit) and says which bit was outside of the message, if any.
bool bits_of(const Message& message, const Signal& signal, std::bitset<512>& bits) {
  for (unsigned i = 0; i < signal.length; ++i) {
    const unsigned bit = wire::bit_position(signal.start_bit, i, signal.byte_order == ByteOrder::big_endian);
    if (bit >= message.size * 8) return false;
    bits.set(bit);
  }
  return true;
}

void check_layout(const Message& message) {
  std::vector<std::bitset<512>> bits(message.signals.size());
  for (std::size_t i = 0; i < message.signals.size(); ++i) {
    const Signal& signal = message.signals[i];
    if (!bits_of(message, signal, bits[i])) {
      fail_at(signal.at,
              fmt::format("signal {} reaches beyond the message, expected all {} bits inside of its {} bytes",
                          full_name(message, signal), signal.length, message.size));
    }
    for (std::size_t j = 0; j < i; ++j) {
      if ((bits[i] & bits[j]).any() && !mutually_exclusive(message, signal, message.signals[j])) {
        fail_at(signal.at, fmt::format("signal {} overlaps {}, expected bits of its own",
                                       full_name(message, signal), message.signals[j].name));
      }
    }
  }
}

}  // namespace

void finish(Draft& draft) {
  Database& database = draft.database;
  std::erase_if(database.messages, [](const Message& m) { return m.id == independent_signals_id; });
  const Defaults defaults(database);
  for (Message& message : database.messages) {
    read_message_attributes(defaults, message);
    check_size(message);
    for (Signal& signal : message.signals) {
      read_signal_attributes(defaults, signal);
      check_numbers(message, signal);
      check_values(message, signal);
    }
    resolve_multiplexors(message);
    check_multiplexing(message);
    check_layout(message);
  }
}

}  // namespace canhil::dbc
