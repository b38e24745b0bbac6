#include "dbc/protection/protection.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "dbc/protection/place.hpp"

namespace canhil::protection {
namespace {

std::uint8_t byte_of(std::uint32_t value, unsigned index) {
  return static_cast<std::uint8_t>(value >> (8 * index));
}

// The value of a byte that is added to the checksum. data_id_list has an entry for each counter value below
// the modulo. For a larger received counter, an arbitrary entry is used, because a later check rejects such a
// counter.
std::uint8_t added(const AddedByte& byte, const Settings& settings, const Subject& subject,
                   std::uint64_t counter) {
  switch (byte.source) {
    case Source::constant:
      return byte.value;
    case Source::data_id:
      return byte_of(settings.data_id, byte.index);
    case Source::data_id_alternating:
      return byte_of(settings.data_id, counter % 2 == 0 ? 0 : 1);
    case Source::data_id_of_counter:
      return settings.data_id_list[counter % settings.data_id_list.size()];
    case Source::message_id:
      return byte_of(subject.id, byte.index);
    case Source::length:
      return static_cast<std::uint8_t>(subject.size);
  }
  return 0;
}

std::uint64_t result(const Crc& crc, std::span<const std::uint8_t> bytes) { return compute(crc, bytes); }

std::uint64_t result(const Sum& sum, std::span<const std::uint8_t> bytes) {
  std::uint64_t total = sum.start;
  for (const std::uint8_t byte : bytes) {
    const unsigned low = byte & 0x0FU;
    const unsigned high = byte >> 4U;
    switch (sum.addition) {
      case Addition::bytes:
        total += byte;
        break;
      case Addition::nibbles:
        total += low + high;
        break;
      case Addition::xor_of_bytes:
        total ^= byte;
        break;
      case Addition::xor_of_nibbles:
        total ^= low ^ high;
        break;
    }
  }
  if (sum.negated) total = ~total + 1;
  return total ^ sum.final_xor;
}

}  // namespace

Result<Protection> Protection::make(Settings settings, const Subject& subject) {
  if (const Result<void> valid = validate(settings, subject); !valid) return failure(valid.error().message);
  return Protection(std::move(settings), subject);
}

Protection::Protection(Settings settings, const Subject& subject)
    : settings_(std::move(settings)), subject_(subject) {
  if (settings_.counter) {
    modulo_ = modulo(*settings_.counter);
    std::ranges::sort(settings_.counter->skipped);
  }
  if (!settings_.checksum) return;
  own_bits_ = bits_of(settings_.checksum->place);
  covered_ = covered_bytes(*settings_.checksum, subject.size);
}

std::uint64_t Protection::checksum(std::span<const std::uint8_t> data, std::uint64_t counter) const {
  const Checksum& sum = *settings_.checksum;
  std::array<std::uint8_t, Frame::max_size + 2 * Checksum::most_added> bytes{};
  std::size_t size = 0;
  const auto add = [&](const std::vector<AddedByte>& all) {
    for (const AddedByte& byte : all) bytes[size++] = added(byte, settings_, subject_, counter);
  };
  add(sum.before);
  for (const unsigned i : covered_) bytes[size++] = static_cast<std::uint8_t>(data[i] & ~own_bits_[i]);
  add(sum.after);
  const std::span<const std::uint8_t> input(bytes.data(), size);
  const std::uint64_t value = std::visit([&](const auto& rule) { return result(rule, input); }, sum.rule);
  return value & wire::mask(sum.place.length);
}

void Protection::protect(std::span<std::uint8_t> data, std::uint64_t counter) const {
  assert(data.size() == subject_.size);
  for (const Constant& constant : settings_.constants) write(constant.place, constant.value, data);
  if (settings_.counter) write(settings_.counter->place, counter, data);
  if (settings_.checksum) write(settings_.checksum->place, checksum(data, this->counter(data)), data);
}

void Protection::spoil_checksum(std::span<std::uint8_t> data) const {
  for (std::size_t i = 0; i < data.size(); ++i) data[i] ^= own_bits_[i];
}

bool Protection::checksum_right(std::span<const std::uint8_t> data) const {
  if (data.size() != subject_.size) return false;
  for (const Constant& constant : settings_.constants)
    if (read(constant.place, data) != constant.value) return false;
  return !settings_.checksum || read(settings_.checksum->place, data) == checksum(data, counter(data));
}

std::uint64_t Protection::counter(std::span<const std::uint8_t> data) const {
  return settings_.counter ? read(settings_.counter->place, data) : 0;
}

std::uint64_t Protection::period() const {
  return modulo_ - (settings_.counter ? settings_.counter->skipped.size() : 0);
}

bool Protection::allowed(std::uint64_t counter) const {
  return counter < modulo_ &&
         (!settings_.counter || !std::ranges::binary_search(settings_.counter->skipped, counter));
}

std::uint64_t Protection::first() const { return next(modulo_ - 1); }

std::uint64_t Protection::next(std::uint64_t counter) const {
  do {
    counter = counter + 1 >= modulo_ ? 0 : counter + 1;
  } while (!allowed(counter));
  return counter;
}

std::uint64_t Protection::steps(std::uint64_t from, std::uint64_t to) const {
  const auto rank = [&](std::uint64_t value) {  // how many allowed values are below `value`
    if (!settings_.counter) return value;
    const auto& skipped = settings_.counter->skipped;
    return value - static_cast<std::uint64_t>(std::ranges::lower_bound(skipped, value) - skipped.begin());
  };
  return (rank(to) + period() - rank(from)) % period();
}

bool Protection::counts_like(const Protection& other) const {
  return has_counter() == other.has_counter() && modulo_ == other.modulo_ &&
         (!has_counter() || settings_.counter->skipped == other.settings_.counter->skipped);
}

void Sender::protect(const Protection& protection, std::span<std::uint8_t> data) {
  const std::uint64_t counter = next_.value_or(protection.first());
  protection.protect(data, counter);
  if (protection.has_counter()) next_ = protection.next(counter);
}

Check Receiver::check(const Protection& protection, std::span<const std::uint8_t> data) {
  lost_ = 0;
  if (!protection.checksum_right(data)) return Check::wrong_checksum;
  if (!protection.has_counter()) return Check::ok;
  const std::uint64_t now = protection.counter(data);
  if (!protection.allowed(now)) return Check::counter_not_allowed;
  const std::optional<std::uint64_t> before = std::exchange(last_, now);
  if (!before) return Check::ok;
  const std::uint64_t steps = protection.steps(*before, now);
  if (steps == 0) return Check::repeated;
  lost_ = steps - 1;
  return lost_ == 0 ? Check::ok : Check::some_lost;
}

}  // namespace canhil::protection
