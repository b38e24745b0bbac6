// Checks whether settings are possible for a message.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "dbc/protection/settings.hpp"
#include "dbc/wire/bits.hpp"

namespace canhil::protection {
namespace {

constexpr unsigned longest_counter =
    32;  // in bits; small enough that sums of modulo and period fit in 64 bits
constexpr unsigned longest_constant = 64;

/// The fields that a Protection writes. Each field must be inside the message and must not overlap another
/// field.
class Fields {
 public:
  explicit Fields(unsigned size) : size_(size) {}

  Result<void> take(std::string_view what, const Place& place, unsigned longest) {
    if (place.length == 0 || place.length > longest)
      return failure(fmt::format("{}: {} bits, expected 1..{}", what, place.length, longest));
    if (!inside(place))
      return failure(
          fmt::format("{}: {} bits from bit {} lie beyond the message, expected a place in its {} bytes",
                      what, place.length, place.start_bit, size_));
    const auto bits = bits_of(place);
    for (const auto& [other, taken] : taken_) {
      for (unsigned i = 0; i < size_; ++i) {
        if ((bits[i] & taken[i]) != 0)
          return failure(
              fmt::format("{}: overlaps the {} in byte {}, expected bits of its own", what, other, i));
      }
    }
    taken_.push_back(Taken{std::string(what), bits});
    return {};
  }

 private:
  [[nodiscard]] bool inside(const Place& place) const {
    return place.start_bit < 8 * size_ &&
           (place.big_endian ? (place.start_bit / 8) * 8 + (7 - place.start_bit % 8) + place.length
                             : place.start_bit + place.length) <= 8 * size_;
  }

  struct Taken {
    std::string what;
    std::array<std::uint8_t, Frame::max_size> bits{};
  };
  unsigned size_;
  std::vector<Taken> taken_;
};

Result<void> validate(const Counter& counter) {
  const std::uint64_t most = std::uint64_t{1} << counter.place.length;
  const std::uint64_t values = modulo(counter);
  if (values > most)
    return failure(fmt::format("counter: modulo {}, expected at most {}: it has {} bits", values, most,
                               counter.place.length));
  std::vector<std::uint64_t> skipped = counter.skipped;
  std::ranges::sort(skipped);
  if (const auto twice = std::ranges::adjacent_find(skipped); twice != skipped.end())
    return failure(fmt::format("counter: skips {} twice, expected each value once", *twice));
  if (!skipped.empty() && skipped.back() >= values)
    return failure(
        fmt::format("counter: skips {}, expected values below its modulo {}", skipped.back(), values));
  if (values - skipped.size() < 2)
    return failure(fmt::format("counter: {} values remain (modulo {}, {} skipped), expected at least 2",
                               values - skipped.size(), values, skipped.size()));
  return {};
}

Result<void> validate(const Crc& crc, const Place& place) {
  if (Result<void> valid = validate(crc); !valid) return valid;
  if (place.length < crc.width)
    return failure(fmt::format("checksum: a CRC of {} bits in a place of {}, expected a place as wide",
                               crc.width, place.length));
  return {};
}

Result<void> validate(const Sum& sum, const Place& place) {
  const std::uint64_t most = wire::mask(place.length);
  if (sum.start > most)
    return failure(fmt::format("checksum: start 0x{:X}, expected at most 0x{:X}", sum.start, most));
  if (sum.final_xor > most)
    return failure(fmt::format("checksum: final_xor 0x{:X}, expected at most 0x{:X}", sum.final_xor, most));
  return {};
}

Result<void> validate_bytes(const Checksum& checksum, unsigned size) {
  const auto own = bits_of(checksum.place);
  std::array<bool, Frame::max_size> seen{};
  for (const unsigned byte : checksum.bytes) {
    if (byte >= size)
      return failure(
          fmt::format("checksum: covers byte {}, expected 0..{}: the message has {}", byte, size - 1, size));
    if (seen[byte])
      return failure(fmt::format("checksum: covers byte {} twice, expected each byte once", byte));
    seen[byte] = true;
    if (own[byte] == 0xFF && !checksum.own_bytes_as_zero)
      return failure(fmt::format(
          "checksum: covers itself in byte {}, expected other bytes, or own_bytes_as_zero = true", byte));
  }
  if (covered_bytes(checksum, size).empty())
    return failure("checksum: covers no byte of the message, expected at least one");
  return {};
}

Result<void> validate_added(const Settings& settings) {
  const Checksum& checksum = *settings.checksum;
  bool of_counter = false;
  bool of_list = false;
  for (const std::vector<AddedByte>* all : {&checksum.before, &checksum.after}) {
    if (all->size() > Checksum::most_added)
      return failure(fmt::format("checksum: {} bytes before or after the data, expected at most {}",
                                 all->size(), Checksum::most_added));
    for (const AddedByte& byte : *all) {
      if (byte.index >= 4)
        return failure(fmt::format("checksum: byte {} of an id, expected 0..3", byte.index));
      of_list |= byte.source == Source::data_id_of_counter;
      of_counter |= byte.source == Source::data_id_alternating || byte.source == Source::data_id_of_counter;
    }
  }
  if (of_counter && !settings.counter)
    return failure("checksum: covers a byte that depends on the counter, expected a counter");
  const std::size_t entries = settings.data_id_list.size();
  if (!of_list && entries != 0)
    return failure(
        "data_id_list: not used, expected data_id_of_counter before or after the checksum's bytes");
  if (of_list && entries != modulo(*settings.counter))
    return failure(fmt::format("data_id_list: {} entries, expected {}: one for each value of the counter",
                               entries, modulo(*settings.counter)));
  return {};
}

Result<void> validate_checksum(const Settings& settings, unsigned size) {
  const Checksum& checksum = *settings.checksum;
  const auto of_rule = [&](const auto& rule) { return validate(rule, checksum.place); };
  if (Result<void> valid = std::visit(of_rule, checksum.rule); !valid) return valid;
  if (Result<void> valid = validate_bytes(checksum, size); !valid) return valid;
  return validate_added(settings);
}

Result<void> validate_places(const Settings& settings, unsigned size) {
  Fields fields(size);
  if (settings.checksum) {
    if (Result<void> valid = fields.take("checksum", settings.checksum->place, Crc::widest); !valid)
      return valid;
  }
  if (settings.counter) {
    if (Result<void> valid = fields.take("counter", settings.counter->place, longest_counter); !valid)
      return valid;
  }
  for (const Constant& constant : settings.constants) {
    if (Result<void> valid = fields.take("constant", constant.place, longest_constant); !valid) return valid;
  }
  return {};
}

}  // namespace

Result<void> validate(const Settings& settings, const Subject& subject) {
  if (subject.size == 0 || subject.size > Frame::max_size)
    return failure(fmt::format("message: {} bytes, expected 1..{}", subject.size, Frame::max_size));
  if (!settings.counter && !settings.checksum)
    return failure("protection: neither counter nor checksum, expected at least one");

  if (Result<void> valid = validate_places(settings, subject.size); !valid) return valid;
  if (settings.counter) {
    if (Result<void> valid = validate(*settings.counter); !valid) return valid;
  }
  for (const Constant& constant : settings.constants) {
    const std::uint64_t most = wire::mask(constant.place.length);
    if (constant.value > most)
      return failure(fmt::format("constant: 0x{:X} in {} bits, expected at most 0x{:X}", constant.value,
                                 constant.place.length, most));
  }
  if (settings.checksum) return validate_checksum(settings, subject.size);
  if (!settings.data_id_list.empty())
    return failure("data_id_list: not used, expected a checksum that covers it");
  return {};
}

}  // namespace canhil::protection
