#include "dbc/parser/plan.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <map>
#include <string>
#include <string_view>

#include "dbc/wire/bits.hpp"
#include "dbc/wire/quantise.hpp"

namespace canhil::dbc {
namespace {

constexpr unsigned window = 8;  // bytes

/// Gives access to data of at least `window` bytes. Shorter data is copied and padded with zeros.
class Window {
 public:
  explicit Window(std::span<const std::uint8_t> data) : data_(data.data()) {
    if (data.size() >= window) return;
    if (!data.empty()) std::memcpy(copy_.data(), data.data(), data.size());
    data_ = copy_.data();
  }
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;
  [[nodiscard]] const std::uint8_t* data() const { return data_; }

 private:
  std::array<std::uint8_t, window> copy_{};
  const std::uint8_t* data_;
};

std::uint64_t load(const std::uint8_t* data, bool big_endian) {
  const std::uint64_t word = wire::load_le<0, window>(data);
  return big_endian ? __builtin_bswap64(word) : word;
}

void store(std::uint8_t* data, std::uint64_t word, bool big_endian) {
  wire::store_le<0, window>(data, big_endian ? __builtin_bswap64(word) : word);
}

}  // namespace

BitPlacement::BitPlacement(const Signal& signal, std::size_t size)
    : mask(wire::mask(signal.length)), big_endian(signal.byte_order == ByteOrder::big_endian) {
  // `first` is the sequential number of the signal's first bit. The bits of each byte are counted from the
  // least significant bit for Intel, and from the most significant bit for Motorola.
  const unsigned first = big_endian ? signal.start_bit / 8 * 8 + 7 - signal.start_bit % 8 : signal.start_bit;
  const auto last_window = static_cast<unsigned>(std::max<std::size_t>(size, window)) - window;
  first_byte = static_cast<std::uint8_t>(std::min(first / 8, last_window));
  const unsigned from = first - 8U * first_byte;
  const unsigned end = from + signal.length;
  ninth_bits = static_cast<std::uint8_t>(std::max(end, 64U) - 64);
  shift = static_cast<std::uint8_t>(big_endian ? 64 - (end - ninth_bits) : from);
}

std::uint64_t BitPlacement::raw(const std::uint8_t* data) const {
  const std::uint64_t word = load(data + first_byte, big_endian) >> shift;
  if (ninth_bits == 0) [[likely]]
    return word & mask;
  const std::uint64_t ninth = data[first_byte + window];
  return (big_endian ? word << ninth_bits | ninth >> (8U - ninth_bits) : word | ninth << (64U - shift)) &
         mask;
}

void BitPlacement::put(std::uint64_t raw, std::uint8_t* data) const {
  raw &= mask;
  const unsigned in_ninth =
      big_endian ? ninth_bits : 0;  // number of the lowest bits of the signal that are in the ninth byte
  const std::uint64_t word = load(data + first_byte, big_endian);
  store(data + first_byte, (word & ~(mask >> in_ninth << shift)) | raw >> in_ninth << shift, big_endian);
  if (ninth_bits == 0) return;
  const std::uint64_t ninth_mask =
      big_endian ? wire::mask(ninth_bits) << (8U - ninth_bits) : wire::mask(ninth_bits);
  const std::uint64_t ninth = big_endian ? raw << (8U - ninth_bits) : raw >> (64U - shift);
  std::uint8_t& byte = data[first_byte + window];
  byte = static_cast<std::uint8_t>((byte & ~ninth_mask) | (ninth & ninth_mask));
}

Conversion::Conversion(const Signal& signal)
    : scale(signal.scale),
      offset(signal.offset),
      mask(wire::mask(signal.length)),
      sign_bit(signal.is_signed() ? std::uint64_t{1} << (signal.length - 1) : 0),
      is_plain(signal.scale == 1 && signal.offset == 0) {
  if (signal.type == RawType::float32) kind = Kind::float32;
  if (signal.type == RawType::float64) kind = Kind::float64;
  if (signal.type == RawType::unsigned_integer && signal.length == 64) kind = Kind::wide_unsigned;
}

double Conversion::physical(std::uint64_t raw) const {
  double number = 0;
  switch (kind) {
    case Kind::integer:
      number = static_cast<double>(sign_extended(raw));
      break;
    case Kind::wide_unsigned:
      number = static_cast<double>(raw);
      break;
    case Kind::float32:
      number = static_cast<double>(wire::real<float>(raw));
      break;
    case Kind::float64:
      number = wire::real<double>(raw);
      break;
  }
  // If scale and offset change nothing, no arithmetic is done, so that a signalling NaN keeps its bits.
  return is_plain ? number : wire::physical(number, scale, offset);
}

RawLimits::RawLimits(const Signal& signal) {
  if (signal.is_float()) {
    const RealRange range = real_range(signal);
    lowest = range.lowest;
    highest = range.highest;
    return;
  }
  const RawRange range = raw_range(signal).value_or(RawRange{});
  const auto bound = [&](std::int64_t raw) {
    return signal.is_signed() ? wire::bound(raw) : wire::bound(static_cast<std::uint64_t>(raw));
  };
  lowest = bound(range.lowest);
  highest = bound(range.highest);
}

std::uint64_t quantised(const Conversion& conversion, const RawLimits& limits, double value) {
  const auto [low, high] = limits;
  const double scale = conversion.scale;
  const double offset = conversion.offset;
  switch (conversion.kind) {
    case Conversion::Kind::wide_unsigned:
      return wire::quantised_wide(value, scale, offset, low, high);
    case Conversion::Kind::float32:
      return wire::float_bits<float>(value, scale, offset, low, high);
    case Conversion::Kind::float64:
      return wire::float_bits<double>(value, scale, offset, low, high);
    case Conversion::Kind::integer:
      break;
  }
  return wire::quantised(value, scale, offset, low, high) & conversion.mask;
}

MessagePlan::MessagePlan(const Message& message) : size_(message.size) {
  std::map<std::string_view, std::uint32_t>
      numbers;  // signal name -> number; of two signals with the same name, the first one
  for (const Signal& signal : message.signals) {
    const auto number = static_cast<std::uint32_t>(steps_.size());
    numbers.emplace(signal.name, number);
    Step step{.bits = BitPlacement(signal, size_), .conversion = Conversion(signal)};
    step.first_range = static_cast<std::uint32_t>(ranges_.size());
    if (!signal.multiplexed_by.empty())
      ranges_.insert(ranges_.end(), signal.mux_ranges.begin(), signal.mux_ranges.end());
    step.end_range = static_cast<std::uint32_t>(ranges_.size());
    steps_.push_back(step);
    limits_.emplace_back(signal);
    order_.push_back(number);
  }
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const std::string& name = message.signals[i].multiplexed_by;
    if (!name.empty()) steps_[i].multiplexor = numbers.at(name);
  }
  std::ranges::stable_sort(order_, {}, [this](std::uint32_t signal) { return multiplexors_above(signal); });
  find_fields();
}

// x + -0.0 and x - 0.0 have the bits of x, for each x.
MessagePlan::Field::Field(const Step& step, const RawLimits& raw_limits)
    : mask(step.bits.mask),
      sign_bit(step.conversion.sign_bit),
      scale(step.conversion.scale),
      added(step.conversion.offset == 0 ? -0.0 : step.conversion.offset),
      subtracted(step.conversion.offset == 0 ? 0.0 : step.conversion.offset),
      limits(raw_limits),
      shift(step.bits.shift),
      big_endian(step.bits.big_endian) {}

void MessagePlan::find_fields() {
  if (size_ > window) return;
  std::uint64_t taken = 0;  // bits of the signals so far
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Step& step = steps_[i];
    const std::uint64_t in_word = step.bits.mask << step.bits.shift;
    const std::uint64_t own = step.bits.big_endian ? __builtin_bswap64(in_word) : in_word;
    const bool fits = step.multiplexor == always && step.conversion.kind == Conversion::Kind::integer &&
                      step.conversion.scale > 0 && (taken & own) == 0;
    if (!fits) return fields_.clear();
    taken |= own;
    fields_.emplace_back(step, limits_[i]);
  }
}

void MessagePlan::decode_word(std::uint64_t word, double* values) const {
  const std::uint64_t swapped = __builtin_bswap64(word);
  for (const Field& field : fields_) {
    const std::uint64_t raw = (field.big_endian ? swapped : word) >> field.shift & field.mask;
    const auto number = static_cast<std::int64_t>((raw ^ field.sign_bit) - field.sign_bit);
    *values++ = static_cast<double>(number) * field.scale + field.added;
  }
}

std::uint64_t MessagePlan::encode_word(const double* values) const {
  std::uint64_t word = 0;
  for (const Field& field : fields_) {
    const double raw = wire::clamped((*values++ - field.subtracted) / field.scale, field.limits.lowest,
                                     field.limits.highest);
    const std::uint64_t bits = (static_cast<std::uint64_t>(wire::round_half_even(raw)) & field.mask)
                               << field.shift;
    word |= field.big_endian ? __builtin_bswap64(bits) : bits;
  }
  return word;
}

std::size_t MessagePlan::multiplexors_above(std::uint32_t signal) const {
  std::size_t count = 0;
  for (std::uint32_t i = steps_[signal].multiplexor; i != always; i = steps_[i].multiplexor) ++count;
  return count;
}

bool MessagePlan::holds(const Step& step, const std::uint8_t* data) const {
  for (const Step* below = &step; below->multiplexor != always;) {
    const Step& multiplexor = steps_[below->multiplexor];
    const std::uint64_t raw = multiplexor.bits.raw(data);
    const auto ranges = std::span(ranges_).subspan(below->first_range, below->end_range - below->first_range);
    if (std::ranges::none_of(ranges, [raw](MuxRange r) { return raw >= r.first && raw <= r.last; }))
      return false;
    below = &multiplexor;
  }
  return true;
}

bool MessagePlan::is_present(std::size_t signal, std::span<const std::uint8_t> data) const {
  const Window bytes(data);
  return holds(steps_[signal], bytes.data());
}

bool MessagePlan::decode(std::span<const std::uint8_t> data, std::span<double> values) const {
  if (data.size() < size_ || values.size() < steps_.size()) return false;
  const Window bytes(data);
  if (!fields_.empty()) {
    decode_word(wire::load_le<0, window>(bytes.data()), values.data());
    return true;
  }
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Step& step = steps_[i];
    const bool is_there = step.multiplexor == always || holds(step, bytes.data());
    values[i] = is_there ? step.conversion.physical(step.bits.raw(bytes.data()))
                         : std::numeric_limits<double>::quiet_NaN();
  }
  return true;
}

bool MessagePlan::encode(std::span<const double> values, std::span<std::uint8_t> data) const {
  if (data.size() < size_ || values.size() < steps_.size()) return false;
  if (!fields_.empty()) {
    const std::uint64_t word = encode_word(values.data());
    if (size_ == window)
      std::memcpy(data.data(), &word, window);
    else
      std::memcpy(data.data(), &word, size_);
    return true;
  }
  std::array<std::uint8_t, window> copy{};
  std::uint8_t* bytes = size_ < window ? copy.data() : data.data();
  if (size_ >= window) std::memset(bytes, 0, size_);
  for (const std::uint32_t i : order_) {
    const Step& step = steps_[i];
    if (holds(step, bytes)) step.bits.put(quantised(step.conversion, limits_[i], values[i]), bytes);
  }
  if (size_ < window) std::copy_n(copy.data(), size_, data.data());
  return true;
}

}  // namespace canhil::dbc
