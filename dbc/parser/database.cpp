#include "dbc/parser/database.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace canhil::dbc {
namespace {

/// A condition for the presence of a signal in a frame: the multiplexor must have a value in one of the
/// ranges.
struct Condition {
  std::string_view multiplexor;
  const std::vector<MuxRange>* ranges;
};

std::vector<Condition> conditions_of(const Message& message, const Signal& signal) {
  std::vector<Condition> conditions;
  const Signal* current = &signal;
  while (current != nullptr && !current->multiplexed_by.empty() &&
         conditions.size() <= message.signals.size()) {
    conditions.push_back({current->multiplexed_by, &current->mux_ranges});
    current = find_signal(message, current->multiplexed_by);
  }
  return conditions;
}

bool disjoint(const std::vector<MuxRange>& a, const std::vector<MuxRange>& b) {
  return std::ranges::none_of(a, [&](const MuxRange& x) {
    return std::ranges::any_of(b, [&](const MuxRange& y) { return x.first <= y.last && y.first <= x.last; });
  });
}

constexpr double two_63 = 9223372036854775808.0;

/// Converts a whole number to 64 bits (two's complement if signed). A number outside the range of the 64-bit
/// type becomes the nearest limit of this range.
std::int64_t to_bits(double value, bool is_signed) {
  if (is_signed) {
    if (value >= two_63) return std::numeric_limits<std::int64_t>::max();
    return value <= -two_63 ? std::numeric_limits<std::int64_t>::min() : static_cast<std::int64_t>(value);
  }
  if (value >= 2 * two_63) return -1;
  return value <= 0 ? 0 : static_cast<std::int64_t>(static_cast<std::uint64_t>(value));
}

}  // namespace

const Message* find_message(const Database& database, std::uint32_t id, bool extended) {
  const auto found = std::ranges::find_if(
      database.messages, [&](const Message& m) { return m.id == id && m.extended == extended; });
  return found == database.messages.end() ? nullptr : &*found;
}

const Message* find_message(const Database& database, std::string_view name) {
  const auto found = std::ranges::find(database.messages, name, &Message::name);
  return found == database.messages.end() ? nullptr : &*found;
}

const Signal* find_signal(const Message& message, std::string_view name) {
  const auto found = std::ranges::find(message.signals, name, &Signal::name);
  return found == message.signals.end() ? nullptr : &*found;
}

const AttributeValue* find_attribute(const Database& database, const Attributes& attributes, Owner owner,
                                     std::string_view name) {
  if (const auto own = attributes.find(name); own != attributes.end()) return &own->second;
  const auto definition = std::ranges::find_if(
      database.definitions, [&](const AttributeDefinition& d) { return d.name == name && d.owner == owner; });
  return definition != database.definitions.end() && definition->initial ? &*definition->initial : nullptr;
}

bool is_message_time_ms(double ms) { return ms == 0 || (ms >= 0.001 && ms <= 1e9); }

bool mutually_exclusive(const Message& message, const Signal& a, const Signal& b) {
  const auto conditions_b = conditions_of(message, b);
  return std::ranges::any_of(conditions_of(message, a), [&](const Condition& x) {
    return std::ranges::any_of(conditions_b, [&](const Condition& y) {
      return x.multiplexor == y.multiplexor && disjoint(*x.ranges, *y.ranges);
    });
  });
}

std::optional<RawRange> raw_range(const Signal& signal) {
  const bool is_signed = signal.is_signed();
  const double full = std::ldexp(1.0, static_cast<int>(signal.length));
  double lowest = is_signed ? -full / 2 : 0;
  double highest = (is_signed ? full / 2 : full) - 1;
  if (signal.minimum != 0 || signal.maximum != 0) {
    double first = (signal.minimum - signal.offset) / signal.scale;
    double last = (signal.maximum - signal.offset) / signal.scale;
    if (signal.scale < 0) std::swap(first, last);
    // Limits are decimal numbers: 1.31 / 2e-5 means 65500, but the division may give a slightly smaller
    // number.
    const auto slack = [](double x) { return 1e-9 * std::max(1.0, std::abs(x)); };
    lowest = std::max(lowest, std::ceil(first - slack(first)));
    highest = std::min(highest, std::floor(last + slack(last)));
  }
  if (!(lowest <= highest)) return std::nullopt;
  return RawRange{to_bits(lowest, is_signed), to_bits(highest, is_signed)};
}

bool holds(const Signal& signal, double value) {
  const double raw = (value - signal.offset) / signal.scale;
  if (signal.is_float()) {
    const RealRange range = real_range(signal);
    return raw >= range.lowest && raw <= range.highest;
  }
  const auto range = raw_range(signal);
  if (!range) return false;
  const auto number = [&](std::int64_t bits) {
    return signal.is_signed() ? static_cast<double>(bits)
                              : static_cast<double>(static_cast<std::uint64_t>(bits));
  };
  return raw >= number(range->lowest) - 1 && raw <= number(range->highest) + 1;
}

RealRange real_range(const Signal& signal) {
  const bool narrow = signal.type == RawType::float32;
  const double largest = narrow ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max();
  if (signal.minimum == 0 && signal.maximum == 0) return {-largest, largest};
  double lowest = (signal.minimum - signal.offset) / signal.scale;
  double highest = (signal.maximum - signal.offset) / signal.scale;
  if (signal.scale < 0) std::swap(lowest, highest);
  lowest = std::clamp(lowest, -largest, largest);
  highest = std::clamp(highest, -largest, largest);
  if (!narrow) return {lowest, highest};
  return {static_cast<double>(static_cast<float>(lowest)), static_cast<double>(static_cast<float>(highest))};
}

}  // namespace canhil::dbc
