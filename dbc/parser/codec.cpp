#include "dbc/parser/codec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "dbc/parser/plan.hpp"

namespace canhil::dbc {
namespace {

constexpr std::size_t largest_size = 64;

/// A copy of the data, padded with zeros to 64 bytes, because BitPlacement accesses eight bytes at once.
struct Padded {
  explicit Padded(std::span<const std::uint8_t> data) : size(std::min(data.size(), largest_size)) {
    std::copy_n(data.begin(), size, bytes.begin());
  }
  std::size_t size;
  std::array<std::uint8_t, largest_size> bytes{};
};

}  // namespace

std::uint64_t raw_bits(const Signal& signal, std::span<const std::uint8_t> data) {
  const Padded padded(data);
  return BitPlacement(signal, padded.size).raw(padded.bytes.data());
}

void put_raw_bits(const Signal& signal, std::uint64_t raw, std::span<std::uint8_t> data) {
  Padded padded(data);
  BitPlacement(signal, padded.size).put(raw, padded.bytes.data());
  std::copy_n(padded.bytes.begin(), padded.size, data.begin());
}

double to_physical(const Signal& signal, std::uint64_t raw) { return Conversion(signal).physical(raw); }

std::uint64_t to_raw(const Signal& signal, double value) {
  return quantised(Conversion(signal), RawLimits(signal), value);
}

std::string_view value_name(const Signal& signal, std::uint64_t raw) {
  const RawNumber value =
      signal.is_signed() ? RawNumber{Conversion(signal).sign_extended(raw)} : RawNumber{raw};
  const auto found = std::ranges::find(signal.values, value, &ValueName::value);
  return found == signal.values.end() ? std::string_view{} : found->name;
}

bool is_present(const Message& message, const Signal& signal, std::span<const std::uint8_t> data) {
  return MessagePlan(message).is_present(static_cast<std::size_t>(&signal - message.signals.data()), data);
}

Result<std::vector<DecodedSignal>> decode(const Message& message, std::span<const std::uint8_t> data) {
  if (data.size() != message.size) {
    return failure(fmt::format("frame of message {} has {} bytes, expected {}", message.name, data.size(),
                               message.size));
  }
  const MessagePlan plan(message);
  std::vector<double> values(plan.signals());
  std::vector<DecodedSignal> decoded;
  static_cast<void>(plan.decode(data, values));  // cannot fail: both arrays have the right length
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (plan.is_present(i, data)) decoded.push_back({&message.signals[i], values[i]});
  }
  return decoded;
}

Result<std::vector<std::uint8_t>> encode(const Message& message, std::span<const NamedValue> values) {
  std::vector<double> by_number(message.signals.size());
  for (const NamedValue& value : values) {
    const Signal* signal = find_signal(message, value.signal);
    if (signal == nullptr) {
      return failure(
          fmt::format("message {} has no signal '{}', expected one of its DBC", message.name, value.signal));
    }
    by_number[static_cast<std::size_t>(signal - message.signals.data())] = value.value;
  }
  std::vector<std::uint8_t> data(message.size);
  static_cast<void>(
      MessagePlan(message).encode(by_number, data));  // cannot fail: both arrays have the right length
  return data;
}

}  // namespace canhil::dbc
