#include "dbc/parser/codec.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "dbc/wire/bits.hpp"
#include "dbc/wire/quantise.hpp"

namespace canhil::dbc {
namespace {

bool is_big_endian(const Signal& signal) { return signal.byte_order == ByteOrder::big_endian; }

/// Bit i counted from the start bit is this bit of the raw value.
unsigned raw_index(const Signal& signal, unsigned i) {
  return is_big_endian(signal) ? signal.length - 1 - i : i;
}

std::int64_t sign_extended(const Signal& signal, std::uint64_t raw) {
  const unsigned unused = 64 - signal.length;
  return static_cast<std::int64_t>(raw << unused) >> unused;
}

}  // namespace

std::uint64_t raw_bits(const Signal& signal, std::span<const std::uint8_t> data) {
  std::uint64_t raw = 0;
  for (unsigned i = 0; i < signal.length; ++i) {
    const unsigned bit = wire::bit_position(signal.start_bit, i, is_big_endian(signal));
    raw |= std::uint64_t{(data[bit / 8] >> (bit % 8)) & 1U} << raw_index(signal, i);
  }
  return raw;
}

void put_raw_bits(const Signal& signal, std::uint64_t raw, std::span<std::uint8_t> data) {
  for (unsigned i = 0; i < signal.length; ++i) {
    const unsigned bit = wire::bit_position(signal.start_bit, i, is_big_endian(signal));
    const unsigned mask = 1U << (bit % 8);
    const bool set = ((raw >> raw_index(signal, i)) & 1U) != 0;
    data[bit / 8] = static_cast<std::uint8_t>(set ? data[bit / 8] | mask : data[bit / 8] & ~mask);
  }
}

double to_physical(const Signal& signal, std::uint64_t raw) {
  double number = 0;
  switch (signal.type) {
    case RawType::unsigned_integer:
      number = static_cast<double>(raw);
      break;
    case RawType::signed_integer:
      number = static_cast<double>(sign_extended(signal, raw));
      break;
    case RawType::float32:
      number = static_cast<double>(wire::real<float>(raw));
      break;
    case RawType::float64:
      number = wire::real<double>(raw);
      break;
  }
  // Plain values are not computed with: a signalling NaN keeps its bits.
  return signal.scale == 1 && signal.offset == 0 ? number
                                                 : wire::physical(number, signal.scale, signal.offset);
}

std::uint64_t to_raw(const Signal& signal, double value) {
  const double scale = signal.scale;
  const double offset = signal.offset;
  if (signal.is_float()) {
    const auto [low, high] = real_range(signal);
    return signal.type == RawType::float32 ? wire::float_bits<float>(value, scale, offset, low, high)
                                           : wire::float_bits<double>(value, scale, offset, low, high);
  }
  const RawRange range = raw_range(signal).value_or(RawRange{});
  if (signal.is_signed()) {
    return wire::quantised(value, scale, offset, wire::bound(range.lowest), wire::bound(range.highest)) &
           wire::mask(signal.length);
  }
  const double low = wire::bound(static_cast<std::uint64_t>(range.lowest));
  const double high = wire::bound(static_cast<std::uint64_t>(range.highest));
  return signal.length == 64 ? wire::quantised_wide(value, scale, offset, low, high)
                             : wire::quantised(value, scale, offset, low, high);
}

std::string_view value_name(const Signal& signal, std::uint64_t raw) {
  const auto value = signal.is_signed() ? sign_extended(signal, raw) : static_cast<std::int64_t>(raw);
  const auto found = std::ranges::find(signal.values, value, &ValueName::value);
  return found == signal.values.end() ? std::string_view{} : found->name;
}

bool is_present(const Message& message, const Signal& signal, std::span<const std::uint8_t> data) {
  for (const Signal* s = &signal; !s->multiplexed_by.empty();) {
    const Signal* multiplexor = find_signal(message, s->multiplexed_by);
    const std::uint64_t raw = raw_bits(*multiplexor, data);
    if (std::ranges::none_of(s->mux_ranges, [raw](MuxRange r) { return raw >= r.first && raw <= r.last; }))
      return false;
    s = multiplexor;
  }
  return true;
}

Result<std::vector<DecodedSignal>> decode(const Message& message, std::span<const std::uint8_t> data) {
  if (data.size() != message.size) {
    return failure(fmt::format("frame of message {} has {} bytes, expected {}", message.name, data.size(),
                               message.size));
  }
  std::vector<DecodedSignal> decoded;
  for (const Signal& signal : message.signals) {
    if (is_present(message, signal, data))
      decoded.push_back({&signal, to_physical(signal, raw_bits(signal, data))});
  }
  return decoded;
}

Result<std::vector<std::uint8_t>> encode(const Message& message, std::span<const NamedValue> values) {
  for (const NamedValue& value : values) {
    if (find_signal(message, value.signal) == nullptr) {
      return failure(
          fmt::format("message {} has no signal '{}', expected one of its DBC", message.name, value.signal));
    }
  }
  std::vector<std::uint8_t> data(message.size);
  const auto put = [&](const Signal& signal) {
    const auto given = std::ranges::find(values, signal.name, &NamedValue::signal);
    put_raw_bits(signal, to_raw(signal, given == values.end() ? 0 : given->value), data);
  };
  // A multiplexor decides what follows, so those at the top come first, then those below them.
  std::vector<const Signal*> waiting;
  for (const Signal& signal : message.signals) {
    if (signal.multiplexed_by.empty()) {
      put(signal);
    } else {
      waiting.push_back(&signal);
    }
  }
  const auto is_waiting = [&](const std::string& name) {
    return std::ranges::any_of(waiting, [&](const Signal* s) { return s->name == name; });
  };
  while (!waiting.empty()) {
    std::vector<const Signal*> later;
    for (const Signal* signal : waiting) {
      if (is_waiting(signal->multiplexed_by)) {
        later.push_back(signal);
      } else if (is_present(message, *signal, data)) {
        put(*signal);
      }
    }
    waiting = std::move(later);
  }
  return data;
}

}  // namespace canhil::dbc
